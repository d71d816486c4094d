"""State machines: states, and what leads from one to the next."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum


class StateKind(str, Enum):
    """Where a state stands in its machine."""

    INITIAL = "initial"
    STATE = "state"
    FINAL = "final"
    FAILED = "failed"


@dataclass(frozen=True, slots=True, kw_only=True)
class State:
    """One state.

    Attributes:
        id: Its id, unique within the machine.
        kind: Where it stands.
        name: What it is called.
        phase: The task phase that it is, a value of ``rgss.evidence.Phase``; empty if it is none.
        does: Id of the behaviour that runs in it; None if none.
    """

    id: str
    kind: StateKind
    name: str
    phase: str
    does: str | None


@dataclass(frozen=True, slots=True, kw_only=True)
class Transition:
    """One way from state to state.

    Attributes:
        source: Id of the state that it leaves.
        target: Id of the state that it reaches.
        guard: When it is taken; empty if as soon as the state is complete.
        failure: The failure that takes it, a value of ``rgss.evidence.Failure``; empty if none.
    """

    source: str
    target: str
    guard: str
    failure: str


@dataclass(frozen=True, slots=True, kw_only=True)
class StateMachine:
    """What a state diagram shows.

    Attributes:
        states: The states, in the file's order.
        transitions: The ways between them, in the file's order.
    """

    states: tuple[State, ...]
    transitions: tuple[Transition, ...]
