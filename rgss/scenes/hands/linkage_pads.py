"""Pads of a linkage: contact face of each named link, and check that the two close on an object."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

from rgss.scenes.findings import Location
from rgss.scenes.linkage import Linkage, LinkageLink, LinkagePad, Triple
from rgss.scenes.pose import Pose

Problem = tuple[str, Location, str]

_SAMPLES = 32
_LARGEST_TURN_RAD = math.radians(1.0)
_LEAST_STROKE_M = 1.0e-3
_LEAST_PAD_M = 4.0e-3
_TOLERANCE_M = 1.0e-3
_FACE_M = 6.0e-4
# An innermost face with less than this share of another's area is a boss.
_SMALL_SHARE = 0.5
_LARGEST_M = 1.0
_LARGEST_KG = 50.0
_HALVINGS = 60


class PadError(Exception):
    """The pads of a mechanism cannot hold an object; the message follows the name of the URDF.

    Attributes:
        problem: Message, place in the gripper file and hint.
        approach: True if the two links approach each other across the tool axis, and fail by their faces alone.
    """

    def __init__(self, message: str, location: Location, hint: str, *, approach: bool = True) -> None:
        super().__init__(message)
        self.problem: Problem = (message, location, hint)
        self.approach = approach


@dataclass(frozen=True, slots=True, kw_only=True)
class DrivenRange:
    """Driven joint of a URDF.

    Attributes:
        link: Index of its child link.
        lower: Its least position in rad or m.
        upper: Its greatest position in rad or m.
        effort: Its greatest torque in N·m or force in N.
        speed: Its greatest speed.
    """

    link: int
    lower: float
    upper: float
    effort: float
    speed: float


def linkage_of(links: tuple[LinkageLink, ...], pads: tuple[int, int], driven: DrivenRange) -> Linkage:
    """Mechanism with its open and closed ends and the faces of its pads.

    Args:
        links: The links in topological order.
        pads: Indices of the links with the pads.
        driven: The driven joint.

    Raises:
        PadError: The pads do not close on an object along the tool axis.
    """
    bare = without_pads(links, driven)
    _require_metres(bare)
    for index in pads:
        if not links[index].hulls_m:
            raise PadError(
                f"has no collision shape for the pad {links[index].name!r}", ("pads",), "give the link its shape"
            )
    outward, opens_low = _outward(bare, pads)
    if not opens_low:
        bare = replace(bare, opened=driven.upper, closed=driven.lower)
    azimuth = math.atan2(outward[1], outward[0])
    found = [_face(bare, index, angle) for index, angle in zip(pads, (azimuth, azimuth + math.pi), strict=True)]
    boss_m = max(boss_m for _, boss_m in found)
    return _closing(replace(bare, pads=tuple(pad for pad, _ in found)), boss_m)


def without_pads(links: tuple[LinkageLink, ...], driven: DrivenRange) -> Linkage:
    """Mechanism whose pads and open end are not known yet.

    Args:
        links: The links in topological order.
        driven: The driven joint.
    """
    return Linkage(
        links=links,
        pads=(),
        driven=driven.link,
        opened=driven.lower,
        closed=driven.upper,
        effort=driven.effort,
        speed=driven.speed,
    )


def _require_metres(linkage: Linkage) -> None:
    poses = linkage.link_poses((linkage.opened + linkage.closed) / 2)
    for pose, link in zip(poses, linkage.links, strict=True):
        places = [pose.position_m, *(_moved(pose, corner) for hull in link.hulls_m for corner in hull)]
        far_m = max(max(map(abs, place)) for place in places)
        if far_m > _LARGEST_M:
            message = f"places a part of the link {link.name!r} {far_m:.4g} m from the flange"
            hint = "lengths of a URDF are metres; write millimetres as metres, and scale meshes by 0.001"
            raise PadError(message, ("description",), hint)
        if link.mass_kg > _LARGEST_KG:
            message = f"gives the link {link.name!r} {link.mass_kg:.4g} kg"
            raise PadError(message, ("description",), "masses of a URDF are kilograms")


def _outward(linkage: Linkage, pads: tuple[int, int]) -> tuple[tuple[float, float], bool]:
    """Direction from the second pad to the first, perpendicular to the tool axis, and True if the lower end is open."""
    low, high = linkage.link_poses(linkage.opened), linkage.link_poses(linkage.closed)
    names = [linkage.links[index].name for index in pads]
    ends = []
    for index, name in zip(pads, names, strict=True):
        turn = low[index].inverse() @ high[index]
        angle = 2 * math.acos(min(1.0, abs(turn.quaternion_xyzw[3])))
        if angle > _LARGEST_TURN_RAD:
            message = f"turns the pad {name!r} by {math.degrees(angle):.3g} deg over the stroke"
            raise PadError(
                message,
                ("pads", names.index(name)),
                "pads must stay parallel; add a joint that compensates the rotation",
                approach=False,
            )
        middle = _middle(linkage.links[index])
        ends.append((_moved(low[index], middle), _moved(high[index], middle)))
    (one_low, one_high), (other_low, other_high) = ends
    apart_low = [a - b for a, b in zip(one_low[:2], other_low[:2], strict=True)]
    apart_high = [a - b for a, b in zip(one_high[:2], other_high[:2], strict=True)]
    x, y = (a - b for a, b in zip(apart_high, apart_low, strict=True))
    way_m = math.hypot(x, y)
    if way_m < 2 * _LEAST_STROKE_M:
        message = (
            f"never lets the pads {names[0]!r} and {names[1]!r} meet: they stay {math.hypot(*apart_low):.4g} m apart"
        )
        hint = "name the links that close on an object, and check multipliers of <mimic>"
        raise PadError(message, ("pads",), hint, approach=False)
    x, y = x / way_m, y / way_m
    at_low, at_high = (x * apart[0] + y * apart[1] for apart in (apart_low, apart_high))
    opens_low = abs(at_low) > abs(at_high)
    sign = math.copysign(1.0, at_low if opens_low else at_high)
    return (sign * x, sign * y), opens_low


@dataclass(frozen=True, slots=True, kw_only=True)
class _FlatFace:
    """Flat face of a link towards the tool axis.

    Attributes:
        depth_m: Its distance from the tool axis.
        across_m: Its ends across the tool axis.
        along_m: Its ends along the tool axis, without what the link covers by parts before it.
    """

    depth_m: float
    across_m: tuple[float, float]
    along_m: tuple[float, float]

    @property
    def size_m(self) -> tuple[float, float]:
        """Width and length."""
        return self.across_m[1] - self.across_m[0], self.along_m[1] - self.along_m[0]

    @property
    def area_m2(self) -> float:
        """Its area, 0 without a least size."""
        width_m, length_m = self.size_m
        return width_m * length_m if min(width_m, length_m) >= _LEAST_PAD_M else 0.0


def _face(linkage: Linkage, index: int, azimuth: float) -> tuple[LinkagePad, float]:
    """Contact face of a link, and how far others protrude before it.

    It is the innermost face, unless that is small beside another that an object can touch.

    A finger may have a boss near the palm that protrudes before its pad.
    """
    link, pose = linkage.links[index], linkage.link_poses(linkage.opened)[index]
    x, y = math.cos(azimuth), math.sin(azimuth)
    hulls = [
        [(x * px + y * py, y * -px + x * py, pz) for px, py, pz in (_moved(pose, corner) for corner in hull)]
        for hull in link.hulls_m
    ]
    corners = [corner for hull in hulls for corner in hull]
    innermost = _flat_face(min(depth for depth, _, _ in corners), corners)
    of_parts = [_flat_face(min(depth for depth, _, _ in hull), corners) for hull in hulls]
    largest = max(of_parts, key=lambda part: part.area_m2)
    face = innermost if innermost.area_m2 > _SMALL_SHARE * largest.area_m2 else largest
    if not face.area_m2:
        width, length = (round(1e3 * size_m, 2) for size_m in innermost.size_m)
        raise PadError(
            f"has no flat face of 4 mm on the pad {link.name!r}: {width:.3g} mm x {length:.3g} mm",
            ("pads",),
            "give the collision shape a face that is parallel to the tool axis, or state the gripper by its sizes "
            "(kind: parallel; kind: fingers for more than two fingers)",
        )
    inner, aside, height = face.depth_m, sum(face.across_m) / 2, sum(face.along_m) / 2
    place = (inner * x - aside * y, inner * y + aside * x, height)
    frame = pose.inverse() @ Pose.from_roll_pitch_yaw(place, (0.0, 0.0, azimuth))
    pad = LinkagePad(link=index, frame=frame, size_m=(max(depth for depth, _, _ in corners) - inner, *face.size_m))
    return pad, inner - innermost.depth_m


def _flat_face(depth_m: float, corners: Sequence[Triple]) -> _FlatFace:
    """Face of a link at a depth.

    Args:
        depth_m: Distance from the tool axis.
        corners: All corners of the link: distance from the tool axis, place across it and along it.
    """
    face = [corner for corner in corners if depth_m <= corner[0] < depth_m + _FACE_M]
    across, along = [corner[1] for corner in face], [corner[2] for corner in face]
    covered_m = max((corner[2] for corner in corners if corner[0] < depth_m - _FACE_M), default=-math.inf)
    return _FlatFace(
        depth_m=depth_m,
        across_m=(min(across), max(across)),
        along_m=(min(max(min(along), covered_m), max(along)), max(along)),
    )


def _closing(linkage: Linkage, boss_m: float) -> Linkage:
    """Linkage with its stroke ended where the fingers meet; both must close symmetrically on the tool axis.

    Args:
        linkage: The mechanism with its pads.
        boss_m: Greatest distance by which a finger protrudes before its pad.
    """
    names = " and ".join(repr(linkage.links[pad.link].name) for pad in linkage.pads)
    hint = (
        "correct the pose of the palm under 'mount': z out of the arm, and the pads on both sides of the axis; or the "
        "multipliers of the joints that follow: both pads must travel alike"
    )
    span = linkage.closed - linkage.opened
    opened = [linkage.opened + span * index / _SAMPLES for index in range(_SAMPLES + 1)]
    openings = [linkage.opening_m(driven) for driven in opened]
    for driven in opened:
        one, other = linkage.pad_poses(driven)
        beside_m = math.hypot(*((a + b) / 2 for a, b in zip(one.position_m[:2], other.position_m[:2], strict=True)))
        if beside_m > _TOLERANCE_M:
            raise PadError(f"closes the pads {names} {beside_m * 1e3:.3g} mm beside the tool axis", ("mount",), hint)
        offset_m = abs(one.position_m[2] - other.position_m[2])
        if offset_m > _TOLERANCE_M:
            raise PadError(f"has the pads {names} {offset_m * 1e3:.3g} mm apart along the axis", ("pads",), hint)
    if openings[0] - boss_m <= _LEAST_STROKE_M:
        message = f"never opens the pads {names}"
        raise PadError(message, ("pads",), "their inner faces must face each other")
    end = next((index for index, opening in enumerate(openings) if opening < boss_m), None)
    if end is not None:
        linkage = replace(linkage, closed=_meeting(linkage, opened[end - 1], opened[end], boss_m))
        openings = openings[: end + 1]
    if any(later >= before for before, later in pairwise(openings)):
        message = f"makes the pads {names} approach and separate again"
        raise PadError(message, ("description",), "limit the driven joint to the range in which they approach")
    if linkage.opening_m(linkage.opened) - linkage.opening_m(linkage.closed) < _LEAST_STROKE_M:
        raise PadError(f"moves the pads {names} by less than 1 mm", ("pads",), "name the links that close on an object")
    return linkage


def _meeting(linkage: Linkage, apart: float, crossed: float, boss_m: float) -> float:
    """Position of the driven joint at which the fingers touch each other, by bisection."""
    for _ in range(_HALVINGS):
        middle = (apart + crossed) / 2
        if linkage.opening_m(middle) < boss_m:
            crossed = middle
        else:
            apart = middle
    return apart


def _middle(link: LinkageLink) -> Triple:
    corners: Sequence[Triple] = [corner for hull in link.hulls_m for corner in hull]
    x, y, z = (math.fsum(corner[axis] for corner in corners) / len(corners) for axis in range(3))
    return x, y, z


def _moved(pose: Pose, point: Triple) -> Triple:
    (x, y, z), (dx, dy, dz) = pose.position_m, pose.rotate(point)
    return x + dx, y + dy, z + dz
