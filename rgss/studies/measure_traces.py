"""The measures of a project as traceability sees them."""

from __future__ import annotations

from rgss.documents import Document
from rgss.findings import Severity
from rgss.measures import MeasureKind as Kind
from rgss.measures import MeasureSet
from rgss.trace import MeasureKind, MeasureTrace


def measure_traces(measures: MeasureSet, document: Document) -> tuple[MeasureTrace, ...]:
    """The measures with their links and their places."""
    traces = []
    for index, measure in enumerate(measures.measures):
        place = document.finding("", "", ("measures", index, "id"), severity=Severity.INFO)
        traces.append(
            MeasureTrace(
                id=measure.id,
                kind=MeasureKind(measure.kind.value),
                unit=measure.unit,
                traces=measure.traces,
                contributes_to=measure.contributes_to,
                observed=measure.from_trials
                and not any(
                    measures.measure(other).kind is Kind.PERFORMANCE for other in measures.dependencies(measure.id)
                ),
                file=place.file,
                line=place.line,
                column=place.column,
            )
        )
    return tuple(traces)
