"""Document model of a rest, and its reading."""

from __future__ import annotations

from rgss.documents import DocumentModel, Identifier, Seconds
from rgss.tasks.reading.control_entry import StepControlEntry, control_of
from rgss.tasks.reading.reader import Position, TaskReader
from rgss.tasks.steps import WaitStep


class WaitEntry(DocumentModel):
    """A rest of the arm."""

    duration: Seconds
    name: Identifier | None = None
    control: StepControlEntry | None = None

    def step(self, reader: TaskReader, position: Position) -> WaitStep:
        """The step, with findings in the reader."""
        reader.refuse_not_positive(position.at, duration=self.duration)
        return WaitStep(
            name=position.prefix + (self.name or "wait"),
            duration_s=self.duration,
            control=control_of(self.control, reader, position.at),
        )
