"""Rules of links: ids are unique, links lead to existing elements of the right kind and form no cycle."""

from __future__ import annotations

from collections.abc import Iterator

from rgss.findings import Severity
from rgss.requirements import nearest
from rgss.trace.model import MeasureTrace, TraceModel
from rgss.trace.rules.rule import Located, ModelRule, Violation


def _dangling(model: TraceModel) -> Iterator[Violation]:
    needs = {need.id: None for need in model.requirements.stakeholder}
    measures = {measure.id: None for measure in model.measures}
    for measure in model.measures:
        for target in measure.traces:
            if target not in needs:
                message = f"{measure.id!r} traces to {target!r}, which is not a stakeholder requirement"
                yield Violation(subject=measure, message=message, hint=nearest(target, needs))
        for target in measure.contributes_to:
            if target not in measures:
                message = f"{measure.id!r} contributes to {target!r}, which is not a measure"
                yield Violation(subject=measure, message=message, hint=nearest(target, measures))


def _duplicates(model: TraceModel) -> Iterator[Violation]:
    first: dict[str, Located] = {}
    for measure in model.measures:
        other: Located = first.setdefault(measure.id, measure)
        if measure.id in model.requirements.places:
            other = model.requirements.finding("", measure.id, "")
        if other is not measure:
            message = f"id {measure.id!r} is already declared at {other.file}:{other.line}:{other.column}"
            yield Violation(subject=measure, message=message, hint="use a unique id")


def _cycles(model: TraceModel) -> Iterator[Violation]:
    import networkx as nx

    order = {element_id: index for index, element_id in enumerate(model.graph)}
    measures = {measure.id: measure for measure in reversed(model.measures)}
    for component in nx.strongly_connected_components(model.graph):
        start = min(component, key=lambda element_id: order[element_id])
        if len(component) == 1 and not model.graph.has_edge(start, start):
            continue
        inner = model.graph.subgraph(component)
        around = min(
            ((start, *nx.shortest_path(inner, after, start)) for after in inner.successors(start)),
            key=lambda path: (len(path), [order[element_id] for element_id in path]),
        )
        subject: str | MeasureTrace = measures.get(start, start)
        message = f"{start!r} depends on itself: {' → '.join(around)}"
        yield Violation(subject=subject, message=message, hint="cut one of the links")


RULES: tuple[ModelRule, ...] = (
    ModelRule(
        id="trace.dangling-id",
        fixed=True,
        severity=Severity.ERROR,
        explanation="A measure traces to stakeholder requirements, and contributes to measures, that exist.",
        check=_dangling,
    ),
    ModelRule(
        id="trace.duplicate-id",
        fixed=True,
        severity=Severity.ERROR,
        explanation="An id names one thing, across requirements, architecture and measures.",
        check=_duplicates,
    ),
    ModelRule(
        id="trace.cycle",
        fixed=True,
        severity=Severity.ERROR,
        explanation="Links lead from later to earlier elements, so they must not form a cycle.",
        check=_cycles,
    ),
)
