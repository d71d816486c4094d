"""Outcomes of the evidence's uncertainty: every alternative valued and judged in posterior draws of its measures."""

from __future__ import annotations

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
from rgss.tradeoff.programs import Preferences, condition_column, keeps
from rgss.tradeoff.robustness.acceptability import Outcomes
from rgss.tradeoff.weights import WeightSet, sample_weights

DRAWS = 1_000
"""Draws of the evidence, where memory has room for their values."""

FEWEST_DRAWS = 64

_MOST_VALUES = 8_000_000
_ENDS = ("low", "high")
_STUDIES = 40
"""Emulated repetitions of a study."""
_DRAWS_OF_A_STUDY = 500


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PosteriorOutcomes:
    """Posterior draws of the evidence of n alternatives, and what they mean.

    Attributes:
        preferences: What is wanted.
        table: The evidence.
        drawn: Draws of each measure that is observed in trials, shape (b, n); NaN where unknown.
        outcomes: Values and feasibility in each draw.
    """

    preferences: Preferences
    table: EvidenceTable
    drawn: Mapping[str, Array]
    outcomes: Outcomes

    @staticmethod
    def of(
        preferences: Preferences,
        table: EvidenceTable,
        proportions: Collection[str],
        *,
        generator: np.random.Generator,
        levels: NDArray[np.intp] | None = None,
        draws: int = DRAWS,
    ) -> PosteriorOutcomes:
        """Draw the evidence of a table.

        Demands on replicates are judged by replicates that are drawn anew with replacement.

        Args:
            preferences: What is wanted.
            table: The evidence.
            proportions: The measures that are shares of trials.
            generator: Where randomness comes from.
            levels: The level of each alternative in each factor of its design, shape (n, f), in the
                table's order; None where designs are not made of levels.
            draws: How many draws; fewer where their values would not fit in memory.
        """
        size = max(1, len(table) * len(preferences.weighting.deciding_measures))
        draws = min(draws, max(FEWEST_DRAWS, _MOST_VALUES // size))
        drawn = _drawn(table, proportions, levels, draws, generator)
        replicates = max((samples.values.shape[1] for samples in table.samples.values()), default=0)
        picks = generator.integers(0, max(replicates, 1), size=(draws, replicates))
        values, feasible = _evaluated(preferences, table, drawn, picks)
        chances = np.full(draws, 1.0 / draws)
        outcomes = Outcomes(values=values, feasible=feasible, probabilities=chances, exact=False)
        return PosteriorOutcomes(preferences=preferences, table=table, drawn=drawn, outcomes=outcomes)

    @property
    def totals(self) -> Array:
        """Weighted value of each alternative in each draw, shape (b, n); NaN where a measure is unknown."""
        weighting = self.preferences.weighting
        weights = np.array([weighting.weights[measure] for measure in weighting.deciding_measures])
        return np.asarray(self.outcomes.values @ weights, dtype=np.float64)

    def first_errors(self, weights: WeightSet, generator: np.random.Generator) -> Array:
        """The standard error of each first-rank acceptability, over repetitions of the study, shape (n,).

        Another study of the same size would estimate something else. What it would estimate is
        drawn as the evidence's own draws are, and what its draws would be is what this study's are
        of its estimates: a parametric bootstrap by the posterior.

        Args:
            weights: The admitted weights.
            generator: Where randomness comes from.
        """
        count = len(self.table)
        inner = max(FEWEST_DRAWS, min(_DRAWS_OF_A_STUDY, _MOST_VALUES // max(1, self.outcomes.shape[1])))
        draws = self.outcomes.shape[0]
        # An alternative that has a draw has all, and one without stays unknown.
        centres = {measure: rows.mean(axis=0) for measure, rows in self.drawn.items()}
        firsts = np.empty((_STUDIES, count))
        for study in range(_STUDIES):
            other = int(generator.integers(draws))
            inside = generator.integers(0, draws, size=inner)
            moved = {
                measure: _kept_in_range(rows[inside] + rows[other] - centres[measure], rows)
                for measure, rows in self.drawn.items()
            }
            picks = np.zeros((inner, 0), dtype=np.intp)
            values, feasible = _evaluated(self.preferences, self.table, moved, picks)
            chosen = sample_weights(weights, inner, generator).weights
            totals = np.where(feasible, np.einsum("bnm,bm->bn", np.nan_to_num(values), chosen), -np.inf)
            best = totals.max(axis=1, keepdims=True)
            firsts[study] = (feasible & (totals >= best - TIE_TOLERANCE)).mean(axis=0)
        variance = firsts.var(axis=0, ddof=1) - (firsts * (1.0 - firsts)).mean(axis=0) / inner
        return np.asarray(np.sqrt(np.maximum(variance, 0.0)), dtype=np.float64)


def _drawn(
    table: EvidenceTable,
    proportions: Collection[str],
    levels: NDArray[np.intp] | None,
    draws: int,
    generator: np.random.Generator,
) -> dict[str, Array]:
    """Draws of the columns that are observed in trials; an end of an interval moves as its estimate does."""
    observed = [measure for measure in table.measures if measure in table.samples and not _is_end(measure, table)]
    rows = [
        ObservedRows(values=_known(table.samples[measure]), is_proportion=measure in proportions)
        for measure in observed
    ]
    found = posterior_means(rows, draws=draws, generator=generator, levels=levels)
    drawn = dict(zip(observed, found, strict=True))
    for measure in table.measures:
        if measure in table.samples and _is_end(measure, table):
            base = measure.rpartition(".")[0]
            drawn[measure] = drawn[base] + (table.column(measure) - table.column(base))
    return drawn


def _is_end(measure: str, table: EvidenceTable) -> bool:
    base, dot, end = measure.rpartition(".")
    return bool(dot) and end in _ENDS and base in table.measures


def _known(samples: Samples) -> Array:
    return np.where(samples.ran, samples.values, np.nan)


def _evaluated(
    preferences: Preferences, table: EvidenceTable, drawn: Mapping[str, Array], picks: NDArray[np.intp]
) -> tuple[Array, NDArray[np.bool_]]:
    """Single values, shape (b, n, m), and which alternatives can be chosen, shape (b, n)."""
    draws, count = len(picks), len(table)
    feasible = np.ones((draws, count), dtype=np.bool_)
    columns = []
    for measure in preferences.weighting.deciding_measures:
        quantities = drawn.get(measure)
        quantities = np.tile(table.column(measure), (draws, 1)) if quantities is None else quantities
        known = ~np.isnan(quantities)
        flat = preferences.value_function(measure).values_at(np.where(known, quantities, 0.0).ravel())
        columns.append(np.where(known, flat.reshape(draws, count), np.nan))
        feasible &= known
    for condition in preferences.conditions:
        if isinstance(condition, Threshold):
            quantities = drawn.get(condition.measure)
            quantities = table.column(condition.measure)[None] if quantities is None else quantities
            feasible &= keeps(condition.sense, quantities, condition.limit)
        else:
            statistic = _drawn_statistics(preferences, table, picks, condition)
            feasible &= keeps(condition.sense, statistic, condition.limit)
    return np.stack(columns, axis=2), feasible


def _drawn_statistics(
    preferences: Preferences, table: EvidenceTable, picks: NDArray[np.intp], condition: object
) -> Array:
    """The statistic of a demand on replicates in each draw, shape (b, n); the table's own without picks."""
    risk = next(one for one in preferences.risks if one is condition)
    if not picks.shape[1]:
        return condition_column(risk, table)[None]
    samples = table.replicates(risk.measure)
    found = np.empty((len(picks), len(table)))
    for draw, pick in enumerate(picks):
        again = Samples(values=samples.values[:, pick], ran=samples.ran[:, pick])
        one = EvidenceTable(
            variants=table.variants, measures=table.measures, quantities=table.quantities, samples={risk.measure: again}
        )
        found[draw] = condition_column(risk, one)
    return found


def _kept_in_range(moved: Array, rows: Array) -> Array:
    """Moved draws, none of them beyond the least and the greatest draw of any alternative."""
    return np.clip(moved, np.nanmin(rows), np.nanmax(rows)) if np.isfinite(rows).any() else moved
