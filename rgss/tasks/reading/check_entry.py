"""Document model of a check, and its reading."""

from __future__ import annotations

from rgss.documents import DocumentModel, Identifier, Metres
from rgss.tasks.reading.reader import Position, TaskReader
from rgss.tasks.steps import CheckStep, Nearness


class NearEntry(DocumentModel):
    """Greatest distance of the object from exactly one of a place, another object and a point of the world."""

    within: Metres
    place: Identifier | None = None
    object: Identifier | None = None
    point: tuple[Metres, Metres, Metres] | None = None

    def nearness(self, reader: TaskReader, position: Position) -> Nearness:
        """The condition, with findings in the reader."""
        given = [key for key in ("place", "object", "point") if getattr(self, key) is not None]
        if len(given) != 1:
            said = " and ".join(given) or "none"
            message = f"near needs one of place, object and point, got {said}"
            reader.report("task.near", message, position.at, "name one")
        reader.refuse_not_positive(position.at, within=self.within)
        return Nearness(within_m=self.within, place=self.place or "", object=self.object or "", point_m=self.point)


class CheckEntry(DocumentModel):
    """Conditions, all of which must hold."""

    name: Identifier | None = None
    object: Identifier | None = None
    at: Identifier | None = None
    upright: bool = False
    at_rest: bool = False
    held: bool | None = None
    near: NearEntry | None = None

    def step(self, reader: TaskReader, position: Position) -> CheckStep:
        """The step, with findings in the reader."""
        if not (self.at or self.upright or self.at_rest or self.held is not None or self.near):
            hint = "write at, near, upright, at_rest or held"
            reader.report("task.empty", "the check states no condition", position.at, hint)
        return CheckStep(
            name=position.prefix + (self.name or "check"),
            object=self.object or position.object,
            at=self.at or "",
            is_upright=self.upright,
            is_at_rest=self.at_rest,
            held=self.held,
            near=None if self.near is None else self.near.nearness(reader, position.within("near")),
        )
