"""Texts of a guard's findings, shared by all renderers."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator

from rgss.regression import (
    MEAN_LOSS,
    MOST_SEEDS,
    TARGET,
    WHOLE_TRIAL,
    Comparison,
    Guard,
    InputKind,
    Outcome,
    Power,
    RegressionReport,
)

ORDER = (Outcome.WORSE, Outcome.MISSING, Outcome.MOVED, Outcome.INCONCLUSIVE, Outcome.BETTER, Outcome.SAME)
"""The outcomes, the most important first."""

_MOST_PHASES = 8

_MOST_INPUTS = 12
"""Most changes of one kind that are listed; the JSON report has all of them."""


def title_of(comparison: Comparison) -> str:
    """Metric, phase and run."""
    return f"{comparison.subject} (run {comparison.subject.run})"


def quantity(value: float | None, unit: str) -> str:
    """Number with its unit; a dash for an unknown one."""
    if value is None:
        return "–"
    return f"{value:.4g}" if unit == "1" else f"{value:.4g} {unit}"


def detail_of(comparison: Comparison) -> str:
    """Figures behind an outcome, in one line."""
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
        up, down = ("higher", "lower") if guard.both_ways else ("worse", "better")
        word = up if comparison.worsening > 0.0 else down
        sign = 1.0 if comparison.worsening > 0.0 else -1.0
        if comparison.worsening:
            said = f"{word} by {quantity(sign * comparison.worsening, guard.unit)}"
            if comparison.low is not None and comparison.high is not None:
                ends = sorted((sign * comparison.low, sign * comparison.high))
                said += f" ({ends[0]:.3g} … {ends[1]:.3g})"
            parts.append(said)
        either = " either way" if guard.both_ways else f", {guard.direction} is better"
        parts.append(f"margin {quantity(guard.margin, guard.unit)}{either}")
    parts.append(f"{comparison.pairs} pairs, {comparison.seeds} seeds")
    if comparison.lost:
        verb = "has" if comparison.lost == 1 else "have"
        parts.append(f"{_trials(comparison.lost)} of the baseline {verb} no value now")
    return "; ".join(parts)


def behaviour_of(report: RegressionReport) -> str:
    """Result of the bit-for-bit comparison, in one line."""
    behaviour = report.behaviour
    if behaviour.changed and behaviour.machine:
        return (
            f"behaviour not comparable: {len(behaviour.changed)} of {_trials(behaviour.compared)} not the same bit "
            f"for bit, and nothing is known to have changed but the machine: {behaviour.machine}"
        )
    if not behaviour.changed:
        return f"behaviour unchanged: {_trials(behaviour.compared)} the same bit for bit"
    counts = Counter(one.phase for one in behaviour.changed)
    phases = ", ".join(f"{phase} in {count}" for phase, count in counts.most_common(_MOST_PHASES))
    return (
        f"behaviour changed: {len(behaviour.changed)} of {_trials(behaviour.compared)} not the same bit for bit; "
        f"first different phase: {phases}"
    )


def reasons_of(report: RegressionReport) -> Iterator[str]:
    """Changes that need a stated reason, one line each; changed metrics have their own lines."""
    if report.behaviour.is_changed:
        yield behaviour_of(report)
    yield from (str(one) for one in report.inputs if one.kind is InputKind.ENGINE)


def inputs_of(report: RegressionReport) -> Iterator[str]:
    """The inputs that changed, one line each, values and constants first; long lists of a kind are cut."""
    for kind in InputKind:
        found = [one for one in report.inputs if one.kind is kind]
        if kind in (InputKind.CODE, InputKind.FILE) and found:
            names = ", ".join(one.name for one in found[:_MOST_INPUTS])
            yield f"{kind.value} changed: {names}{_more(len(found))}"
        elif kind is not InputKind.ENGINE or report.accepted:
            yield from (str(one) for one in found[:_MOST_INPUTS])
            if len(found) > _MOST_INPUTS:
                yield f"{kind.value} changed:{_more(len(found))}"


def remedy_of(report: RegressionReport) -> str:
    """Instruction to state the reason of a change; empty if none is needed."""
    if report.accepted:
        return f"changed behaviour is accepted in this run: {report.accepted}"
    if report.verdict != "changed":
        return ""
    return (
        "a change needs a reason: make it the baseline with 'rgss regress --update --reason TEXT', or accept it "
        "once with 'rgss regress --accept-change TEXT'"
    )


def power_lines(report: RegressionReport, *, everything: bool) -> Iterator[str]:
    """The power, one line for each metric of a run: that of the phase in which it is least.

    Args:
        report: The report.
        everything: True to show those that reach the target too.
    """
    least: dict[tuple[str, str, bool], tuple[Comparison, Power]] = {}
    for one in report.comparisons:
        power = report.powers.get(one.subject)
        key = (one.subject.run, one.subject.metric, one.subject.phase == WHOLE_TRIAL)
        if power is not None and (key not in least or power.probability < least[key][1].probability):
            least[key] = (one, power)
    for one, power in least.values():
        if everything or power.probability < TARGET:
            yield f"power: {title_of(one)}: {power_text(power, one.guard)}"


def power_text(power: Power, guard: Guard) -> str:
    """The power of one comparison, in words."""
    loss = f"{100.0 * power.loss:.0f} %" if guard.is_success else quantity(power.loss, guard.unit)
    size = f"a loss of {loss}" if guard.is_success else f"a change by {loss}, {MEAN_LOSS:g} times the margin,"
    needed = f"more than {MOST_SEEDS}" if power.seeds_needed is None else str(power.seeds_needed)
    if power.detectable is not None:
        needed += f", or a change by {quantity(power.detectable, guard.unit)}"
    return (
        f"{size} is found with a probability of at least {100.0 * power.probability:.0f} % "
        f"with up to {power.seeds} seeds; {100.0 * TARGET:.0f} % takes {needed}"
    )


def _more(count: int) -> str:
    return f" and {count - _MOST_INPUTS} more" if count > _MOST_INPUTS else ""


def counts_of(report: RegressionReport) -> str:
    """Numbers of comparisons by outcome, and of the seeds that they took."""
    counted = ", ".join(f"{len(report.of(outcome))} {outcome.value}" for outcome in ORDER if report.of(outcome))
    seeds = ", ".join(f"{run} {count}" for run, count in report.trials.items())
    looks = f"{report.looks} look{'' if report.looks == 1 else 's'}"
    return f"{len(report.comparisons)} comparisons: {counted or 'none'}; seeds after {looks}: {seeds}"


def listed(report: RegressionReport) -> Iterator[Comparison]:
    """The comparisons, the most important first."""
    for outcome in ORDER:
        yield from report.of(outcome)


def _trials(count: int) -> str:
    return f"{count} trial{'' if count == 1 else 's'}"
