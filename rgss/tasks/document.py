"""The YAML form of a task."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from rgss.documents import DocumentModel, Identifier, JointPosition
from rgss.tasks.check_step import CheckEntry
from rgss.tasks.grip_step import GripEntry
from rgss.tasks.move_step import MoveEntry, TargetEntry
from rgss.tasks.release_step import ReleaseEntry
from rgss.tasks.step_settings import ThresholdsEntry
from rgss.tasks.wait_step import WaitEntry

MOST_REPETITIONS = 1000


class RepeatEntry(DocumentModel):
    """Steps that are carried out several times."""

    times: Annotated[int, Field(ge=0, le=MOST_REPETITIONS)]
    name: Identifier = "cycle"
    steps: tuple[StepEntry, ...]


class ForEachEntry(DocumentModel):
    """Steps that are carried out for each object, which is theirs where they name none."""

    objects: tuple[Identifier, ...]
    steps: tuple[StepEntry, ...]


class StepEntry(DocumentModel):
    """One step: exactly one of its kinds."""

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
    configurations: dict[Identifier, tuple[JointPosition, ...]] = Field(default_factory=dict)
    reached_within: ThresholdsEntry = ThresholdsEntry()
    steps: tuple[StepEntry, ...]
