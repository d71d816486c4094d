"""Findings about the hand's state: the held object before each step, and the step's precondition."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from rgss.documents import Document
from rgss.findings import Finding
from rgss.tasks.reading.reader import Location
from rgss.tasks.steps import HandAction, MoveStep, Step


def hand_findings(document: Document, placed: Sequence[tuple[Step, Location]]) -> Iterator[Finding]:
    """A finding for each step whose precondition on the hand fails, and for a task that ends with a held object."""
    is_held = False
    for index, (step, at) in enumerate(placed):
        if step.hand is HandAction.CLOSES:
            if is_held:
                message = f"{step.name!r} grips while an object is held"
                yield document.finding("task.grip", message, at, hint="add a release before it")
            if not index or not isinstance(placed[index - 1][0], MoveStep):
                message = f"{step.name!r} needs a move before it that brings the hand to the object"
                yield document.finding("task.grip", message, at, hint="add a move to grasp before it")
            is_held = True
        elif step.hand is HandAction.OPENS:
            if not is_held:
                message = f"{step.name!r} releases, and nothing is held"
                yield document.finding("task.release", message, at, hint="add a grip before it")
            is_held = False
