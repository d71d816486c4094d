"""Estimates, values and verdicts in words, the same in every report."""

from __future__ import annotations

import math
from collections.abc import Sequence

from rgss.counted import counted
from rgss.currencies import is_currency
from rgss.evidence.records import Metric
from rgss.figures import rounded_figure
from rgss.measures import Estimate, StaleCause, Verdict
from rgss.trace.evidence import RecordEvidence, TestEvidence

UNKNOWN = "–"
"""Placeholder of an unknown value."""

_VERDICTS = {
    Verdict.MET: "met",
    Verdict.NOT_MET: "not met",
    Verdict.INCONCLUSIVE: "inconclusive",
    Verdict.NOT_RUN: "not run",
    Verdict.STALE: "stale",
}


def verdict_in_words(verdict: Verdict | None, causes: Sequence[StaleCause] = ()) -> str:
    """A verdict in words, with the causes if it is stale."""
    words = "differs among variants" if verdict is None else _VERDICTS[verdict]
    return f"{words} ({', '.join(cause.value for cause in causes)})" if causes else words


def end_in_words(test: TestEvidence) -> str:
    """Outcome of a test, in words."""
    return "not run" if test.end is None else test.end.value


def record_in_words(found: RecordEvidence) -> str:
    """Result of a person's verification of a requirement, and its state."""
    record = found.record
    words = f"{verdict_in_words(Verdict(record.result.value))} by {record.by} on {record.date}"
    words += f" ({', '.join(record.files)})" if record.files else ""
    words += f": {record.note}" if record.note else ""
    causes = [f"the {cause.value} has changed" for cause in found.causes if cause is not StaleCause.FILES]
    causes += [f"{name} has changed or is gone" for name in found.changed]
    return f"stale, since {' and '.join(causes)}: {words}" if causes else words


def value_in_words(value: float | None, unit: str = "1") -> str:
    """Value with four digits and its unit; a dash if unknown."""
    if value is None:
        return UNKNOWN
    text = rounded_figure(value)
    return text if unit == "1" else f"{text} {unit}"


def share_in_words(share: float) -> str:
    """Share in per cent; ``100 %`` only for exactly 1, ``0 %`` only for exactly 0.

    Args:
        share: From 0 to 1.
    """
    if 0.0 < share < 0.001:
        return "< 0.1 %"
    if 0.995 <= share < 1.0 - 1e-9:
        return f"{100.0 * share:.1f} %" if share < 0.9995 else "> 99.9 %"
    return f"{100.0 * share:.1f} %" if 0.0 < share < 0.1 else f"{100.0 * share:.0f} %"


def rounded_away(limit: float, needed: float, unit: str, digits: int = 4) -> float:
    """Required limit, rounded away from the present one, so that the rounded number suffices.

    Args:
        limit: The present limit.
        needed: The required limit.
        unit: The unit of both; money is rounded to whole units of it.
        digits: Significant digits that are kept.
    """
    from decimal import ROUND_CEILING, ROUND_FLOOR, Decimal

    if needed == 0.0:
        return needed
    last = 0 if is_currency(unit) else min(0, math.floor(math.log10(abs(needed))) - digits + 1)
    nearest = round(needed, -last)
    if math.isclose(nearest, needed, rel_tol=1e-9):
        return nearest
    away = ROUND_CEILING if needed > limit else ROUND_FLOOR
    return float(Decimal(repr(needed)).quantize(Decimal(1).scaleb(last), rounding=away))


def metric_in_words(metric: Metric) -> str:
    """Observation of a trial: a number, or each number of a row."""
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
    return f"{text}, {counted(estimate.n, 'trial')}"
