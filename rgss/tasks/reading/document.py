"""Document model of a task: its steps, of one kind each, and the loops that are expanded."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Annotated, Protocol

from pydantic import Field

from rgss.documents import DocumentModel, Identifier, JointPosition, Seconds
from rgss.tasks.reading.check_entry import CheckEntry
from rgss.tasks.reading.grip_entry import GripEntry
from rgss.tasks.reading.move_entry import MoveEntry
from rgss.tasks.reading.neutral_entry import NeutralEntry
from rgss.tasks.reading.reader import Location, Position, TaskReader
from rgss.tasks.reading.release_entry import ReleaseEntry
from rgss.tasks.reading.target_entry import TargetEntry
from rgss.tasks.reading.thresholds_entry import ThresholdsEntry
from rgss.tasks.reading.wait_entry import WaitEntry
from rgss.tasks.steps import Step

MOST_REPETITIONS = 1000
Placed = tuple[Step, Location]
"""A step, and its location in the file."""


class KindEntry(Protocol):
    """Entry of a kind of step."""

    def step(self, reader: TaskReader, position: Position) -> Step:
        """The step, with findings in the reader."""


class RepeatEntry(DocumentModel):
    """Steps that are repeated."""

    times: Annotated[int, Field(ge=0, le=MOST_REPETITIONS)]
    name: Identifier = "cycle"
    steps: tuple[StepEntry, ...]

    def expanded(self, reader: TaskReader, position: Position) -> Iterator[Placed]:
        """The steps of each turn, with findings in the reader."""
        if not self.steps:
            reader.report("task.empty", "the loop has no steps to repeat", position.at, "add steps, or remove the loop")
        elif self.times == 0:
            message = "the loop is repeated 0 times"
            reader.report("task.empty", message, (*position.at, "times"), "write a number from 1, or remove the loop")
        for turn in range(1, self.times + 1):
            if reader.is_too_long(position.at):
                return
            prefix = f"{position.prefix}{self.name}_{turn}."
            inner = Position(at=(*position.at, "steps"), prefix=prefix, object=position.object)
            yield from placed_steps(self.steps, reader, inner)


class ForEachEntry(DocumentModel):
    """Steps that are repeated for each object, their default object."""

    objects: tuple[Identifier, ...]
    steps: tuple[StepEntry, ...]

    def expanded(self, reader: TaskReader, position: Position) -> Iterator[Placed]:
        """The steps for each object, with findings in the reader."""
        if not self.objects or not self.steps:
            reader.report("task.empty", "the loop has no steps to repeat", position.at, "add objects and steps")
        for one in self.objects:
            if reader.is_too_long(position.at):
                return
            inner = Position(at=(*position.at, "steps"), prefix=f"{position.prefix}{one}.", object=one)
            yield from placed_steps(self.steps, reader, inner)


class StepEntry(DocumentModel):
    """One step, of exactly one kind."""

    move: MoveEntry | None = None
    grip: GripEntry | None = None
    release: ReleaseEntry | None = None
    neutral: NeutralEntry | None = None
    wait: WaitEntry | None = None
    check: CheckEntry | None = None
    repeat: RepeatEntry | None = None
    for_each: ForEachEntry | None = None

    @property
    def stated(self) -> dict[str, KindEntry | RepeatEntry | ForEachEntry]:
        """The stated kinds by key."""
        kinds = {kind: getattr(self, kind) for kind in type(self).model_fields}
        return {kind: one for kind, one in kinds.items() if one is not None}


class TaskDocument(DocumentModel):
    """A task file."""

    task: Identifier
    start: TargetEntry | None = None
    time_limit: Seconds | None = None
    configurations: dict[Identifier, tuple[JointPosition, ...]] = Field(default_factory=dict)
    reached_within: ThresholdsEntry = ThresholdsEntry()
    steps: tuple[StepEntry, ...]


def placed_steps(entries: Iterable[StepEntry], reader: TaskReader, position: Position) -> Iterator[Placed]:
    """Steps of entries with loops expanded, and findings in the reader."""
    for index, entry in enumerate(entries):
        if len(entry.stated) != 1:
            said = " and ".join(entry.stated) or "none"
            message = f"a step has exactly one kind, got {said}"
            reader.report("task.kind", message, (*position.at, index), ", ".join(StepEntry.model_fields))
            continue
        [(key, one)] = entry.stated.items()
        here = position.within(index, key)
        if isinstance(one, (RepeatEntry, ForEachEntry)):
            yield from one.expanded(reader, here)
            continue
        reader.count_step()
        if reader.is_too_long(here.at):
            return
        yield one.step(reader, here), here.at
