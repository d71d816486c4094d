"""State machines: states and transitions."""

from __future__ import annotations

from enum import Enum

from pydantic.dataclasses import dataclass

from rgss.documents import STRICT, Identifier, Text
from rgss.requirements.fields import Entries


class StateKind(str, Enum):
    """Kind of a state of a state machine."""

    INITIAL = "initial"
    STATE = "state"
    FINAL = "final"
    FAILED = "failed"


@dataclass(frozen=True, slots=True, kw_only=True, config=STRICT)
class State:
    """A state of a state machine."""

    id: Identifier
    kind: StateKind
    name: Text
    phase: Identifier | None = None
    """Name of a phase of the task."""
    does: Identifier | None = None


@dataclass(frozen=True, slots=True, kw_only=True, config=STRICT)
class Transition:
    """A transition between two states of a state machine."""

    source: Identifier
    target: Identifier
    guard: Text | None = None
    failure: Identifier | None = None
    """A value of `rgss.evidence.Failure`."""


@dataclass(frozen=True, slots=True, kw_only=True, config=STRICT)
class StateMachine:
    """The states of a state machine."""

    states: Entries[State]
    transitions: Entries[Transition]
