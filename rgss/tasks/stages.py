"""Stages: the steps of a task with their context, derived from the steps before and after."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import takewhile

from rgss.tasks.program import TaskProgram
from rgss.tasks.steps import HandAction, MoveStep, Step


@dataclass(frozen=True, slots=True, kw_only=True)
class Stage:
    """A step of a task in its context.

    Attributes:
        step: The step.
        object: The object of the step: the held one, else the last released one, else the next one.
        place: The place of its next or last release; empty for its own place region.
        turn: Number, from 1, of the grip of the object that the step precedes, belongs to or follows.
        is_held: Whether the object is held during the step, including closing and opening of the hand.
        is_standing: Whether no move has ended since the grip, so that the held object may touch its support.
        is_approach: Whether the step after this move closes the hand, and the one before did not open it.
        is_retreat: Whether the step before this move opened the hand.
        is_placed: Whether the object was released before the step and is not gripped again after it.
    """

    step: Step
    object: str
    place: str
    turn: int
    is_held: bool = False
    is_standing: bool = False
    is_approach: bool = False
    is_retreat: bool = False
    is_placed: bool = False

    @property
    def is_carrying(self) -> bool:
        """True for a move with an object in the hand."""
        return self.is_held and isinstance(self.step, MoveStep)

    @property
    def is_leaving(self) -> bool:
        """True for the first move since the grip, which lifts the object off its support."""
        return self.is_standing and isinstance(self.step, MoveStep)


def stages_of(task: TaskProgram, workpiece: str) -> tuple[Stage, ...]:
    """Stages of a task.

    Args:
        task: The task.
        workpiece: The default object of steps.
    """
    steps, lifts = task.steps, dict[str, int]()
    held, last = "", ""
    found = []
    for index, step in enumerate(steps):
        before = steps[index - 1] if index else None
        after = steps[index + 1] if index + 1 < len(steps) else None
        is_move, closes = isinstance(step, MoveStep), step.hand is HandAction.CLOSES
        is_retreat = is_move and before is not None and before.hand is HandAction.OPENS
        if closes:
            held = last = step.object or workpiece
            lifts[held] = lifts.get(held, 0) + 1
        coming = "" if held or is_retreat else _next_gripped(steps[index:], workpiece)
        subject = held or coming or last or workpiece
        found.append(
            Stage(
                step=step,
                object=subject,
                place=_next_place(steps[index:]) if held or coming else _last_place(steps[:index]),
                turn=lifts.get(subject, 0) + (1 if coming else 0),
                is_held=bool(held),
                is_standing=bool(held) and (closes or not _has_moved(steps[:index])),
                is_approach=is_move
                and not (held or is_retreat)
                and after is not None
                and after.hand is HandAction.CLOSES,
                is_retreat=is_retreat,
                is_placed=bool(last) and not held and not coming,
            )
        )
        if step.hand is HandAction.OPENS:
            held = ""
    return tuple(found)


def _next_gripped(steps: tuple[Step, ...], workpiece: str) -> str:
    return next((step.object or workpiece for step in steps if step.hand is HandAction.CLOSES), "")


def _next_place(steps: tuple[Step, ...]) -> str:
    return next((step.place for step in steps if step.hand is HandAction.OPENS), "")


def _last_place(steps: tuple[Step, ...]) -> str:
    return _next_place(steps[::-1])


def _has_moved(before: tuple[Step, ...]) -> bool:
    """True if a move has followed the last grip."""
    since = takewhile(lambda step: step.hand is not HandAction.CLOSES, reversed(before))
    return any(isinstance(step, MoveStep) for step in since)
