"""Grasp candidates of an object for a gripper, ordered by quality."""

from __future__ import annotations

import itertools
import math
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from enum import Enum

from rgss.grasping.candidates.boxes import box_frames
from rgss.grasping.candidates.cylinders import cylinder_frames
from rgss.grasping.candidates.fingertips import off_support, too_low
from rgss.grasping.candidates.frames import ToolFrame, approach_of
from rgss.grasping.candidates.hand_symmetry import with_half_turns
from rgss.grasping.candidates.meshes import antipodal_frames
from rgss.grasping.candidates.ranked_grasp import RankedGrasp
from rgss.grasping.candidates.scoring import com_distance_m, contact_points, quality_1
from rgss.scenes import (
    Approach,
    Box,
    GraspCandidates,
    GripperGeometry,
    MeshShape,
    Pose,
    Workpiece,
    centre_of_mass,
    settled_grasp,
)

OPEN_GAP_M = 0.002
"""Room that each pad needs beside the object on its way to the grasp."""

_ORDER = tuple(Approach)


class FrameRejection(str, Enum):
    """Reason why a tool frame is not a grasp candidate of the object with the gripper."""

    APPROACH = "approach"
    CONTACT = "contact"
    TOO_WIDE = "too wide"
    TOO_NARROW = "too narrow"
    RIM = "rim of a pad"
    NO_FORCE_CLOSURE = "no force closure"
    SEAL = "no flat face under the whole lip"


@dataclass(frozen=True, slots=True, kw_only=True)
class RankedGrasps:
    """Grasp candidates of an object, best first.

    Attributes:
        grasps: The candidates.
        rejected_frames: Number of rejected tool frames by reason.
        nearest_opening_m: Of the frames that are too wide or too narrow for the gripper, the opening nearest to its
        range by reason.
        too_low: Reason why the ends of the fingers do not hold a low object from above; empty if they do.
    """

    grasps: tuple[RankedGrasp, ...]
    rejected_frames: Mapping[FrameRejection, int]
    nearest_opening_m: Mapping[FrameRejection, float] = field(default_factory=dict)
    too_low: str = ""


@dataclass(frozen=True, slots=True)
class _Rejected:
    """Rejection of a tool frame, with the opening of the pads in contact where it is known."""

    reason: FrameRejection
    opening_m: float = math.nan


def ranked_grasps(
    workpiece: Workpiece,
    geometry: GripperGeometry,
    options: GraspCandidates,
    *,
    friction: float,
    clearance_m: float | None = None,
) -> RankedGrasps:
    """Grasp candidates of an object, ordered by quality, then distance of the centre of mass, then approach.

    Of a hand with two opposed pads the half turn of each is a candidate too.

    Args:
        workpiece: The object.
        geometry: The gripper's shape.
        options: Which grasps to try.
        friction: Coefficient of the contact.
        clearance_m: Clearance of the fingers from the object's support; None without a support.
    """
    found: list[RankedGrasp] = []
    rejected_frames: Counter[FrameRejection] = Counter()
    openings_m: dict[FrameRejection, list[float]] = {}
    given = (ToolFrame(id=one.id, tool_in_object=one.tool_in_object) for one in workpiece.grasps)
    generated = _frames(workpiece, geometry, options, friction)
    for frame in itertools.chain(given, _off_support(generated, workpiece, geometry, clearance_m)):
        one = _ranked(frame, workpiece, geometry, options, friction)
        if isinstance(one, _Rejected):
            rejected_frames[one.reason] += 1
            openings_m.setdefault(one.reason, []).append(one.opening_m)
        else:
            found.append(one)
    found.sort(
        key=lambda grasp: (
            -round(grasp.quality_1, 4),
            round(grasp.com_distance_m, 4),
            _ORDER.index(grasp.approach),
            grasp.id,
        )
    )
    nearest = {FrameRejection.TOO_WIDE: min, FrameRejection.TOO_NARROW: max}
    return RankedGrasps(
        grasps=with_half_turns(found, geometry),
        rejected_frames=dict(rejected_frames),
        nearest_opening_m={why: of(openings_m[why]) for why, of in nearest.items() if why in openings_m},
        too_low=""
        if clearance_m is None or Approach.ABOVE not in options.approaches
        else too_low(2 * workpiece.shape.half_height_m, clearance_m),
    )


def _off_support(
    frames: Iterable[ToolFrame], workpiece: Workpiece, geometry: GripperGeometry, clearance_m: float | None
) -> Iterator[ToolFrame]:
    """Frames whose fingers are clear of the support where they can be; of those that become equal the first."""
    if clearance_m is None:
        yield from frames
        return
    seen: set[Pose] = set()
    half_m = workpiece.shape.half_height_m
    for frame in frames:
        kept = off_support(frame, half_height_m=half_m, clearance_m=clearance_m, geometry=geometry)
        if kept is not frame and kept.tool_in_object in seen:
            continue
        seen.add(kept.tool_in_object)
        yield kept


def _frames(
    workpiece: Workpiece, geometry: GripperGeometry, options: GraspCandidates, friction: float
) -> Iterator[ToolFrame]:
    shape, centre = workpiece.shape, centre_of_mass(workpiece)
    if isinstance(shape, Box):
        yield from box_frames(shape, centre, options.heights, geometry)
    elif isinstance(shape, MeshShape):
        if options.samples:
            yield from antipodal_frames(
                shape, friction=friction, samples=options.samples, yaws=options.yaws, geometry=geometry
            )
    else:
        yield from cylinder_frames(shape, centre, heights=options.heights, yaws=options.yaws, geometry=geometry)


def _ranked(
    frame: ToolFrame, workpiece: Workpiece, geometry: GripperGeometry, options: GraspCandidates, friction: float
) -> RankedGrasp | _Rejected:
    approach = approach_of(frame.tool_in_object)
    if approach is None or approach not in options.approaches:
        return _Rejected(FrameRejection.APPROACH)
    settled = settled_grasp(workpiece.shape, frame.tool_in_object, geometry)
    if settled is None:
        return _Rejected(FrameRejection.CONTACT)
    tool_in_object, patches = settled
    opening_m = max(patch.opening_m for patch in patches)
    if opening_m > geometry.largest_opening_m - OPEN_GAP_M:
        return _Rejected(FrameRejection.TOO_WIDE, opening_m)
    if opening_m <= geometry.largest_opening_m - geometry.stroke_m:
        return _Rejected(FrameRejection.TOO_NARROW, opening_m)
    if any(patch.is_on_rim for patch in patches):
        return _Rejected(FrameRejection.RIM)
    points = contact_points(patches, tool_in_object, geometry, friction)
    quality = quality_1(points, workpiece)
    if quality <= 0.0:
        return _Rejected(FrameRejection.NO_FORCE_CLOSURE)
    return RankedGrasp(
        id=frame.id,
        tool_in_object=tool_in_object,
        opening_m=opening_m,
        approach=approach,
        quality_1=quality,
        com_distance_m=com_distance_m(points, centre_of_mass(workpiece)),
    )
