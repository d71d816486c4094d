"""Consistency of an activity's flow: one initial node, a final node, and deterministic paths between them."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator

from rgss.findings import Finding
from rgss.requirements.behaviour import Flow, FlowNode, FlowNodeKind
from rgss.requirements.checks.inner_ids import At, reached_from, repeated, unknown
from rgss.requirements.hints import Hints
from rgss.requirements.references import Declaration

_NODES: At = ("flow", "nodes")
_EDGES: At = ("flow", "edges")
_WITH_TEXT = (FlowNodeKind.ACTION, FlowNodeKind.DECISION)
_DIVIDING = (FlowNodeKind.DECISION, FlowNodeKind.FORK)
_JOINING = (FlowNodeKind.MERGE, FlowNodeKind.JOIN, FlowNodeKind.FINAL)


def check_flow(declaration: Declaration, flow: Flow, hints: Hints) -> Iterator[Finding]:
    """Findings on a flow.

    Args:
        declaration: The activity.
        flow: Its flow.
        hints: Finder of the nearest known id.
    """
    yield from repeated(declaration, _NODES, [node.id for node in flow.nodes])
    ids = {node.id: None for node in flow.nodes}
    for index, edge in enumerate(flow.edges):
        yield from unknown(declaration, (*_EDGES, index, "source"), edge.source, ids, "node of the flow", hints)
        yield from unknown(declaration, (*_EDGES, index, "target"), edge.target, ids, "node of the flow", hints)
    initial = [node.id for node in flow.nodes if node.kind is FlowNodeKind.INITIAL]
    if len(initial) != 1:
        yield _broken(declaration, f"a flow has 1 initial node, this one has {len(initial)}", _NODES)
    if all(node.kind is not FlowNodeKind.FINAL for node in flow.nodes):
        yield _broken(declaration, "a flow has a final node, this one has none", _NODES)
    reached = reached_from(initial, ((edge.source, edge.target) for edge in flow.edges))
    arriving = Counter(edge.target for edge in flow.edges)
    leaving = Counter(edge.source for edge in flow.edges)
    for index, node in enumerate(flow.nodes):
        at = (*_NODES, index)
        yield from _check_node(declaration, node, at)
        yield from _check_ways(declaration, node, at, arriving=arriving[node.id], leaving=leaving[node.id])
        if initial and node.id not in reached:
            yield _broken(declaration, f"node {node.id!r} is never reached", (*at, "id"))
    yield from _check_guards(declaration, flow)


def _check_node(declaration: Declaration, node: FlowNode, at: At) -> Iterator[Finding]:
    if node.kind in _WITH_TEXT and node.text is None:
        yield _broken(declaration, f"{node.kind.value} {node.id!r} has no text", at)
    if node.kind is not FlowNodeKind.ACTION and node.does is not None:
        yield _broken(declaration, f"{node.kind.value} {node.id!r} does nothing; only an action does", (*at, "does"))


def _check_ways(declaration: Declaration, node: FlowNode, at: At, *, arriving: int, leaving: int) -> Iterator[Finding]:
    subject = f"{node.kind.value} {node.id!r}"
    if node.kind is FlowNodeKind.INITIAL and arriving:
        yield _broken(declaration, f"{subject} is reached by an edge", at)
    if node.kind is FlowNodeKind.FINAL and leaving:
        yield _broken(declaration, f"{subject} is left by an edge", at)
    if node.kind in _DIVIDING and leaving < 2:
        yield _broken(declaration, f"{subject} is left by {leaving} edges, not by 2 or more", at)
    if node.kind not in (*_DIVIDING, FlowNodeKind.FINAL) and leaving != 1:
        hint = "put a decision or a fork behind it" if leaving else "lead it to a final node"
        yield _broken(declaration, f"{subject} is left by {leaving} edges, not by 1", at, hint=hint)
    if node.kind not in _JOINING and arriving > 1:
        yield _broken(
            declaration, f"{subject} is reached by {arriving} edges", at, hint="put a merge or a join before it"
        )
    if node.kind in (FlowNodeKind.MERGE, FlowNodeKind.JOIN) and arriving < 2:
        yield _broken(declaration, f"{subject} is reached by {arriving} edges, not by 2 or more", at)


def _check_guards(declaration: Declaration, flow: Flow) -> Iterator[Finding]:
    decisions = {node.id for node in flow.nodes if node.kind is FlowNodeKind.DECISION}
    seen: set[tuple[str, str | None]] = set()
    for index, edge in enumerate(flow.edges):
        at = (*_EDGES, index)
        if edge.source not in decisions:
            if edge.guard is not None:
                message = f"the edge from {edge.source!r} has a guard, but leaves no decision"
                yield _broken(declaration, message, (*at, "guard"))
        elif edge.guard is None:
            yield _broken(declaration, f"the edge from decision {edge.source!r} has no guard", at)
        elif (edge.source, edge.guard) in seen:
            message = f"two edges leave decision {edge.source!r} with the same guard"
            yield _broken(declaration, message, (*at, "guard"))
        seen.add((edge.source, edge.guard))


def _broken(declaration: Declaration, message: str, at: At, *, hint: str = "") -> Finding:
    return declaration.finding("flow", message, at, hint=hint)
