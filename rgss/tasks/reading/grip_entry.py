"""Document model of the closing of the hand, and its reading."""

from __future__ import annotations

from rgss.documents import DocumentModel, Identifier, Newtons, Seconds
from rgss.tasks.reading.control_entry import StepControlEntry, control_of
from rgss.tasks.reading.reader import Position, TaskReader
from rgss.tasks.steps import GripStep


class GripEntry(DocumentModel):
    """Closing of the hand on an object."""

    name: Identifier | None = None
    object: Identifier | None = None
    firm_above: Newtons | None = None
    firm_for: Seconds | None = None
    control: StepControlEntry | None = None

    def step(self, reader: TaskReader, position: Position) -> GripStep:
        """The step, with findings in the reader."""
        reader.refuse_not_positive(position.at, firm_above=self.firm_above, firm_for=self.firm_for)
        return GripStep(
            name=position.prefix + (self.name or "grip"),
            object=self.object or position.object,
            firm_above_n=self.firm_above,
            firm_s=self.firm_for,
            control=control_of(self.control, reader, position.at),
        )
