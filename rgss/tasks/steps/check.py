"""Check step: ends the task unless its conditions hold."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

from rgss.tasks.steps.base import Mention, Named, Result, Result_co, TaskStep


@dataclass(frozen=True, slots=True, kw_only=True)
class Nearness:
    """Condition on the distance of the centre of an object from a reference point, given in one of three ways.

    Attributes:
        within_m: Greatest distance.
        place: Place; the point is the centre of the object placed in its middle. Empty if not used.
        object: Object whose centre is the point; empty if not used.
        point_m: Point in the world; None if not used.
    """

    within_m: float
    place: str = ""
    object: str = ""
    point_m: tuple[float, float, float] | None = None


class CheckingMachine(Protocol[Result_co]):
    """Machine that observes objects."""

    def check(self, step: CheckStep) -> Result_co:
        """Evaluate the conditions of a step."""


@dataclass(frozen=True, slots=True, kw_only=True)
class CheckStep(TaskStep):
    """Conditions, all of which must hold.

    Attributes:
        object: The object; empty for the workpiece of the scene.
        at: Place region in which it must be placed; empty for no condition.
        is_upright: True if its tilt must be within that of its place region.
        is_at_rest: True if it must be settled.
        held: True if every finger must touch it, False if none may; None for no condition.
        near: Condition on its position; None for no condition.
    """

    object: str = ""
    at: str = ""
    is_upright: bool = False
    is_at_rest: bool = False
    held: bool | None = None
    near: Nearness | None = None

    @property
    def mentions(self) -> tuple[Mention, ...]:
        """The object and the places and objects of its conditions."""
        found = (
            Mention(kind=Named.OBJECT, name=self.object),
            Mention(kind=Named.PLACE, name=self.at, key=("at",)),
        )
        if self.near is None:
            return found
        return (
            *found,
            Mention(kind=Named.PLACE, name=self.near.place, key=("near", "place")),
            Mention(kind=Named.OBJECT, name=self.near.object, key=("near", "object")),
        )

    def run(self, machine: CheckingMachine[Result]) -> Result:
        """Run it on a machine."""
        return machine.check(self)
