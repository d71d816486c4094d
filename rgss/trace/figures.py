"""Estimates, values and verdicts in words, the same in every report."""

from __future__ import annotations

from collections.abc import Sequence

from rgss.evidence.records import Metric
from rgss.measures import Estimate, StaleCause, Verdict
from rgss.trace.software_evidence import TestEvidence

UNKNOWN = "–"
"""What stands for a value that is not known."""

_VERDICTS = {
    Verdict.MET: "met",
    Verdict.NOT_MET: "not met",
    Verdict.INCONCLUSIVE: "inconclusive",
    Verdict.NOT_RUN: "not run",
    Verdict.STALE: "stale",
}
_LARGE = 10_000.0


def verdict_in_words(verdict: Verdict | None, causes: Sequence[StaleCause] = ()) -> str:
    """A verdict as prose says it, and what made it stale if something did."""
    told = "differs among variants" if verdict is None else _VERDICTS[verdict]
    return f"{told} ({', '.join(cause.value for cause in causes)})" if causes else told


def end_in_words(test: TestEvidence) -> str:
    """How a test ended."""
    return "not run" if test.end is None else test.end.value


def value_in_words(value: float | None, unit: str = "1") -> str:
    """A value with four digits and its unit; a dash for what is not known."""
    if value is None:
        return UNKNOWN
    text = f"{value:,.0f}" if abs(value) >= _LARGE else f"{value:.4g}"
    return text if unit == "1" else f"{text} {unit}"


def metric_in_words(metric: Metric) -> str:
    """What a trial observed: a number, or each number of a row."""
    if isinstance(metric, tuple):
        return " ".join(map(value_in_words, metric))
    return value_in_words(metric)


def estimate_in_words(estimate: Estimate) -> str:
    """An estimate with its interval and the number of its trials."""
    if estimate.value is None:
        return UNKNOWN
    text = value_in_words(estimate.value, estimate.unit)
    if estimate.n == 0:
        return f"{text}, from the design alone"
    if estimate.low is not None and estimate.high is not None and estimate.low != estimate.high:
        text += f" ({value_in_words(estimate.low)} to {value_in_words(estimate.high)})"
    return f"{text}, {estimate.n} {'trial' if estimate.n == 1 else 'trials'}"
