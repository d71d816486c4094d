"""Consistency of the states and transitions of a state machine."""

from __future__ import annotations

from collections.abc import Iterator

from rgss.findings import Finding
from rgss.requirements.behaviour import State, StateKind, StateMachine
from rgss.requirements.checks.inner_ids import At, reached_from, repeated, unknown
from rgss.requirements.hints import Hints
from rgss.requirements.references import Declaration

_STATES: At = ("machine", "states")
_TRANSITIONS: At = ("machine", "transitions")
_ENDS = (StateKind.FINAL, StateKind.FAILED)


def check_machine(declaration: Declaration, machine: StateMachine, hints: Hints) -> Iterator[Finding]:
    """Findings on a state machine.

    Args:
        declaration: The behaviour.
        machine: Its states.
        hints: Finder of the nearest known id.
    """
    yield from repeated(declaration, _STATES, [state.id for state in machine.states])
    initial = [state.id for state in machine.states if state.kind is StateKind.INITIAL]
    if len(initial) != 1:
        yield _broken(declaration, f"a machine has 1 initial state, this one has {len(initial)}", _STATES)
    if all(state.kind is not StateKind.FINAL for state in machine.states):
        yield _broken(declaration, "a machine has a final state, this one has none", _STATES)
    reached = reached_from(initial, ((way.source, way.target) for way in machine.transitions))
    sources = frozenset(way.source for way in machine.transitions)
    targets = frozenset(way.target for way in machine.transitions)
    phases: set[str] = set()
    for index, state in enumerate(machine.states):
        at = (*_STATES, index)
        yield from _check_state(declaration, state, at, reached=state.id in targets, left=state.id in sources)
        if initial and state.id not in reached:
            yield _broken(declaration, f"state {state.id!r} is never reached", (*at, "id"))
        if state.phase is not None and state.phase in phases:
            yield _broken(declaration, f"phase {state.phase!r} is two states", (*at, "phase"))
        phases.update([state.phase] if state.phase is not None else [])
    yield from _check_transitions(declaration, machine, hints)


def _check_state(declaration: Declaration, state: State, at: At, *, reached: bool, left: bool) -> Iterator[Finding]:
    kind = f"{state.kind.value} state" if state.kind is not StateKind.STATE else "state"
    if state.kind in _ENDS and left:
        yield _broken(declaration, f"{kind} {state.id!r} is left by a transition", at)
    if state.kind not in _ENDS and not left:
        yield _broken(declaration, f"{kind} {state.id!r} is never left", at)
    if state.kind is StateKind.INITIAL and reached:
        yield _broken(declaration, f"{kind} {state.id!r} is reached by a transition", at)
    for key, stated in (("phase", state.phase), ("does", state.does)):
        if stated is not None and state.kind is not StateKind.STATE:
            yield _broken(declaration, f"{kind} {state.id!r} has a {key!r}; only a plain state has", (*at, key))


def _check_transitions(declaration: Declaration, machine: StateMachine, hints: Hints) -> Iterator[Finding]:
    ids = {state.id: None for state in machine.states}
    failed = {state.id for state in machine.states if state.kind is StateKind.FAILED}
    seen: set[tuple[str, str | None, str | None]] = set()
    for index, way in enumerate(machine.transitions):
        at = (*_TRANSITIONS, index)
        yield from unknown(declaration, (*at, "source"), way.source, ids, "state of the machine", hints)
        yield from unknown(declaration, (*at, "target"), way.target, ids, "state of the machine", hints)
        if way.failure is not None and way.target in ids and way.target not in failed:
            yield _broken(declaration, f"failure {way.failure!r} does not lead to a failed state", (*at, "failure"))
        if way.failure is None and way.target in failed:
            yield _broken(declaration, f"the transition to {way.target!r} names no failure", at)
        if (way.source, way.guard, way.failure) in seen:
            yield _broken(declaration, f"two transitions leave {way.source!r} on the same condition", at)
        seen.add((way.source, way.guard, way.failure))


def _broken(declaration: Declaration, message: str, at: At) -> Finding:
    return declaration.finding("machine", message, at)
