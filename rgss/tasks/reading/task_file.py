"""Reader of task files: unique names, and findings that do not depend on the scene."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from rgss.documents import Document, load_document
from rgss.errors import DocumentError
from rgss.findings import Finding
from rgss.tasks.program import TaskProgram
from rgss.tasks.reading.document import Placed, TaskDocument, placed_steps
from rgss.tasks.reading.hand_states import hand_findings
from rgss.tasks.reading.reader import Location, Position, TaskReader
from rgss.tasks.reading.target_entry import target_of
from rgss.tasks.steps import MoveStep


@dataclass(frozen=True, slots=True, kw_only=True)
class LoadedTask:
    """Task with the positions of its steps in the file."""

    program: TaskProgram
    document: Document
    places: tuple[Location, ...]


def load_task(path: Path, *, label: str | None = None) -> LoadedTask:
    """Read a task.

    Args:
        path: The file.
        label: The file's name in messages; the path by default.

    Raises:
        DocumentError: The file is invalid; with every problem in it.
    """
    loaded = load_document(path, TaskDocument, label=label)
    entry, document = loaded.value, loaded.document
    configurations = {name: tuple(joint.value for joint in joints) for name, joints in entry.configurations.items()}
    reader = TaskReader(document, configurations, entry.reached_within)
    thresholds = entry.reached_within
    reader.refuse_not_positive(("reached_within",), joints=thresholds.joints, gripper=thresholds.gripper)
    reader.refuse_not_positive((), time_limit=entry.time_limit)
    placed = list(placed_steps(entry.steps, reader, Position(at=("steps",))))
    start = None if entry.start is None else target_of(entry.start, reader, Position(at=("start",)))
    findings = reader.findings
    if not findings and not any(isinstance(step, MoveStep) for step, _ in placed):
        reader.report("task.no-move", "a task must have a move", ("steps",), "add a move")
    if not findings:
        findings += _name_findings(document, placed)
        findings += hand_findings(document, placed)
    if findings:
        raise DocumentError(sorted(set(findings)))
    steps = tuple(step for step, _ in placed)
    program = TaskProgram(id=entry.task, start=start, steps=steps, time_limit_s=entry.time_limit)
    return LoadedTask(program=program, document=document, places=tuple(place for _, place in placed))


def _name_findings(document: Document, placed: list[Placed]) -> Iterator[Finding]:
    """Findings about names of several steps, one for each step of the file: its cycles repeat the name."""
    seen: set[str] = set()
    reported: set[tuple[str | int, ...]] = set()
    for step, at in placed:
        if step.name in seen and at not in reported:
            reported.add(at)
            hint = "give each step its own name"
            yield document.finding("task.duplicate-name", f"there are two steps {step.name!r}", at, hint=hint)
        seen.add(step.name)
