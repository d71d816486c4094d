"""What is said of each finding of a guard, the same in every form of its report."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator

from rgss.regression.comparing import Comparison, Outcome
from rgss.regression.report import RegressionReport

ORDER = (Outcome.WORSE, Outcome.MISSING, Outcome.INCONCLUSIVE, Outcome.BETTER, Outcome.SAME)
"""The outcomes, what matters most first."""

_MOST_PHASES = 8


def title_of(comparison: Comparison) -> str:
    """Metric, phase and run."""
    return f"{comparison.subject} (run {comparison.subject.run})"


def quantity(value: float | None, unit: str) -> str:
    """A number with its unit; a dash for what is not known."""
    if value is None:
        return "–"
    return f"{value:.4g}" if unit == "1" else f"{value:.4g} {unit}"


def detail_of(comparison: Comparison) -> str:
    """The numbers behind an outcome, in one line."""
    guard = comparison.guard
    if comparison.outcome is Outcome.MISSING:
        return f"{_trials(comparison.lost)} had a value in the baseline, and none has one now"
    if comparison.worsening is None:
        return "neither the baseline's trials nor these have a value with these seeds"
    before, now = (quantity(each, guard.unit) for each in (comparison.baseline_mean, comparison.current_mean))
    parts = [f"{before} → {now}"]
    if comparison.identical:
        parts.append("bit for bit the same")
    else:
        word = "worse" if comparison.worsening > 0.0 else "better"
        sign = 1.0 if comparison.worsening > 0.0 else -1.0
        if comparison.worsening:
            said = f"{word} by {quantity(sign * comparison.worsening, guard.unit)}"
            if comparison.low is not None and comparison.high is not None:
                ends = sorted((sign * comparison.low, sign * comparison.high))
                said += f" ({ends[0]:.3g} … {ends[1]:.3g})"
            parts.append(said)
        parts.append(f"margin {quantity(guard.margin, guard.unit)}")
    parts.append(f"{comparison.pairs} pairs, {comparison.seeds} seeds")
    if comparison.lost:
        verb = "has" if comparison.lost == 1 else "have"
        parts.append(f"{_trials(comparison.lost)} of the baseline {verb} no value now")
    return "; ".join(parts)


def behaviour_of(report: RegressionReport) -> str:
    """What became of the trials bit by bit, in one line."""
    behaviour = report.behaviour
    if behaviour.platform:
        return f"behaviour not compared: {behaviour.platform}"
    if not behaviour.changed:
        return f"behaviour unchanged: {_trials(behaviour.compared)} the same bit for bit"
    counts = Counter(one.phase for one in behaviour.changed)
    phases = ", ".join(f"{phase} in {count}" for phase, count in counts.most_common(_MOST_PHASES))
    return (
        f"behaviour changed: {len(behaviour.changed)} of {_trials(behaviour.compared)} not the same bit for bit; "
        f"first different phase: {phases}"
    )


def counts_of(report: RegressionReport) -> str:
    """How many comparisons there are of each outcome, and how many seeds they took."""
    counted = ", ".join(f"{len(report.of(outcome))} {outcome.value}" for outcome in ORDER if report.of(outcome))
    seeds = ", ".join(f"{run} {count}" for run, count in report.trials.items())
    looks = f"{report.looks} look{'' if report.looks == 1 else 's'}"
    return f"{len(report.comparisons)} comparisons: {counted or 'none'}; seeds after {looks}: {seeds}"


def listed(report: RegressionReport) -> Iterator[Comparison]:
    """The comparisons, what matters most first."""
    for outcome in ORDER:
        yield from report.of(outcome)


def _trials(count: int) -> str:
    return f"{count} trial{'' if count == 1 else 's'}"
