"""Document model of the target of a move, and its reading."""

from __future__ import annotations

import math

from rgss.documents import DocumentModel, Identifier, Metres, Radians
from rgss.scenes import Pose, Waypoint
from rgss.tasks.reading.reader import Position, TaskReader
from rgss.tasks.steps import Target

_TOOL_DOWN_ROLL_RAD = math.pi


class PoseEntry(DocumentModel):
    """Pose of the grasp centre in the world or a named frame; without roll the tool points down, against z."""

    position: tuple[Metres, Metres, Metres]
    roll: Radians | None = None
    pitch: Radians = 0.0
    yaw: Radians = 0.0
    frame: Identifier | None = None


class TargetEntry(DocumentModel):
    """Target of a move: exactly one of a waypoint, a configuration, a frame and a pose."""

    to: Identifier | None = None
    raised: Metres = 0.0
    place: Identifier | None = None
    object: Identifier | None = None
    configuration: Identifier | None = None
    frame: Identifier | None = None
    pose: PoseEntry | None = None


def target_of(entry: TargetEntry, reader: TaskReader, position: Position) -> Target:
    """Target of a move; without a name where the entry states none or several."""
    at = position.at
    given = [key for key in ("to", "configuration", "frame", "pose") if getattr(entry, key) is not None]
    if len(given) != 1:
        said = " and ".join(given) or "none"
        reader.report(
            "task.target", f"a move needs one of to, configuration, frame and pose, got {said}", at, "name one"
        )
        return Target(name="")
    if entry.configuration is not None:
        joints = reader.configurations.get(entry.configuration)
        if joints is None:
            known = ", ".join(reader.configurations) or "none is given"
            message = f"there is no configuration {entry.configuration!r}"
            reader.report("task.unknown-configuration", message, (*at, "configuration"), f"configurations: {known}")
        return Target(name=entry.configuration, configuration_rad=joints or ())
    if entry.frame is not None:
        return Target(name=entry.frame, frame=entry.frame, raised_m=entry.raised)
    if entry.pose is not None:
        roll = _TOOL_DOWN_ROLL_RAD if entry.pose.roll is None else entry.pose.roll
        pose = Pose.from_roll_pitch_yaw(entry.pose.position, (roll, entry.pose.pitch, entry.pose.yaw))
        if entry.pose.frame is not None:
            return Target(name="pose", pose=pose, frame=entry.pose.frame, raised_m=entry.raised)
        return Target(name="pose", pose=pose.raised(entry.raised))
    name = entry.to or ""
    if name not in [one.value for one in Waypoint]:
        known = ", ".join(one.value for one in Waypoint)
        reader.report("task.unknown-waypoint", f"there is no waypoint {name!r}", (*at, "to"), f"waypoints: {known}")
    return Target(
        name=name,
        waypoint=name,
        raised_m=entry.raised,
        object=entry.object or position.object,
        place=entry.place or "",
    )
