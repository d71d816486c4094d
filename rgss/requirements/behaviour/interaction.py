"""Sequences: messages between blocks, and timing constraints."""

from __future__ import annotations

from pydantic.dataclasses import dataclass

from rgss.documents import STRICT, Identifier, Text
from rgss.requirements.fields import Entries


@dataclass(frozen=True, slots=True, kw_only=True, config=STRICT)
class Message:
    """A message of a sequence."""

    id: Identifier
    source: Identifier
    target: Identifier
    text: Text
    does: Identifier | None = None
    reply: bool = False


@dataclass(frozen=True, slots=True, kw_only=True, config=STRICT)
class TimingConstraint:
    """A bound on the time between two messages of a sequence."""

    first: Identifier
    last: Identifier
    criterion_of: Identifier
    text: Text


@dataclass(frozen=True, slots=True, kw_only=True, config=STRICT)
class Interaction:
    """The messages of a sequence."""

    lifelines: Entries[Identifier]
    messages: Entries[Message]
    timings: tuple[TimingConstraint, ...] = ()
