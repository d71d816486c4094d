"""Document model of the neutral state of the hand, and its reading."""

from __future__ import annotations

from rgss.documents import DocumentModel, Identifier
from rgss.tasks.reading.control_entry import StepControlEntry, control_of
from rgss.tasks.reading.reader import Position, TaskReader
from rgss.tasks.steps import NeutralStep


class NeutralEntry(DocumentModel):
    """The drive of the hand is switched off."""

    name: Identifier | None = None
    control: StepControlEntry | None = None

    def step(self, reader: TaskReader, position: Position) -> NeutralStep:
        """The step, with findings in the reader."""
        name = position.prefix + (self.name or "neutral")
        return NeutralStep(name=name, control=control_of(self.control, reader, position.at))
