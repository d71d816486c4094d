"""Uncertainty of a choice at the stated weights: probability of being best, ties, value of more replicates."""

from __future__ import annotations

import math
from collections.abc import Collection, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rgss.tradeoff.problem import TIE_TOLERANCE, Array, EvidenceTable, Threshold
from rgss.tradeoff.robustness.heavy_tails import heavy_tailed_measures
from rgss.tradeoff.robustness.posterior_outcomes import PosteriorOutcomes, good_selection
from rgss.tradeoff.robustness.replication_gain import NO_GAINS, ReplicationGains

TIE_PROBABILITY = 0.05
"""An alternative that is as good as the choice with at least this probability, one of them being feasible, is tied."""

MOST_MORE = 100_000
"""More replicates than this are not counted out."""

FEWEST_AT_THRESHOLD = 10.0
"""Fewest failures to be expected at the threshold of a share; with fewer, probabilities follow the prior."""

_Z = 1.6448536269514722
"""The one-sided 95 % quantile of the normal distribution."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Rival:
    """An alternative that the evidence does not separate from the choice.

    Attributes:
        row: Its row.
        probability: Posterior probability, given that it or the choice is feasible, that it is and is worth
            at least as much as the choice if that is feasible too. Where neither is, nothing is to be chosen
            between them.
        within_margin: Whether its estimated value is within the practical margin of the choice's.
        replicates: Replicates in all with which their difference would exceed its noise; None where
            no number does, for they do not differ or a demand decides, and where it does already.
        separated: Whether their difference exceeds its noise already, so that the margin alone makes it a tie.
        by_feasibility: Whether it is not tied by its value: with the choice feasible it is as good with a probability
            below `TIE_PROBABILITY`.
        measure: The measure in whose value they differ most by the estimates; None where they do not differ.
        fixed: Whether that measure follows from the design alone, so that no replicate changes its difference.
        clipped: Where no value differs, the measures in whose quantities they differ beyond an end of the value
            function.
    """

    row: int
    probability: float
    within_margin: bool
    replicates: int | None
    measure: str | None
    by_feasibility: bool = False
    separated: bool = False
    fixed: bool = False
    clipped: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ChoiceUncertainty:
    """Uncertainty of a choice at the stated weights, given the evidence.

    Attributes:
        chosen: Row of the choice.
        best: Probability that each alternative is feasible and none feasible is better, shape (n,).
        feasible: Probability that each is feasible, shape (n,).
        good: Probability that the choice is feasible and within the practical margin of the best.
        as_required: Probability that the choice is feasible without the tolerances of thresholds.
        none_feasible: Probability that nothing is feasible.
        rivals: Alternatives tied with the choice, by falling probability.
        gains: Expected gain of value by more evidence; none where it is not asked for.
        scarce: Requirements on a share of trials of which all alternatives together have too few to tell it from its
            threshold.
        heavy_tailed: Measures whose skewed noise the replicates of the choice and its rivals are too few to show.
    """

    chosen: int
    best: Array
    feasible: Array
    good: float
    as_required: float
    none_feasible: float
    rivals: tuple[Rival, ...]
    gains: ReplicationGains
    scarce: tuple[str, ...] = ()
    heavy_tailed: tuple[str, ...] = ()


def choice_uncertainty(
    found: PosteriorOutcomes,
    chosen: int,
    *,
    margin: float,
    replicates: NDArray[np.int64],
    estimated: NDArray[np.bool_],
    single: Array,
    proportions: Collection[str] = (),
    gains: ReplicationGains = NO_GAINS,
) -> ChoiceUncertainty:
    """The uncertainty of a choice.

    Args:
        found: Posterior draws of the evidence.
        chosen: Row of the choice.
        margin: The practical margin of values.
        replicates: Replicates that the estimates of each alternative come from, shape (n,).
        estimated: Mask of the alternatives that are feasible by their estimates, shape (n,).
        single: Their single values by their estimates, shape (n, m).
        proportions: The measures that are shares of trials.
        gains: Expected gain of value by more evidence.
    """
    feasible = found.outcomes.feasible
    totals = np.where(feasible, np.nan_to_num(found.totals), -np.inf)
    highest = totals.max(axis=1, keepdims=True)
    best = feasible & (totals >= highest - TIE_TOLERANCE)
    rivals = _rivals(found, chosen, margin, replicates, estimated, single)
    compared = [chosen, *(one.row for one in rivals)]
    means = [measure for measure in dict.fromkeys(_deciding(found)) if measure not in proportions]
    return ChoiceUncertainty(
        chosen=chosen,
        best=best.mean(axis=0),
        feasible=feasible.mean(axis=0),
        good=good_selection(found.totals, feasible, chosen, margin),
        as_required=float(found.as_required(chosen).mean()),
        none_feasible=float((~feasible.any(axis=1)).mean()),
        rivals=rivals,
        gains=gains,
        scarce=_scarce(found.preferences.thresholds, int(replicates.sum()), proportions),
        heavy_tailed=heavy_tailed_measures(found.table, means, replicates[compared]),
    )


def _deciding(found: PosteriorOutcomes) -> tuple[str, ...]:
    """The measures that are valued or demanded."""
    preferences = found.preferences
    return (*preferences.weighting.deciding_measures, *(one.measure for one in preferences.thresholds))


def _scarce(thresholds: Sequence[Threshold], trials: int, proportions: Collection[str]) -> tuple[str, ...]:
    """The requirements at whose threshold fewer failures than `FEWEST_AT_THRESHOLD` are to be expected."""
    found: dict[str, None] = {}
    for one in thresholds:
        limit = one.value if one.required is None else one.required
        failing = 1.0 - limit if one.comparison.is_lower_bound else limit
        if one.measure in proportions and 0.0 < limit < 1.0 and trials * failing < FEWEST_AT_THRESHOLD:
            found[one.requirement] = None
    return tuple(found)


def _rivals(
    found: PosteriorOutcomes,
    chosen: int,
    margin: float,
    replicates: NDArray[np.int64],
    estimated: NDArray[np.bool_],
    single: Array,
) -> tuple[Rival, ...]:
    feasible = found.outcomes.feasible
    totals = found.totals
    weighting = found.preferences.weighting
    weights = np.array([weighting.weights[measure] for measure in weighting.deciding_measures])
    rivals = []
    for row in range(len(found.table)):
        if row == chosen:
            continue
        both = np.nan_to_num(totals[:, row] - totals[:, chosen], nan=-np.inf)
        ahead = feasible[:, row] & (~feasible[:, chosen] | (both >= -TIE_TOLERANCE))
        either = int((feasible[:, row] | feasible[:, chosen]).sum())
        probability = float(ahead.sum()) / either if either else 0.0
        gaps = weights * (single[row] - single[chosen])
        measure = _widest(weighting.deciding_measures, gaps)
        difference = float(gaps.sum())
        known = np.isfinite(both)
        near = bool(estimated[row]) and abs(difference) <= margin + TIE_TOLERANCE
        if not near and probability < TIE_PROBABILITY:
            continue
        spread = float(both[known].std()) if known.any() else math.nan
        # Of the same draws as the spread: the difference of the estimates is that of luck too.
        expected = float(both[known].mean()) if known.any() else math.nan
        by_value = float((ahead & feasible[:, chosen]).mean())
        by_feasibility = not near and by_value < TIE_PROBABILITY
        fewest = int(min(replicates[row], replicates[chosen]))
        counted = bool(estimated[row]) and not by_feasibility and measure is not None
        needed = _replicates_needed(expected, spread, fewest) if counted else None
        separated = needed is not None and needed <= fewest and probability < TIE_PROBABILITY
        rivals.append(
            Rival(
                row=row,
                probability=probability,
                within_margin=near,
                replicates=None if needed is None or separated else max(needed, fewest + 1),
                separated=separated,
                measure=measure,
                by_feasibility=by_feasibility,
                fixed=measure is not None and measure not in found.table.samples,
                clipped=() if measure else _different(found.table, weighting.deciding_measures, row, chosen),
            )
        )
    return tuple(sorted(rivals, key=lambda one: -one.probability))


def _replicates_needed(difference: float, spread: float, replicates: int) -> int | None:
    """Replicates with which a difference is 1.645 of its standard errors, which fall with their root."""
    if not math.isfinite(spread) or not math.isfinite(difference) or abs(difference) <= TIE_TOLERANCE:
        return None
    needed = math.ceil(replicates * (_Z * spread / abs(difference)) ** 2)
    return None if needed > MOST_MORE else needed


def _different(table: EvidenceTable, measures: tuple[str, ...], row: int, chosen: int) -> tuple[str, ...]:
    """The measures in whose known quantities two alternatives differ."""
    pairs = {measure: table.column(measure)[[row, chosen]].tolist() for measure in measures}
    return tuple(
        measure
        for measure, (one, other) in pairs.items()
        if math.isfinite(one - other) and not math.isclose(one, other, rel_tol=TIE_TOLERANCE)
    )


def _widest(measures: tuple[str, ...], gaps: Array) -> str | None:
    known = np.nan_to_num(np.abs(gaps))
    return measures[int(known.argmax())] if len(known) and known.max() > TIE_TOLERANCE else None
