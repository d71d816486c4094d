"""Base of the steps of a task: what a step does to the hand, and what it names in the scene."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from typing import ClassVar, TypeVar

from rgss.tasks.steps.step_control import StepControl

Result = TypeVar("Result")
Result_co = TypeVar("Result_co", covariant=True)


class HandAction(Enum):
    """Effect of a step on the hand."""

    NONE = "none"
    """The hand remains as it is."""
    CLOSES = "closes"
    """An object is held after the step; none may be held before it."""
    OPENS = "opens"
    """The object that was held before the step is left at a place."""


class Named(Enum):
    """Kind of a thing of the scene that a step names."""

    OBJECT = "object"
    PLACE = "place"
    FRAME = "frame"


@dataclass(frozen=True, slots=True, kw_only=True)
class Mention:
    """A thing of the scene that a step names.

    Attributes:
        kind: Its kind.
        name: Its id; empty if the step leaves it to its default.
        key: Path of the key in the step's entry in a file; empty for the whole entry.
    """

    kind: Named
    name: str
    key: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class TaskStep:
    """A step of a task.

    Attributes:
        name: Name of the phase.
        hand: Its effect on the hand.
    """

    name: str
    hand: ClassVar[HandAction] = HandAction.NONE

    @property
    def object(self) -> str:
        """The object that it concerns; empty for the workpiece of the scene."""
        return ""

    @property
    def place(self) -> str:
        """The place at which it leaves the object; empty for the object's own place region."""
        return ""

    @property
    def control(self) -> StepControl | None:
        """Joint control; None for that of the study."""
        return None

    @property
    def mentions(self) -> tuple[Mention, ...]:
        """The things of the scene that it names."""
        return ()
