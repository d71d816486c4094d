"""Document model of the opening of the hand, and its reading."""

from __future__ import annotations

from rgss.documents import DocumentModel, Identifier, Metres
from rgss.tasks.reading.control_entry import StepControlEntry, control_of
from rgss.tasks.reading.reader import Position, TaskReader
from rgss.tasks.steps import ReleaseStep


class ReleaseEntry(DocumentModel):
    """Opening of the hand at a place."""

    name: Identifier | None = None
    place: Identifier | None = None
    reached_within: Metres | None = None
    control: StepControlEntry | None = None

    def step(self, reader: TaskReader, position: Position) -> ReleaseStep:
        """The step, with findings in the reader."""
        reader.refuse_not_positive(position.at, reached_within=self.reached_within)
        return ReleaseStep(
            name=position.prefix + (self.name or "release"),
            place=self.place or "",
            opened_m=reader.thresholds.gripper if self.reached_within is None else self.reached_within,
            control=control_of(self.control, reader, position.at),
        )
