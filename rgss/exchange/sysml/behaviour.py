"""Behaviours as SysML v2 use cases, actions, states and occurrences."""

from __future__ import annotations

from collections.abc import Iterator

from rgss.exchange.sysml.notation import body, comment, declared, documentation, name
from rgss.exchange.sysml.structure import PARTS, Parts
from rgss.requirements import Behaviour, BehaviourKind
from rgss.requirements.behaviour import Flow, FlowNode, FlowNodeKind, Interaction, StateKind, StateMachine

BEHAVIOUR = "Behaviour"

_KEYWORDS = {
    BehaviourKind.USE_CASE: "use case",
    BehaviourKind.ACTIVITY: "action",
    BehaviourKind.SEQUENCE: "occurrence",
    BehaviourKind.STATE_MACHINE: "state",
}
_CONTROL_NODES = {
    FlowNodeKind.DECISION: "decide",
    FlowNodeKind.MERGE: "merge",
    FlowNodeKind.FORK: "fork",
    FlowNodeKind.JOIN: "join",
}


def behaviour(each: Behaviour, parts: Parts) -> list[str]:
    """One behaviour with its flow, its messages or its states."""
    return body(declared(_KEYWORDS[each.kind], each.id, each.name), _lines(each, parts))


def reference(behaviour_id: str) -> str:
    """A behaviour's name from anywhere in the model."""
    return f"{name(BEHAVIOUR)}::{name(behaviour_id)}"


def _lines(each: Behaviour, parts: Parts) -> Iterator[str]:
    yield documentation(each.text)
    if each.kind is BehaviourKind.USE_CASE:
        yield from (f"actor {name(actor)} : {name(PARTS)}::{name(actor)};" for actor in each.actors)
        yield from (f"include use case ::> {reference(other)};" for other in each.includes)
    if each.flow is not None:
        yield from _flow(each.flow)
    if each.interaction is not None:
        yield from _interaction(each.interaction, parts)
    if each.machine is not None:
        yield from _machine(each.machine)


def _guards(texts: Iterator[str | None]) -> Iterator[str]:
    """Truth values named by the guards, which are prose."""
    return (f"attribute {name(text)} : Boolean;" for text in dict.fromkeys(texts) if text)


def _flow(flow: Flow) -> Iterator[str]:
    yield from _guards(edge.guard for edge in flow.edges)
    places = {node.id: _place(node) for node in flow.nodes}
    for node in flow.nodes:
        yield from _node(node)
    for edge in flow.edges:
        guard = f" if {name(edge.guard)}" if edge.guard else ""
        head = "succession first" if edge.guard else "first"
        yield f"{head} {places[edge.source]}{guard} then {places[edge.target]};"


def _place(node: FlowNode) -> str:
    return {FlowNodeKind.INITIAL: "start", FlowNodeKind.FINAL: "done"}.get(node.kind, name(node.id))


def _node(node: FlowNode) -> list[str]:
    text = [documentation(node.text)] if node.text else []
    if node.kind in (FlowNodeKind.INITIAL, FlowNodeKind.FINAL):
        return []
    if node.kind is FlowNodeKind.ACTION:
        called = f" ::> {reference(node.does)}" if node.does else ""
        return body(f"action {name(node.id)}{called}", text)
    return body(f"{_CONTROL_NODES[node.kind]} {name(node.id)}", text)


def _machine(machine: StateMachine) -> Iterator[str]:
    yield from _guards(transition.guard for transition in machine.transitions)
    kinds = {state.id: state.kind for state in machine.states}
    for transition in machine.transitions:
        if kinds[transition.source] is StateKind.INITIAL:
            yield "entry;"
            yield f"then {name(transition.target)};"
    for state in machine.states:
        if state.kind in (StateKind.STATE, StateKind.FAILED):
            inner = [documentation(state.name + (f" (task phase {state.phase})" if state.phase else ""))]
            inner += [f"do {reference(state.does)};"] if state.does else []
            yield from body(f"state {name(state.id)}", inner)
    for transition in machine.transitions:
        if kinds[transition.source] is not StateKind.INITIAL:
            guard = f" if {name(transition.guard)}" if transition.guard else ""
            target = "done" if kinds[transition.target] is StateKind.FINAL else name(transition.target)
            yield f"transition first {name(transition.source)}{guard} then {target};"


def _interaction(interaction: Interaction, parts: Parts) -> Iterator[str]:
    for lifeline in interaction.lifelines:
        yield f"ref part {name(lifeline)} ::> {parts.path(lifeline)};"
    for message in interaction.messages:
        text = f"{'Reply: ' if message.reply else ''}{message.text}"
        text += f" (sets off {message.does})" if message.does else ""
        yield f"message {name(message.id)} from {name(message.source)} to {name(message.target)};"
        yield comment(message.id, text)
    for before, after in zip(interaction.messages, interaction.messages[1:], strict=False):
        yield f"first {name(before.id)} then {name(after.id)};"
    for number, timing in enumerate(interaction.timings, start=1):
        text = f"{timing.text} From {timing.first} to {timing.last}; bounded by the criterion of {timing.criterion_of}."
        yield from body(f"constraint {name(f'timing {number}')}", [documentation(text)])
