"""Outcomes of the evidence's uncertainty: every alternative valued and judged in posterior draws of its measures."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rgss.tradeoff.problem import (
    TIE_TOLERANCE,
    Array,
    EvidenceTable,
    ObservedRows,
    Samples,
    Threshold,
    posterior_means,
)
from rgss.tradeoff.programs import Preferences
from rgss.tradeoff.robustness.acceptability import Outcomes
from rgss.tradeoff.robustness.drawn_values import evaluated
from rgss.tradeoff.weights import WeightSet, sample_weights

DRAWS = 1_000
"""Draws of the evidence, where memory has room for their values."""

FEWEST_DRAWS = 64

_MOST_VALUES = 8_000_000
_VALUES_AT_ONCE = 1_000_000
"""Values of alternatives, 8 MB, that are made of another study's draws at a time."""
_ENDS = ("low", "high")
_STUDIES = 40
"""Emulated repetitions of a study."""
_DRAWS_OF_A_STUDY = 500


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PosteriorOutcomes:
    """Posterior draws of the evidence of n alternatives, with their outcomes.

    Attributes:
        preferences: The preferences.
        table: The evidence.
        drawn: Draws of each measure observed in trials, shape (b, n); NaN if unknown.
        outcomes: Values and feasibility in each draw.
        picks: Replicates that conditions on replicates are evaluated on in each draw, shape (b, r).
        proportions: The measures that are shares of trials.
    """

    preferences: Preferences
    table: EvidenceTable
    drawn: Mapping[str, Array]
    outcomes: Outcomes
    picks: NDArray[np.int64]
    proportions: frozenset[str]

    @staticmethod
    def of(
        preferences: Preferences,
        table: EvidenceTable,
        proportions: Collection[str],
        *,
        generator: np.random.Generator,
        levels: NDArray[np.intp] | None = None,
        draws: int = DRAWS,
        apart: bool = False,
    ) -> PosteriorOutcomes:
        """Draw the evidence of a table.

        Conditions on replicates are evaluated on replicates resampled with replacement.

        Args:
            preferences: The preferences.
            table: The evidence.
            proportions: The measures that are shares of trials.
            generator: Source of randomness.
            levels: The level of each alternative in each factor of its design, shape (n, f), in the
                table's order; None where designs are not made of levels.
            draws: Number of draws; fewer where their values would not fit in memory.
            apart: As for `rgss.tradeoff.problem.posterior_means`.
        """
        size = max(1, len(table) * len(preferences.weighting.deciding_measures))
        draws = min(draws, max(FEWEST_DRAWS, _MOST_VALUES // size))
        drawn = _drawn(table, proportions, levels, draws, generator, apart=apart)
        replicates = max((samples.values.shape[1] for samples in table.samples.values()), default=0)
        picks = generator.integers(0, max(replicates, 1), size=(draws, replicates))
        values, feasible = evaluated(preferences, table, drawn, picks)
        chances = np.full(draws, 1.0 / draws)
        outcomes = Outcomes(values=values, feasible=feasible, probabilities=chances, exact=False)
        return PosteriorOutcomes(
            preferences=preferences,
            table=table,
            drawn=drawn,
            outcomes=outcomes,
            picks=picks,
            proportions=frozenset(proportions),
        )

    @property
    def totals(self) -> Array:
        """Weighted value of each alternative in each draw, shape (b, n); NaN where a measure is unknown."""
        weighting = self.preferences.weighting
        weights = np.array([weighting.weights[measure] for measure in weighting.deciding_measures])
        return np.asarray(self.outcomes.values @ weights, dtype=np.float64)

    def as_required(self, row: int) -> Array:
        """True where an alternative is feasible in each draw without the tolerances of thresholds, shape (b,)."""
        holds = np.array(self.outcomes.feasible[:, row], dtype=bool)
        for one in self.preferences.conditions:
            if isinstance(one, Threshold) and one.required is not None and one.measure in self.drawn:
                quantities = self.drawn[one.measure][:, row]
                holds &= quantities >= one.required if one.comparison.is_lower_bound else quantities <= one.required
        return holds

    def first_errors(self, weights: WeightSet, generator: np.random.Generator) -> Array:
        """Standard error of each first-rank acceptability over repetitions of the study, shape (n,).

        By a parametric bootstrap from the posterior: the estimates of a repeated study of the same size are drawn from
        the posterior, and its draws have the distribution of this study's draws about its estimates.

        Args:
            weights: The admitted weights.
            generator: Source of randomness.
        """
        count = len(self.table)
        inner = max(FEWEST_DRAWS, min(_DRAWS_OF_A_STUDY, _MOST_VALUES // max(1, self.outcomes.shape[1])))
        draws = self.outcomes.shape[0]
        moving = self._moving()
        firsts = np.empty((_STUDIES, count))
        for study in range(_STUDIES):
            other = int(generator.integers(draws))
            inside = generator.integers(0, draws, size=inner)
            chosen = sample_weights(weights, inner, generator).weights
            firsts[study] = self._times_best(moving, other, inside, chosen) / inner
        variance = firsts.var(axis=0, ddof=1) - (firsts * (1.0 - firsts)).mean(axis=0) / inner
        return np.asarray(np.sqrt(np.maximum(variance, 0.0)), dtype=np.float64)

    def _moving(self) -> dict[str, _MovingDraws]:
        """The draws of the measures that are valued or demanded, as another study moves them."""
        used = {*self.preferences.weighting.deciding_measures}
        used.update(one.measure for one in self.preferences.conditions if isinstance(one, Threshold))
        return {measure: _MovingDraws.of(rows) for measure, rows in self.drawn.items() if measure in used}

    def _times_best(
        self, moving: Mapping[str, _MovingDraws], other: int, inside: NDArray[np.intp], weights: Array
    ) -> NDArray[np.int64]:
        """The number of draws of another study in which each alternative is best, shape (n,).

        Values of a block of draws at a time are in memory, not those of the study.

        Args:
            moving: The draws.
            other: The draw that the other study would estimate.
            inside: The draws that its own are made of, shape (k,).
            weights: The weights in each of them, shape (k, m).
        """
        found = np.zeros(len(self.table), dtype=np.int64)
        at_once = max(1, _VALUES_AT_ONCE // max(1, len(self.table) * weights.shape[1]))
        for start in range(0, len(inside), at_once):
            some = slice(start, start + at_once)
            moved = {measure: draws.at(inside[some], other) for measure, draws in moving.items()}
            picks = np.zeros((len(inside[some]), 0), dtype=np.intp)
            values, feasible = evaluated(self.preferences, self.table, moved, picks)
            totals = np.einsum("bnm,bm->bn", np.nan_to_num(values, copy=False), weights[some])
            totals[~feasible] = -np.inf
            best = totals.max(axis=1, keepdims=True)
            found += (feasible & (totals >= best - TIE_TOLERANCE)).sum(axis=0)
        return found


def good_selection(totals: Array, feasible: NDArray[np.bool_], row: int | None, margin: float) -> float:
    """Share of the draws in which a choice is feasible and no feasible alternative is better by more than a margin.

    Args:
        totals: Weighted value of each alternative in each draw, shape (b, n); NaN where a measure is unknown.
        feasible: Mask of the alternatives that can be chosen in each draw, shape (b, n).
        row: Row of the choice; None for the claim that nothing is feasible.
        margin: The practically irrelevant difference of value.
    """
    if row is None:
        return float((~feasible.any(axis=1)).mean())
    worth = np.where(feasible, np.nan_to_num(totals), -np.inf)
    return float((feasible[:, row] & (worth[:, row] >= worth.max(axis=1) - margin - TIE_TOLERANCE)).mean())


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _MovingDraws:
    """Draws of a measure, shifted by the estimates of a repeated study.

    Attributes:
        rows: The draws, shape (b, n); NaN if unknown.
        centres: Their means, shape (n,).
        least: The least draw of any alternative; NaN if none is known.
        greatest: The greatest draw of any alternative; NaN if none is known.
    """

    rows: Array
    centres: Array
    least: float
    greatest: float

    @staticmethod
    def of(rows: Array) -> _MovingDraws:
        """The draws of a measure."""
        return _MovingDraws(
            rows=rows,
            # An alternative that has a draw has all, and one without stays unknown.
            centres=rows.mean(axis=0),
            least=float(np.fmin.reduce(rows, axis=None, initial=np.nan)),
            greatest=float(np.fmax.reduce(rows, axis=None, initial=np.nan)),
        )

    def at(self, some: NDArray[np.intp], other: int) -> Array:
        """Some draws of a study that estimates one of them, shape (k, n), within the range of all draws."""
        moved = self.rows[some]
        moved += self.rows[other]
        moved -= self.centres
        return moved if math.isnan(self.least) else np.clip(moved, self.least, self.greatest, out=moved)


def _drawn(
    table: EvidenceTable,
    proportions: Collection[str],
    levels: NDArray[np.intp] | None,
    draws: int,
    generator: np.random.Generator,
    *,
    apart: bool,
) -> dict[str, Array]:
    """Draws of the columns that are observed in trials; an end of an interval moves as its estimate does."""
    observed = [measure for measure in table.measures if measure in table.samples and not is_end(measure, table)]
    rows = [
        ObservedRows(values=known_values(table.samples[measure]), is_proportion=measure in proportions)
        for measure in observed
    ]
    found = posterior_means(rows, draws=draws, generator=generator, levels=levels, apart=apart)
    drawn = dict(zip(observed, found, strict=True))
    for measure in table.measures:
        if measure in table.samples and is_end(measure, table):
            base = measure.rpartition(".")[0]
            drawn[measure] = drawn[base] + (table.column(measure) - table.column(base))
    return drawn


def is_end(measure: str, table: EvidenceTable) -> bool:
    """True if a column is an end of the interval of another one."""
    base, dot, end = measure.rpartition(".")
    return bool(dot) and end in _ENDS and base in table.measures


def known_values(samples: Samples) -> Array:
    """Values of replicates, shape (n, r); NaN where one lacks it or was not run."""
    return np.where(samples.ran, samples.values, np.nan)
