"""Diagrams of behaviour that are graphs: use cases, activities, state machines."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace

from rgss.reports.diagrams.drawing import Drawing, draw_graph
from rgss.reports.diagrams.frame import Heading
from rgss.reports.diagrams.graph import Cluster, Edge, Graph, Node, Shape
from rgss.requirements import Behaviour, BehaviourKind, Block
from rgss.requirements.behaviour import Flow, FlowNode, FlowNodeKind, State, StateKind, StateMachine

_SYSTEM = "system"
_LONGEST_LABEL = 4
"""With more failures than this on one edge, they are listed in the state that it leaves."""

_FLOW_SHAPES = {
    FlowNodeKind.INITIAL: Shape.INITIAL,
    FlowNodeKind.ACTION: Shape.ROUND,
    FlowNodeKind.DECISION: Shape.DIAMOND,
    FlowNodeKind.MERGE: Shape.DIAMOND,
    FlowNodeKind.FORK: Shape.BAR,
    FlowNodeKind.JOIN: Shape.BAR,
    FlowNodeKind.FINAL: Shape.FINAL,
}


def use_case_diagram(behaviours: Iterable[Behaviour], blocks: Iterable[Block]) -> Drawing | None:
    """Draw all use cases with their actors; None if there is no use case.

    Args:
        behaviours: The behaviours of the model; only use cases are drawn.
        blocks: Its structure, for the names of actors.

    Raises:
        DefinitionError: The package ``pygraphviz`` is not installed.
    """
    cases = {one.id: one for one in behaviours if one.kind is BehaviourKind.USE_CASE}
    if not cases:
        return None
    names = {block.id: block.name for block in blocks}
    actors = dict.fromkeys(actor for case in cases.values() for actor in case.actors)
    nodes = [
        Node(id=actor, shape=Shape.ACTOR, name=names.get(actor, actor), texts=(actor,), tint="") for actor in actors
    ]
    nodes += [
        Node(id=case.id, shape=Shape.ELLIPSE, name=case.name, texts=(case.id,), tint="behaviour", cluster=_SYSTEM)
        for case in cases.values()
    ]
    edges = [Edge(source=actor, target=case.id, head="") for case in cases.values() for actor in case.actors]
    edges += [
        Edge(source=case.id, target=other, dashed=True, labels=("«include»",))
        for case in cases.values()
        for other in case.includes
        if other in cases
    ]
    return draw_graph(
        Graph(
            nodes=tuple(nodes),
            edges=tuple(edges),
            clusters=(Cluster(id=_SYSTEM, title="System of interest"),),
            rightwards=True,
            node_width=150.0,
        ),
        heading=Heading(kind="uc", element="Package", subject="Use cases"),
        name="use-cases",
        title="Use-case diagram",
        description=f"{len(cases)} use cases and {len(actors)} actors.",
        text_alternative=" ".join(
            f"{edge.source} {'includes' if edge.labels else 'takes part in'} {edge.target}." for edge in edges
        ),
    )


def activity_diagram(activity: Behaviour, names: Mapping[str, str]) -> Drawing | None:
    """Activity diagram: actions and their order; None while its flow is open.

    Each performer of its actions has a lane.

    Raises:
        DefinitionError: The package ``pygraphviz`` is not installed.
    """
    flow = activity.flow
    if flow is None:
        return None
    edges = tuple(
        Edge(
            source=edge.source,
            target=edge.target,
            head="filled",
            labels=(f"[{edge.guard}]",) if edge.guard else (),
        )
        for edge in flow.edges
    )
    performers = lanes_of(flow)
    lanes = tuple(Cluster(id=name, title=names.get(name, name)) for name in dict.fromkeys(performers.values()))
    nodes = tuple(replace(_flow_node(node), cluster=performers.get(node.id, "")) for node in flow.nodes)
    return draw_graph(
        Graph(nodes=nodes, edges=edges, lanes=lanes, node_width=190.0 if lanes else 230.0),
        heading=Heading(kind="act", element="Activity", subject=activity.name),
        name=f"activity-{activity.id}",
        title=f"Activity diagram: {activity.name}",
        description=f"{activity.id}: {activity.text}",
        text_alternative=" ".join(
            [
                _describe(edges, {node.id: node.text or node.kind.value for node in flow.nodes}),
                *(f"{names.get(performer, performer)} performs: {node.text}" for node, performer in _performed(flow)),
            ]
        ),
    )


def lanes_of(flow: Flow) -> dict[str, str]:
    """The performer in whose lane each node of a flow stands, by the node's id; empty without performers.

    A node that nobody performs stands with what is before it, such as a decision with the action
    whose outcome it looks at; a merge, and what is before the first action, with what it leads to.
    """
    lanes = {node.id: performer for node, performer in _performed(flow)}
    if not lanes:
        return {}
    *start, action = _to_the_first_action(flow, lanes)
    lanes |= dict.fromkeys(start, lanes[action])
    merges = {node.id for node in flow.nodes if node.kind is FlowNodeKind.MERGE}
    while len(lanes) < len(flow.nodes):
        before = len(lanes)
        for edge in flow.edges:
            source, target = edge.source, edge.target
            if target not in lanes and source in lanes and target not in merges:
                lanes[target] = lanes[source]
            if source not in lanes and target in lanes and source in merges:
                lanes[source] = lanes[target]
        if len(lanes) == before:
            # A merge that leads to no action stands with the last that leads to it.
            ways = [edge for edge in flow.edges if edge.source in lanes and edge.target not in lanes]
            lanes[ways[-1].target] = lanes[ways[-1].source]
    return lanes


def _to_the_first_action(flow: Flow, performed: Mapping[str, str]) -> list[str]:
    """The nodes from the initial one to the action that is fewest steps away."""
    ways = {node.id: [node.id] for node in flow.nodes if node.kind is FlowNodeKind.INITIAL}
    for name in (queue := list(ways)):
        if name in performed:
            return ways[name]
        for edge in flow.edges:
            if edge.source == name and edge.target not in ways:
                ways[edge.target] = [*ways[name], edge.target]
                queue.append(edge.target)
    return [next(iter(performed))]  # not reached: every node of a flow is reached from its initial one


def _performed(flow: Flow) -> list[tuple[FlowNode, str]]:
    return [(node, node.performer) for node in flow.nodes if node.performer is not None]


def state_diagram(behaviour: Behaviour) -> Drawing | None:
    """State diagram: states and transitions; None while the machine is open.

    Transitions with the same ends are one arrow with a line for each.

    Raises:
        DefinitionError: The package ``pygraphviz`` is not installed.
    """
    machine = behaviour.machine
    if machine is None:
        return None
    edges = tuple(_transitions(machine))
    # A long list beside one of many long ways cannot be seen to belong to it; it stands in its state.
    listed = {edge.source: ", ".join(edge.labels) for edge in edges if _is_listed(edge)}
    nodes = tuple(_state_node(state, listed.get(state.id, "")) for state in machine.states)
    short = tuple(
        replace(edge, labels=(f"any of its {len(edge.labels)} failures",)) if _is_listed(edge) else edge
        for edge in edges
    )
    return draw_graph(
        Graph(nodes=nodes, edges=short, node_width=300.0 if listed else 240.0),
        heading=Heading(kind="stm", element="State Machine", subject=behaviour.name),
        name=f"states-{behaviour.id}",
        title=f"State diagram: {behaviour.name}",
        description=f"{behaviour.id}: {behaviour.text}",
        text_alternative=_describe(edges, {state.id: state.name for state in machine.states}),
    )


def _flow_node(node: FlowNode) -> Node:
    shape = _FLOW_SHAPES[node.kind]
    texts = (f"calls {node.does}",) if node.does else ()
    tint = "behaviour" if shape is Shape.ROUND else ""
    return Node(id=node.id, shape=shape, name=node.text or "", texts=texts, tint=tint)


def _is_listed(edge: Edge) -> bool:
    return edge.dashed and len(edge.labels) > _LONGEST_LABEL


def _state_node(state: State, failures: str) -> Node:
    if state.kind is StateKind.INITIAL:
        return Node(id=state.id, shape=Shape.INITIAL, name=state.name)
    if state.kind is StateKind.FINAL:
        return Node(id=state.id, shape=Shape.FINAL, name=state.name)
    texts = [f"phase {state.phase}"] if state.phase else []
    texts += [f"do / {state.does}"] if state.does else []
    texts += [f"failures: {failures}"] if failures else []
    tint = "fail" if state.kind is StateKind.FAILED else "behaviour"
    return Node(id=state.id, shape=Shape.ROUND, name=state.name, texts=tuple(texts), tint=tint)


def _transitions(machine: StateMachine) -> Iterable[Edge]:
    ways: dict[tuple[str, str], list[str]] = {}
    failed = {state.id for state in machine.states if state.kind is StateKind.FAILED}
    for transition in machine.transitions:
        parts = [f"[{transition.guard}]"] if transition.guard else []
        parts += [transition.failure] if transition.failure else []
        ways.setdefault((transition.source, transition.target), []).append(" ".join(parts))
    for (source, target), labels in ways.items():
        there = [label for label in labels if label]
        fails = target in failed
        yield Edge(source=source, target=target, head="filled", labels=tuple(there), dashed=fails, straight=not fails)


def _describe(edges: Iterable[Edge], names: Mapping[str, str]) -> str:
    return " ".join(
        f"From {names[edge.source]} to {names[edge.target]}{': ' + '; '.join(edge.labels) if edge.labels else ''}."
        for edge in edges
    )
