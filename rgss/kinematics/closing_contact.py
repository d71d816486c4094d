"""Links of a gripper's linkage that come to the object while the pads close on it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from rgss.kinematics.description import transform
from rgss.kinematics.geometry import hull_of, object_solids
from rgss.scenes import GripperGeometry, Linkage, Pose, Scene, grasp_opening_m, motion_of, object_in_hand

_SAMPLES = 9

CLOSING_ROOM_M = 3.0e-3
"""Least distance of such a link from the object in contact physics: PyBullet enlarges both hulls by 1 mm."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ClosingContact:
    """A link at the object.

    Attributes:
        link: Name of the link in the gripper's URDF.
        distance_m: Its least distance from the object while the pads close; negative for a penetration.
    """

    link: str
    distance_m: float


class ClosingLinks:
    """Links of a gripper that move while its pads close, without those of its fingers.

    The tool rests meanwhile, so that the object's pose in the hand is that of the grasp.
    """

    def __init__(self, geometry: GripperGeometry) -> None:
        """Build the solids of the links; none for grippers without a linkage.

        Args:
            geometry: The gripper's shape.
        """
        self._geometry = geometry
        self._solids = {} if geometry.linkage is None else _moved_solids(geometry.linkage)

    def contact(self, scene: Scene, *, clearance_m: float = 0.0) -> ClosingContact | None:
        """Link that comes nearest to the object, if it comes nearer than a clearance.

        Args:
            scene: The scene, with the object as its workpiece, and its chosen grasp if there are candidates.
            clearance_m: Least distance.
        """
        geometry, linkage = self._geometry, self._geometry.linkage
        if linkage is None or not self._solids:
            return None
        motion = motion_of(linkage)
        held = geometry.grasp_centre @ (object_in_hand(scene, geometry) or Pose())
        objects = [(solid, held @ at) for solid, at in object_solids(scene.workpiece.shape)]
        end = motion.driven_at(motion.largest_opening_m - grasp_opening_m(scene, geometry))
        nearest: ClosingContact | None = None
        for driven in np.linspace(linkage.opened, end, _SAMPLES):
            poses = linkage.link_poses(float(driven))
            for index, solids in self._solids.items():
                distance_m = min(_distance_m(one, poses[index], two, at) for one in solids for two, at in objects)
                if distance_m < (clearance_m if nearest is None else nearest.distance_m):
                    nearest = ClosingContact(link=linkage.links[index].name, distance_m=distance_m)
        return nearest


def _moved_solids(linkage: Linkage) -> dict[int, list[Any]]:
    still = {*linkage.palm_links, *(index for parts in linkage.finger_parts for index in parts)}
    return {
        index: [hull_of(corners) for corners in link.hulls_m]
        for index, link in enumerate(linkage.links)
        if index not in still and link.hulls_m
    }


def _distance_m(one: Any, pose: Pose, other: Any, at: Pose) -> float:
    import coal

    first, second = (transform(place) for place in (pose, at))
    return float(
        coal.distance(
            one,
            coal.Transform3s(first.rotation, first.translation),
            other,
            coal.Transform3s(second.rotation, second.translation),
            coal.DistanceRequest(),
            coal.DistanceResult(),
        )
    )
