"""Shape of a gripper with a linkage at a position of its driven joint."""

from __future__ import annotations

from rgss.scenes.gripper import GripperGeometry
from rgss.scenes.linkage import Linkage, motion_of
from rgss.scenes.shapes import Cylinder


def at_opening(geometry: GripperGeometry, opening_m: float) -> GripperGeometry:
    """Gripper with its grasp centre at the pads' position at an opening; sliding fingers unchanged.

    Args:
        geometry: The gripper's shape.
        opening_m: Distance of the pads from the tool axis.
    """
    if geometry.linkage is None:
        return geometry
    motion = motion_of(geometry.linkage)
    return linkage_geometry(geometry, geometry.linkage, motion.driven_at(motion.largest_opening_m - opening_m))


def linkage_geometry(geometry: GripperGeometry, linkage: Linkage, driven: float) -> GripperGeometry:
    """Shape of a gripper with its pads at a position of the driven joint.

    Args:
        geometry: The gripper's shape at any position.
        linkage: Its mechanism.
        driven: Position of the driven joint.
    """
    depth_m, half_m = linkage.depth_m(driven), geometry.finger.size_m[2] / 2
    beyond_m = geometry.grasp_depth_m - geometry.base.height_m - half_m
    return GripperGeometry(
        id=geometry.id,
        azimuths_rad=geometry.azimuths_rad,
        base=Cylinder(radius_m=geometry.base.radius_m, height_m=depth_m - half_m),
        finger=geometry.finger,
        largest_opening_m=geometry.largest_opening_m,
        stroke_m=geometry.stroke_m,
        grasp_depth_m=depth_m + beyond_m,
        linkage=linkage,
    )
