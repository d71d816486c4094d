"""Move step: planned, Cartesian straight or joint straight motion to a waypoint, a configuration or a pose."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

from rgss.scenes import Pose
from rgss.tasks.steps.base import Mention, Named, Result, Result_co, TaskStep
from rgss.tasks.steps.move_kind import MoveKind
from rgss.tasks.steps.step_control import StepControl


@dataclass(frozen=True, slots=True, kw_only=True)
class Target:
    """Target of a move.

    Attributes:
        name: Its name in messages: that of the waypoint or the configuration, else ``pose``.
        waypoint: Waypoint of the object; empty if it is another kind of target.
        raised_m: Height above the waypoint or the frame.
        object: The object of the waypoint; empty for the object of the step.
        place: The place of the waypoints at the place; empty for the object's own.
        configuration_rad: Positions of the joints; empty if it is another kind of target.
        pose: Transform of the grasp-centre frame to the world, or to the named frame; None if it is another kind of
        target.
        frame: Named frame of the scene; empty if it is another kind of target.
    """

    name: str
    waypoint: str = ""
    raised_m: float = 0.0
    object: str = ""
    place: str = ""
    configuration_rad: tuple[float, ...] = ()
    pose: Pose | None = None
    frame: str = ""

    @property
    def mentions(self) -> tuple[Mention, ...]:
        """The things of the scene that it names."""
        return (
            Mention(kind=Named.OBJECT, name=self.object),
            Mention(kind=Named.PLACE, name=self.place, key=("place",)),
            Mention(kind=Named.FRAME, name=self.frame, key=("frame",) if self.pose is None else ("pose", "frame")),
        )


class MovingMachine(Protocol[Result_co]):
    """Machine that moves its arm."""

    def move(self, step: MoveStep) -> Result_co:
        """Move as a step says."""


@dataclass(frozen=True, slots=True, kw_only=True)
class MoveStep(TaskStep):
    """A move of the arm.

    Attributes:
        target: Its target.
        mode: Planned by a planner, straight line of the tool, or straight line in joint space.
        speed_share: Share of the tool speed of the design.
        limit_s: Longest planning time, if shorter than that of the design; None for that.
        resolution_rad: Greatest joint step between two checked states; None for that of the study.
        reached_rad: Greatest error of any joint at which the end counts as reached, a metre of a prismatic joint
        counting as a radian; None for that of the fidelity.
        control: Joint control; None for that of the study.
    """

    target: Target
    mode: MoveKind = MoveKind.PLANNED
    speed_share: float = 1.0
    limit_s: float | None = None
    resolution_rad: float | None = None
    reached_rad: float | None = None
    control: StepControl | None = None

    @property
    def mentions(self) -> tuple[Mention, ...]:
        """The things of the scene that its target names."""
        return self.target.mentions

    def run(self, machine: MovingMachine[Result]) -> Result:
        """Run it on a machine."""
        return machine.move(self)
