"""Supports of objects and places: the bodies of a scene, and other objects, on which objects are stacked."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from rgss.documents import Document
from rgss.findings import Finding
from rgss.scenes.document import PlaceRegionEntry, SceneDocument, WorkpieceEntry
from rgss.scenes.findings import Location
from rgss.scenes.pose import Pose
from rgss.scenes.scene import PlaceRegion


@dataclass(frozen=True, slots=True, kw_only=True)
class Supports:
    """Supports of the objects and places of a scene.

    Attributes:
        tops_m: Height of the top of each body.
        poses: Transform of each object to the world at the start.
        half_heights_m: Half of the height of each object.
    """

    tops_m: Mapping[str, float]
    poses: Mapping[str, Pose]
    half_heights_m: Mapping[str, float]

    def region(self, entry: PlaceRegionEntry) -> PlaceRegion:
        """Place region of an entry; on an object where that stands at the start."""
        beneath = self.poses.get(entry.stands_on)
        region = PlaceRegion(
            centre_m=(*entry.at, self.tops_m.get(entry.stands_on, 0.0)),
            radius_m=entry.radius,
            largest_tilt_rad=entry.largest_tilt,
            largest_drop_m=entry.largest_drop,
            largest_drag_m=entry.largest_drag,
            largest_turn_rad=entry.largest_turn,
            offset_m=None if beneath is None else entry.at,
        )
        return region if beneath is None else region.on(beneath, self.half_heights_m[entry.stands_on])


def supports_of(entry: SceneDocument, tops_m: Mapping[str, float], half_heights_m: Mapping[str, float]) -> Supports:
    """Poses of the objects at the start, of a stack from the bottom up.

    Args:
        entry: The scene file, whose supports have no cycle.
        tops_m: Height of the top of each body.
        half_heights_m: Half of the height of each object.
    """
    objects = {one.id: one for one in (entry.workpiece, *entry.workpieces)}
    poses: dict[str, Pose] = {}
    while len(poses) < len(objects):
        for name, one in objects.items():
            if name in poses or (one.stands_on in objects and one.stands_on not in poses):
                continue
            if one.stands_on in objects:
                beneath = poses[one.stands_on]
                at_m = (*one.at, half_heights_m[one.stands_on] + half_heights_m[name])
                poses[name] = beneath @ Pose.from_roll_pitch_yaw(at_m, (0.0, 0.0, one.yaw))
            else:
                poses[name] = _on_body(one, tops_m[one.stands_on] + half_heights_m[name])
    return Supports(tops_m=tops_m, poses=poses, half_heights_m=half_heights_m)


def support_findings(entry: SceneDocument, document: Document) -> Iterator[Finding]:
    """Findings about unknown supports, and about cycles of supports.

    Args:
        entry: The scene file.
        document: The file, for positions.
    """
    bodies = list(dict.fromkeys(body.id for body in entry.bodies))
    moving = {body.id for body in entry.bodies if body.moves_with_robot}
    objects = [one.id for one in (entry.workpiece, *entry.workpieces)]
    for at, name, own in _supports(entry):
        if name in moving:
            message = f"{name} moves with the robot, and what stands on it would stay"
            hint = f"name another support, or remove moves_with_robot of {name}"
            yield document.finding("scene.moving-support", message, at, hint=hint)
        others = [one for one in objects if one != own]
        if name in bodies or name in others:
            continue
        if name == own:
            yield document.finding("scene.stack", f"{own!r} cannot be its own support", at, hint="name another support")
            continue
        kind, hint = "body", f"known bodies: {', '.join(bodies)}"
        if others:
            kind, hint = "body or object", f"{hint}; objects: {', '.join(others)}"
        yield document.finding("scene.unknown-body", f"there is no {kind} {name!r}", at, hint=hint)
    beneath = {one.id: one.stands_on for one in (entry.workpiece, *entry.workpieces)}
    for index, name in enumerate(objects):
        below = [name]
        while beneath.get(below[-1], below[-1]) not in below:
            below.append(beneath[below[-1]])
        if beneath.get(below[-1]) == name and len(below) > 1:
            at = ("workpieces", index - 1, "stands_on") if index else ("workpiece", "stands_on")
            message = f"{', '.join(below)} support each other in a cycle"
            yield document.finding("scene.stack", message, at, hint="name a body as the support of the lowest")
            return


def _on_body(entry: WorkpieceEntry, height_m: float) -> Pose:
    at_m = (*entry.at, height_m)
    return Pose.from_roll_pitch_yaw(at_m, (0.0, 0.0, entry.yaw)) if entry.yaw else Pose(position_m=at_m)


def _supports(entry: SceneDocument) -> Iterator[tuple[Location, str, str]]:
    """Location and name of each support, and the supported object; empty for a place without one."""
    own = entry.workpiece
    yield ("workpiece", "stands_on"), own.stands_on, own.id
    yield ("place_region", "stands_on"), entry.place_region.stands_on, own.id
    for index, one in enumerate(entry.workpieces):
        yield ("workpieces", index, "stands_on"), one.stands_on, one.id
        yield ("workpieces", index, "place_region", "stands_on"), one.place_region.stands_on, one.id
    for index, place in enumerate(entry.places):
        yield ("places", index, "stands_on"), place.stands_on, ""
