"""Findings about values that a trade-off counts twice: by a measure, and by another that is computed from it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from rgss.documents import read_document
from rgss.findings import Finding, Severity
from rgss.measures import MeasureKind
from rgss.studies.project import Project

_VALUES = "trade_off.values"
_Place = tuple["str | int", ...]


def double_counting_findings(project: Project) -> Iterator[Finding]:
    """Warn of measures that more than one weighted measure of the trade-off counts.

    A measure of effectiveness counts as itself and through every measure that is computed from it. A measure of
    performance may serve several; it counts twice only if it has a weight itself. An assumption about the entry
    of a measure that is computed from another accepts the double count.
    """
    document = read_document(project.folder / project.study.label, label=project.study.label)
    weights = {anchors.measure: anchors.weight for anchors in project.study.values}
    places = _places(document.data["trade_off"].get("values", ()), ("trade_off", "values"))
    accepted = {entry["about"] for entry in document.data.get("assumptions") or ()}
    for measure in project.measures.measures:
        if measure.kind is not MeasureKind.EFFECTIVENESS and measure.id not in weights:
            continue
        through = [one for one, weight in weights.items() if weight and measure.id in project.measures.used[one]]
        counting = [*([measure.id] if weights.get(measure.id) else ()), *through]
        if len(counting) < 2 or any(f"{_VALUES}.{one}" in accepted for one in through):
            continue
        yield document.finding(
            "study.double-counting",
            f"{measure.id} is counted {len(counting)} times: {_words(measure.id, counting)}",
            places.get(through[-1], ("trade_off", "values")),
            severity=Severity.WARNING,
            hint=f"weigh one of them, or give the reason in an assumption about {_VALUES}.{through[-1]}",
        )


def _words(measure: str, counting: list[str]) -> str:
    return " and ".join("by itself" if one == measure else f"in {one}" for one in counting)


def _places(entries: Any, location: _Place) -> Mapping[str, _Place]:
    """The place of each measure among the values, also within groups."""
    found: dict[str, _Place] = {}
    for index, entry in enumerate(entries):
        if "measure" in entry:
            found[entry["measure"]] = (*location, index, "measure")
        found.update(_places(entry.get("of", ()), (*location, index, "of")))
    return found
