"""Contacts and quality of a grasp candidate."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from rgss.grasping.contact import ContactPoint, Vector3
from rgss.grasping.grasp import Grasp
from rgss.grasping.quality import q_smw_n
from rgss.scenes import GripperGeometry, PadPatch, Pose, Workpiece, centre_of_mass, girth_radius_m

_CONE_EDGES = 6


def contact_points(
    patches: Sequence[PadPatch], tool_in_object: Pose, geometry: GripperGeometry, friction: float
) -> tuple[ContactPoint, ...]:
    """Corners of the contact patches as point contacts with friction, in the object's frame.

    A flat pad presses along its own normal, on a face as on an edge.

    Args:
        patches: Contact patch of each pad.
        tool_in_object: Transform of the grasp-centre frame to the object's frame.
        geometry: The gripper's shape.
        friction: Coefficient of the contact.
    """
    found = []
    for finger, (azimuth, patch) in enumerate(zip(geometry.azimuths_rad, patches, strict=True)):
        pad = tool_in_object @ Pose.from_roll_pitch_yaw((0.0, 0.0, 0.0), (0.0, 0.0, azimuth))
        normal, tangent = pad.rotate((-1.0, 0.0, 0.0)), pad.rotate((0.0, 0.0, 1.0))
        for across_m, along_m in patch.corners_m:
            at = (pad @ Pose(position_m=(patch.opening_m, across_m, along_m))).position_m
            found.append(ContactPoint(position_m=at, normal=normal, friction=friction, finger=finger, tangent=tangent))
    return tuple(found)


def quality_1(points: Sequence[ContactPoint], workpiece: Workpiece) -> float:
    """Smallest maximum wrench in N for finger forces of 1 N (Ferrari and Canny, 1992); 0 without force closure.

    Args:
        points: The contacts.
        workpiece: The object; torques are divided by its radius about the vertical.
    """
    grasp = Grasp.of(points, centre_of_mass(workpiece), girth_radius_m(workpiece.shape))
    return q_smw_n(grasp, finger_force_limit_n=1.0, cone_edges=_CONE_EDGES)


def com_distance_m(points: Sequence[ContactPoint], centre: Vector3) -> float:
    """Distance in m of the centre of mass from the line between two fingers' contacts, or the centre of more."""
    fingers = sorted({point.finger for point in points if point.finger is not None})
    middles = [np.mean([point.position_m for point in points if point.finger == finger], axis=0) for finger in fingers]
    if len(middles) != 2:
        return math.dist(centre, np.mean(middles, axis=0).tolist())
    along = middles[1] - middles[0]
    across = np.cross(np.array(centre) - middles[0], along)
    return float(np.linalg.norm(across) / np.linalg.norm(along))
