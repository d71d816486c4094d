"""Rules of links: ids are unique, lead to what they should, and never back to themselves."""

from __future__ import annotations

import difflib
from collections.abc import Iterator

from rgss.findings import Severity
from rgss.trace.measure_trace import MeasureTrace
from rgss.trace.model import TraceModel
from rgss.trace.rule import Breach, Rule


def _dangling(model: TraceModel) -> Iterator[Breach]:
    needs = [need.id for need in model.requirements.stakeholder]
    measures = [measure.id for measure in model.measures]
    for measure in model.measures:
        for target in measure.traces:
            if target not in needs:
                message = f"{measure.id!r} traces to {target!r}, which is no stakeholder requirement"
                yield Breach(subject=measure, message=message, hint=_nearest(target, needs))
        for target in measure.contributes_to:
            if target not in measures:
                message = f"{measure.id!r} contributes to {target!r}, which is no measure"
                yield Breach(subject=measure, message=message, hint=_nearest(target, measures))


def _duplicates(model: TraceModel) -> Iterator[Breach]:
    first: dict[str, str] = {}
    for element_id in model.requirements.places:
        place = model.requirements.finding("", element_id, "")
        first[element_id] = f"{place.file}:{place.line}:{place.column}"
    for measure in model.measures:
        if measure.id in first:
            message = f"id {measure.id!r} stands already at {first[measure.id]}"
            yield Breach(subject=measure, message=message, hint="give it an id of its own")
        else:
            first[measure.id] = f"{measure.file}:{measure.line}:{measure.column}"


def _cycles(model: TraceModel) -> Iterator[Breach]:
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
        message = f"{start!r} rests on itself: {' → '.join(around)}"
        yield Breach(subject=subject, message=message, hint="cut one of the links")


def _nearest(name: str, names: list[str]) -> str:
    near = difflib.get_close_matches(name, names, n=1)
    return f"did you mean {near[0]!r}?" if near else ""


RULES: tuple[Rule, ...] = (
    Rule(
        id="trace.dangling-id",
        severity=Severity.ERROR,
        explanation="A measure traces to stakeholder requirements, and contributes to measures, that are there.",
        check=_dangling,
    ),
    Rule(
        id="trace.duplicate-id",
        severity=Severity.ERROR,
        explanation="An id names one thing, across requirements, architecture and measures.",
        check=_duplicates,
    ),
    Rule(
        id="trace.cycle",
        severity=Severity.ERROR,
        explanation="Links lead from later to earlier elements; a cycle of them has no beginning to trust.",
        check=_cycles,
    ),
)
