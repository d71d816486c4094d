"""Requirement diagrams: one for each group of system requirements, with their sources and deciding measures."""

from __future__ import annotations

from collections.abc import Sequence

from rgss.reports.diagrams.drawing import Drawing, draw_graph
from rgss.reports.diagrams.frame import Heading
from rgss.reports.diagrams.graph import Edge, Graph, Node, Shape
from rgss.requirements import Requirement, RequirementSet, StakeholderNeed

MOST_IN_GROUP = 40
"""Most requirements of a group that is drawn."""

_WIDTH = 300.0
_RELATIONS = {
    (): "is contained in",
    ("«deriveReqt»",): "derives from",
    ("«trace»",): "traces to",
    ("«verify»",): "decides",
}


def requirement_diagrams(requirements: RequirementSet) -> tuple[Drawing, ...]:
    """Draw each group of system requirements that is not too large.

    Needs and requirements are boxes with their sentences; «deriveReqt», «trace» and «verify» are
    arrows, and containment has a crosshair at the containing element; elements that satisfy or refine
    a requirement are listed in its box.

    Raises:
        DefinitionError: The package ``pygraphviz`` is not installed.
    """
    groups: dict[str, list[Requirement]] = {}
    for requirement in requirements.system:
        groups.setdefault(requirement.group.value, []).append(requirement)
    return tuple(
        _diagram(requirements, group, members) for group, members in groups.items() if len(members) <= MOST_IN_GROUP
    )


def too_large(requirements: RequirementSet) -> tuple[str, ...]:
    """The groups that are not drawn because they have too many requirements."""
    groups: dict[str, int] = {}
    for requirement in requirements.system:
        groups[requirement.group.value] = groups.get(requirement.group.value, 0) + 1
    return tuple(group for group, count in groups.items() if count > MOST_IN_GROUP)


def _diagram(requirements: RequirementSet, group: str, members: Sequence[Requirement]) -> Drawing:
    refined: dict[str, list[str]] = {}
    for behaviour in requirements.architecture.behaviours:
        for target in behaviour.refines:
            refined.setdefault(target, []).append(behaviour.id)
    nodes: dict[str, Node] = {}
    edges: list[Edge] = []
    for requirement in members:
        nodes[requirement.id] = Node(
            id=requirement.id,
            shape=Shape.BOX,
            name=requirement.id,
            stereotype="requirement",
            texts=_texts(requirement, refined.get(requirement.id, ())),
            tint="requirement",
        )
    for requirement in members:
        targets = [(target, "«deriveReqt»") for target in requirement.derived_from]
        targets += [(target, "«trace»") for target in requirement.traces]
        edges += [
            Edge(source=requirement.id, target=target, dashed=True, labels=(label,), backwards=True)
            for target, label in targets
        ]
        if requirement.parent is not None:
            edges.append(Edge(source=requirement.id, target=requirement.parent, head="crosshair", backwards=True))
        if requirement.criterion is not None:
            measure = requirement.criterion.measure
            nodes[measure] = Node(id=measure, shape=Shape.BOX, name=measure, stereotype="measure", tint="measure")
            edges.append(
                Edge(
                    source=measure,
                    target=requirement.id,
                    dashed=True,
                    labels=("«verify»", str(requirement.criterion)),
                    backwards=True,
                )
            )
    for edge in edges:
        if edge.target not in nodes:
            nodes[edge.target] = _neighbour(requirements, edge.target, refined.get(edge.target, ()))
    return draw_graph(
        Graph(nodes=tuple(nodes.values()), edges=tuple(edges), rightwards=True, node_width=_WIDTH),
        heading=Heading(kind="req", element="Package", subject=f"System requirements: {group}"),
        name=f"requirements-{group}",
        title=f"Requirement diagram: {group}",
        description=f"{len(members)} system requirements with what they derive from and the measures that decide.",
        text_alternative=" ".join(f"{edge.source} {_RELATIONS[edge.labels[:1]]} {edge.target}." for edge in edges),
    )


def _texts(element: StakeholderNeed | Requirement, refining: Sequence[str]) -> tuple[str, ...]:
    """The sentence, and the elements that satisfy or refine it, each in a compartment of its own."""
    satisfying = element.satisfied_by if isinstance(element, Requirement) else ()
    parts = [element.text]
    parts += [f"satisfied by {', '.join(satisfying)}"] if satisfying else []
    parts += [f"refined by {', '.join(refining)}"] if refining else []
    return tuple(parts)


def _neighbour(requirements: RequirementSet, name: str, refining: Sequence[str]) -> Node:
    """A need, or a requirement of another group, whose allocation is shown in its own diagram."""
    element = requirements.element(name)
    if isinstance(element, StakeholderNeed):
        texts = _texts(element, refining)
        return Node(id=name, shape=Shape.BOX, name=name, stereotype="stakeholder requirement", texts=texts, tint="need")
    texts = (element.text,)
    return Node(id=name, shape=Shape.BOX, name=name, stereotype="requirement", texts=texts, tint="requirement")
