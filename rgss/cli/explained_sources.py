"""Page of the sources of measures' inputs: every metric of trials, for ``rgss check --explain``."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from rgss.trials import MetricDescriptor

SOURCE_RULE = "measures.unknown-source"
"""Id of the finding that the page explains."""

_OPENING = """\
measures.unknown-source (error)
  The source of an input of a measure does not exist. Sources are
  - design.PARAMETER: a parameter of the design space, by its id;
  - component.ROLE.cost and component.ROLE.PROPERTY: values of the component that a design takes for a role;
  - trial.METRIC: a metric of the trials, one of the following."""


def source_lines() -> list[str]:
    """Lines of the page: each metric with its unit, number of entries, fidelities and meaning."""
    from rgss.trials import METRICS

    lines = _OPENING.splitlines()
    for metric in METRICS.values():
        notes = [metric.unit, *_entries(metric), *_fidelities(metric)]
        lines += ["", f"trial.{metric.name} ({', '.join(notes)})", f"  {metric.meaning_in_trial}"]
    return lines


def sources_as_json() -> dict[str, Any]:
    """The same as plain data."""
    from rgss.trials import METRICS

    sources = [
        {
            "source": f"trial.{metric.name}",
            "unit": metric.unit,
            "entries": "".join(_entries(metric)) or "one number",
            "fidelities": [fidelity.value for fidelity in metric.fidelities],
            "meaning": metric.meaning_in_trial,
        }
        for metric in METRICS.values()
    ]
    return {"id": SOURCE_RULE, "severity": "error", "sources": sources}


def _entries(metric: MetricDescriptor) -> list[str]:
    from rgss.trials import FOR_EACH_JOINT, FOR_EACH_MOVE

    if metric.length is None:
        return []
    kinds = {FOR_EACH_MOVE: "one for each planned move", FOR_EACH_JOINT: "one for each joint", 0: "one for each finger"}
    return [kinds.get(metric.length, f"{metric.length} entries")]


def _fidelities(metric: MetricDescriptor) -> list[str]:
    from rgss.evidence import Fidelity

    if set(metric.fidelities) == set(Fidelity):
        return []
    return [" and ".join(fidelity.value for fidelity in metric.fidelities) + " only"]
