"""Document model of a task."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from rgss.documents import (
    Dimensionless,
    DocumentModel,
    Identifier,
    JointPosition,
    Metres,
    Newtons,
    Radians,
    RadiansPerSecond,
    Seconds,
)

MOST_REPETITIONS = 1000


class ThresholdsEntry(DocumentModel):
    """Default thresholds of the task's steps."""

    joints: Radians | None = None
    gripper: Metres | None = None


class StepControlEntry(DocumentModel):
    """Joint control in one step; omitted values are those of the study."""

    mode: Literal["position", "velocity", "computed_torque", "tool_tracking"] | None = None
    natural_frequency: RadiansPerSecond | None = None
    damping_ratio: Dimensionless | None = None
    position_gain: RadiansPerSecond | None = None
    velocity_gain: RadiansPerSecond | None = None


class PoseEntry(DocumentModel):
    """Pose of the grasp centre in the world; without roll and pitch the tool points down."""

    position: tuple[Metres, Metres, Metres]
    roll: Radians | None = None
    pitch: Radians = 0.0
    yaw: Radians = 0.0


class TargetEntry(DocumentModel):
    """Target of a move: exactly one of a waypoint, a configuration and a pose."""

    to: Identifier | None = None
    raised: Metres = 0.0
    place: Identifier | None = None
    object: Identifier | None = None
    configuration: Identifier | None = None
    pose: PoseEntry | None = None


class MoveEntry(TargetEntry):
    """A move of the arm."""

    name: Identifier | None = None
    mode: Literal["planned", "straight", "joint"] = "planned"
    speed: Dimensionless = 1.0
    time_limit: Seconds | None = None
    resolution: Radians | None = None
    reached_within: Radians | None = None
    control: StepControlEntry | None = None


class GripEntry(DocumentModel):
    """Closing of the hand on an object."""

    name: Identifier | None = None
    object: Identifier | None = None
    firm_above: Newtons | None = None
    firm_for: Seconds | None = None
    control: StepControlEntry | None = None


class ReleaseEntry(DocumentModel):
    """Opening of the hand at a place."""

    name: Identifier | None = None
    place: Identifier | None = None
    reached_within: Metres | None = None
    control: StepControlEntry | None = None


class WaitEntry(DocumentModel):
    """A rest of the arm."""

    duration: Seconds
    name: Identifier | None = None
    control: StepControlEntry | None = None


class NearEntry(DocumentModel):
    """Greatest distance of the object from exactly one of a place, another object and a point of the world."""

    within: Metres
    place: Identifier | None = None
    object: Identifier | None = None
    point: tuple[Metres, Metres, Metres] | None = None


class CheckEntry(DocumentModel):
    """Conditions, all of which must hold."""

    name: Identifier | None = None
    object: Identifier | None = None
    at: Identifier | None = None
    upright: bool = False
    at_rest: bool = False
    held: bool | None = None
    near: NearEntry | None = None


class RepeatEntry(DocumentModel):
    """Steps that are repeated."""

    times: Annotated[int, Field(ge=0, le=MOST_REPETITIONS)]
    name: Identifier = "cycle"
    steps: tuple[StepEntry, ...]


class ForEachEntry(DocumentModel):
    """Steps that are repeated for each object, their default object."""

    objects: tuple[Identifier, ...]
    steps: tuple[StepEntry, ...]


class StepEntry(DocumentModel):
    """One step, of exactly one kind."""

    move: MoveEntry | None = None
    grip: GripEntry | None = None
    release: ReleaseEntry | None = None
    wait: WaitEntry | None = None
    check: CheckEntry | None = None
    repeat: RepeatEntry | None = None
    for_each: ForEachEntry | None = None


class TaskDocument(DocumentModel):
    """A task file."""

    task: Identifier
    start: TargetEntry | None = None
    time_limit: Seconds | None = None
    configurations: dict[Identifier, tuple[JointPosition, ...]] = Field(default_factory=dict)
    reached_within: ThresholdsEntry = ThresholdsEntry()
    steps: tuple[StepEntry, ...]
