"""Grasp candidates of an object for a suction cup, ordered by the weight that the seal holds."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from rgss.grasping.candidates.frames import approach_of, tool_frame
from rgss.grasping.candidates.ranked_grasp import RankedGrasp
from rgss.grasping.candidates.ranking import FrameRejection, RankedGrasps
from rgss.grasping.candidates.suction import given_suction_point, suction_points
from rgss.scenes import (
    Approach,
    GraspCandidates,
    GripperGeometry,
    Pose,
    SuctionPoint,
    Workpiece,
    centre_of_mass,
)

Array = NDArray[np.float64]
Vector3 = tuple[float, float, float]
_NO_LOAD = 1e-9
_ORDER = tuple(Approach)


def ranked_suction(
    workpiece: Workpiece,
    geometry: GripperGeometry,
    options: GraspCandidates,
    *,
    tangential_1: float,
    depth_m: float | None = None,
) -> RankedGrasps:
    """Suction candidates of an object, ordered by holding weight, then distance of the centre of mass, then approach.

    On each flat face that supports the lip the point nearest to the centre of mass, and each given grasp whose axis
    enters such a face, at several angles about the cup's axis.

    Args:
        workpiece: The object.
        geometry: The gripper's shape, with a cup.
        options: Which grasps to try.
        tangential_1: Greatest tangential force divided by the greatest axial force of the cup.
        depth_m: Distance of the gripper's grasp centre from the face; half the object's height by default.

    Raises:
        AssertionError: The gripper has no cup.
    """
    if geometry.cup is None:
        raise AssertionError("asked before: the gripper has a cup")
    depth_m = workpiece.shape.half_height_m if depth_m is None else depth_m
    found: list[RankedGrasp] = []
    rejected_frames = {FrameRejection.SEAL: 0, FrameRejection.APPROACH: 0}
    centre, radius_m = centre_of_mass(workpiece), geometry.cup.radius_m
    for name, point in _points(workpiece, radius_m):
        if point is None:
            rejected_frames[FrameRejection.SEAL] += 1
            continue
        for turn in range(options.yaws):
            frame = _tool(point, math.tau * turn / options.yaws, depth_m)
            approach = approach_of(frame)
            if approach is None or approach not in options.approaches:
                rejected_frames[FrameRejection.APPROACH] += 1
                continue
            found.append(
                RankedGrasp(
                    id=f"{name}:{turn:02d}",
                    tool_in_object=frame,
                    opening_m=0.0,
                    approach=approach,
                    quality_1=weight_share(point, centre, radius_m, tangential_1),
                    com_distance_m=float(np.linalg.norm(_arm(point, centre, point.normal))),
                    suction=point,
                )
            )
    found.sort(
        key=lambda grasp: (
            -round(grasp.quality_1, 4),
            round(grasp.com_distance_m, 4),
            _ORDER.index(grasp.approach),
            grasp.id,
        )
    )
    return RankedGrasps(
        grasps=tuple(found), rejected_frames={why: count for why, count in rejected_frames.items() if count}
    )


def weight_share(point: SuctionPoint, centre_of_mass_m: Vector3, cup_radius_m: float, tangential_1: float) -> float:
    """Greatest weight of an object at rest that a seal holds, divided by the force F of its vacuum.

    With the weight W along -z of the object's frame, n the face's normal and r the lip's radius, the seal holds W n_z
    <= F along its axis, W sqrt(1 - n_z^2) <= tangential_1 F along the face, and a bending moment about the lip's centre
    of (F - W n_z) r, at which the lip lifts off on one side.

    Args:
        point: The suction point.
        centre_of_mass_m: The object's centre of mass.
        cup_radius_m: Radius of the lip.
        tangential_1: Greatest tangential force divided by the greatest axial force of the cup.
    """
    normal = np.array(point.normal)
    pull, along = float(normal[2]), math.hypot(*point.normal[:2])
    moment = _arm(point, centre_of_mass_m, (0.0, 0.0, -1.0))
    bending_m = float(np.linalg.norm(moment - (moment @ normal) * normal))
    limits = [(1.0, pull), (tangential_1, along), (cup_radius_m, bending_m + pull * cup_radius_m)]
    return min((bound / load for bound, load in limits if load > _NO_LOAD), default=math.inf)


def _arm(point: SuctionPoint, centre: Vector3, along: Vector3) -> Array:
    """Moment about the centre of the cup of a unit force at the centre of mass."""
    return np.asarray(np.cross(np.array(centre) - np.array(point.position_m), along))


def _points(workpiece: Workpiece, radius_m: float) -> Iterator[tuple[str, SuctionPoint | None]]:
    """Suction points by name; None for a given grasp without a seal, and for a shape without a point."""
    for given in workpiece.grasps:
        yield given.id, given_suction_point(workpiece.shape, radius_m, given.tool_in_object)
    points = suction_points(workpiece.shape, radius_m, centre_of_mass(workpiece))
    if not points:
        yield "cup", None
    for index, point in enumerate(points):
        yield f"cup:{index}", point


def _tool(point: SuctionPoint, turn_rad: float, depth_m: float) -> Pose:
    """Grasp-centre frame of a cup at a suction point, the tool's axis opposed to the normal."""
    normal = np.array(point.normal)
    across = np.array([1.0, 0.0, 0.0]) if abs(normal[0]) < 0.9 else np.array([0.0, 0.0, -1.0])
    first = across - (across @ normal) * normal
    first /= np.linalg.norm(first)
    second = np.cross(normal, first)
    closing = math.cos(turn_rad) * first + math.sin(turn_rad) * second
    x, y, z = (float(value) for value in np.array(point.position_m) - depth_m * normal)
    return tool_frame(
        "",
        (x, y, z),
        towards=_vector(-normal),
        closing=_vector(closing),
        azimuth_rad=0.0,
    ).tool_in_object


def _vector(values: Array) -> Vector3:
    x, y, z = (float(value) for value in values)
    return x, y, z
