"""Kinds of motion of a task's planned moves: the section ``moves`` of a study."""

from __future__ import annotations

from collections.abc import Mapping

from rgss.documents import Document
from rgss.findings import Finding
from rgss.tasks import MoveKind, TaskProgram


def read_moves(
    kinds: Mapping[str, str], task: TaskProgram, document: Document, findings: list[Finding]
) -> tuple[MoveKind, ...]:
    """Kinds of the planned moves of a task, as a study has them.

    Args:
        kinds: The section ``moves``: kind of motion by the name of a move.
        task: The task.
        document: The file, for positions.
        findings: Collects the problems.
    """
    for name in kinds:
        if name not in task.planned:
            hint = f"planned moves: {', '.join(task.planned)}"
            message = f"the task has no planned move {name!r}"
            findings.append(document.finding("study.move", message, ("moves", name), hint=hint, at_key=True))
    return tuple(MoveKind(kinds.get(name, "planned")) for name in task.planned)
