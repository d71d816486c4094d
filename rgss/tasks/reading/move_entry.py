"""Document model of a move, and its reading."""

from __future__ import annotations

from typing import Literal

from rgss.documents import Dimensionless, Identifier, Radians, Seconds
from rgss.tasks.reading.control_entry import StepControlEntry, control_of
from rgss.tasks.reading.reader import Position, TaskReader
from rgss.tasks.reading.target_entry import TargetEntry, target_of
from rgss.tasks.steps import MoveKind, MoveStep


class MoveEntry(TargetEntry):
    """A move of the arm."""

    name: Identifier | None = None
    mode: Literal["planned", "straight", "joint"] = "planned"
    speed: Dimensionless = 1.0
    time_limit: Seconds | None = None
    resolution: Radians | None = None
    reached_within: Radians | None = None
    control: StepControlEntry | None = None

    def step(self, reader: TaskReader, position: Position) -> MoveStep:
        """The step, with findings in the reader."""
        at = position.at
        if not 0.0 < self.speed <= 1.0:
            message = f"speed must be a share in (0, 1], got {self.speed:g}"
            reader.report("task.share", message, (*at, "speed"), "write 0.5, or 50 %")
        reader.refuse_not_positive(
            at, time_limit=self.time_limit, resolution=self.resolution, reached_within=self.reached_within
        )
        target, mode = target_of(self, reader, position), MoveKind(self.mode)
        if mode is MoveKind.STRAIGHT and target.configuration_rad:
            message = "a straight line of the tool ends at a waypoint or a pose, not at a configuration"
            reader.report("task.target", message, (*at, "mode"), "write mode: joint")
        if mode is not MoveKind.PLANNED and self.time_limit is not None:
            message = "only a planned move has a planning limit"
            reader.report("task.limit", message, (*at, "time_limit"), "leave it out, or write mode: planned")
        return MoveStep(
            name=position.prefix + (self.name or f"move_to_{target.name}"),
            target=target,
            mode=mode,
            speed_share=self.speed,
            limit_s=self.time_limit,
            resolution_rad=self.resolution,
            reached_rad=reader.thresholds.joints if self.reached_within is None else self.reached_within,
            control=control_of(self.control, reader, at),
        )
