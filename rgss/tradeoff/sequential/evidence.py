"""Evidence of a trade-off for sequential tests: fixed quantities, and observations of each replicate."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from rgss.errors import TradeoffError
from rgss.measures import Range
from rgss.tradeoff.problem import Comparison, EvidenceTable, Threshold, ValueFunction, tabulated
from rgss.tradeoff.programs import TradeProblem
from rgss.tradeoff.sequential.observed import Observed
from rgss.tradeoff.sequential.support import unsupported_reason


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Hopes:
    """Values and shortfalls of n alternatives if their estimates err to their disadvantage.

    Attributes:
        values: Weighted value, shape (n,); NaN where a measure is unknown.
        shortfalls: The largest share of a threshold by which each still misses one, the tolerance granted, shape (n,);
            0 where every threshold is kept, infinite where a measure is unknown or the design misses one.
    """

    values: NDArray[np.float64]
    shortfalls: NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SequentialEvidence:
    """Evidence on n alternatives.

    Attributes:
        problem: The trade-off.
        proportions: The measures that are shares of trials.
        table: The alternatives, by ascending id.
        replicates: Number of replicates of each, shape (n,).
        thresholds: Thresholds of the requirements.
        observed: The relevant measures observed in trials.
        value_functions: Value functions of the measures that decide.
        fixed_value: Contribution to the value of the measures that depend only on the design, shape (n,).
        fixed_met: Mask of the alternatives that meet every threshold on such measures, shape (n,).
        values: Weighted value by the estimates, shape (n,); NaN where a measure is unknown.
        feasible: Mask of the alternatives that meet all conditions by their estimates, within the tolerance.
        tolerance: Share of a threshold on observed measures by which the choice may violate it.
        last_of_equals: True if the largest id of equals is the choice; the smallest otherwise.
        twins: The group of alternatives with which each shares all trials, for any seed, shape (n,).
        levels: The level of each alternative in each factor of its design, shape (n, f); None without levels.
    """

    problem: TradeProblem
    proportions: frozenset[str]
    table: EvidenceTable
    replicates: NDArray[np.int64]
    thresholds: tuple[Threshold, ...]
    observed: tuple[Observed, ...]
    fixed_value: NDArray[np.float64]
    fixed_met: NDArray[np.bool_]
    values: NDArray[np.float64]
    feasible: NDArray[np.bool_]
    twins: NDArray[np.intp]
    levels: NDArray[np.intp] | None = None
    value_functions: tuple[ValueFunction, ...] = ()
    tolerance: float = 0.0
    last_of_equals: bool = False

    @staticmethod
    def of(
        problem: TradeProblem,
        proportions: Collection[str],
        *,
        twins: Mapping[int, int] | None = None,
        levels: NDArray[np.intp] | None = None,
        tolerance: float = 0.0,
        last_of_equals: bool = False,
        bounds: Mapping[int, Mapping[str, Range]] | None = None,
    ) -> SequentialEvidence:
        """Evidence of a trade-off.

        Args:
            problem: The trade-off, whose alternatives have their replicates.
            proportions: The measures that are shares of trials.
            twins: By alternative, the group with which it shares all trials; each its own by default.
            levels: The level of each alternative, by ascending id, in each factor, shape (n, f).
            tolerance: As the attribute.
            last_of_equals: As the attribute.
            bounds: By alternative and measure, the possible values of a replicate; unknown where it has none.

        Raises:
            TradeoffError: The trade-off is not of weighted values under thresholds on estimates.
        """
        _check(problem)
        table = tabulated(problem.alternatives)
        weights = problem.weighting.weights
        valued = problem.weighting.deciding_measures
        fixed_value, values = np.zeros(len(table)), np.zeros(len(table))
        observed = []
        for measure in dict.fromkeys((*valued, *(one.measure for one in problem.thresholds))):
            function = problem.value_function(measure) if measure in valued else None
            worth = (
                np.zeros(len(table)) if function is None else weights[measure] * _worth(function, table.column(measure))
            )
            values += worth
            if measure not in table.samples:
                fixed_value += worth
                continue
            observed.append(
                Observed(
                    measure=measure,
                    is_proportion=measure in proportions,
                    values=table.samples[measure].values,
                    weight=weights.get(measure, 0.0),
                    function=function,
                    thresholds={at: one for at, one in enumerate(problem.thresholds) if one.measure == measure},
                    bounds=_bounds(table, measure, bounds),
                )
            )
        fixed = [one for one in problem.thresholds if one.measure not in table.samples]
        admitted = [one if one in fixed else one.tolerated(tolerance) for one in problem.thresholds]
        return SequentialEvidence(
            problem=problem,
            proportions=frozenset(proportions),
            table=table,
            replicates=_replicates(table),
            thresholds=problem.thresholds,
            observed=tuple(observed),
            fixed_value=fixed_value,
            fixed_met=_met(table, fixed),
            values=values,
            feasible=_met(table, admitted) & ~np.isnan(values),
            twins=np.array([(twins or {}).get(each, each) for each in table.variants.tolist()], dtype=np.intp),
            levels=levels,
            value_functions=problem.deciding_functions,
            tolerance=tolerance,
            last_of_equals=last_of_equals,
        )

    @property
    def tolerant_problem(self) -> TradeProblem:
        """The trade-off with the tolerance granted to the thresholds on measures that are observed in trials."""
        granted = (
            one.tolerated(self.tolerance) if one.measure in self.table.samples else one for one in self.thresholds
        )
        return replace(self.problem, thresholds=tuple(granted))

    def is_settled_by_design(self, row: int, rival: int, margin: float) -> bool:
        """True if no replicate can show that an alternative is worth more than a rival by a margin.

        So it is where both have the same trials whatever the seed, and no measure separates them in those that
        were run: then they differ by their designs alone, which are known.

        Args:
            row: The alternative.
            rival: The rival.
            margin: The difference of value that is practically none.
        """
        if self.twins[row] != self.twins[rival] or (self.fixed_met[row] and not self.fixed_met[rival]):
            return False
        shared = int(min(self.replicates[row], self.replicates[rival]))
        alike = all(
            np.array_equal(one.values[row, :shared], one.values[rival, :shared], equal_nan=True)
            for one in self.observed
        )
        return alike and float(self.fixed_value[row] - self.fixed_value[rival]) <= margin

    def optimistic_values(self) -> NDArray[np.float64]:
        """The values if each proportion were higher by two standard deviations of a fair coin, shape (n,).

        NaN where a threshold is missed even so, or a measure that is weighted is unknown.
        """
        values: NDArray[np.float64] = self.fixed_value.copy()
        values[~self.fixed_met] = np.nan
        for one in self.observed:
            column = self.table.column(one.measure)
            if one.is_proportion:
                column = np.minimum(1.0, column + 1.0 / np.sqrt(np.maximum(self.replicates, 1)))
            if one.function is not None:
                values += one.weight * _worth(one.function, column)
            for threshold in one.thresholds.values():
                missed = threshold.comparison.margin(1.0, 0.0) * (column - threshold.value) < 0.0
                values[missed] = np.nan
        return values

    def hopes(self) -> Hopes:
        """The evidence if every estimate from trials were better by one standard error.

        That of a proportion is of its posterior mean under a uniform prior, so that it is not 0 where all replicates
        succeeded or all failed.
        """
        values = self.fixed_value.copy()
        short = np.where(self.fixed_met, 0.0, np.inf)
        for one in self.observed:
            column, error = self.table.column(one.measure), one.standard_errors()
            low, high = column - error, column + error
            if one.is_proportion:
                low, high = np.maximum(low, 0.0), np.minimum(high, 1.0)
            if one.function is not None:
                values += one.weight * np.fmax(_worth(one.function, low), _worth(one.function, high))
            for required in one.thresholds.values():
                threshold = required.tolerated(self.tolerance)
                best = high if threshold.comparison is Comparison.AT_LEAST else low
                missed = threshold.comparison.margin(1.0, 0.0) * (threshold.value - best)
                share = missed / max(abs(threshold.value), np.finfo(np.float64).tiny)
                short = np.maximum(short, np.where(np.isnan(best), np.inf, share))
        return Hopes(values=values, shortfalls=short)

    def is_nearly_feasible(self, row: int, slack: float) -> bool:
        """True if an alternative's estimates miss no threshold by more than a share of it.

        Args:
            row: The alternative.
            slack: The share; only measures that are observed in trials are given it.
        """
        if not self.fixed_met[row] or np.isnan(self.values[row]):
            return False
        return all(
            threshold.comparison.margin(float(self.table.column(one.measure)[row]), threshold.value)
            >= -slack * abs(threshold.value)
            for one in self.observed
            for threshold in one.thresholds.values()
        )


def _check(problem: TradeProblem) -> None:
    ends = [
        (threshold.requirement, measure)
        for threshold in problem.thresholds
        for measure, dot, end in [threshold.measure.rpartition(".")]
        if dot and end in ("low", "high")
    ]
    refused = unsupported_reason(problem.program.name, [risk.requirement for risk in problem.risks], ends)
    if refused is not None:
        raise TradeoffError(refused[0], hint=refused[1])


def _bounds(
    table: EvidenceTable, measure: str, bounds: Mapping[int, Mapping[str, Range]] | None
) -> NDArray[np.float64] | None:
    if bounds is None:
        return None
    ranges = [bounds.get(variant, {}).get(measure, Range()) for variant in table.variants.tolist()]
    return np.array([(each.low, each.high) for each in ranges], dtype=np.float64)


def _worth(function: ValueFunction, column: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.array([np.nan if np.isnan(quantity) else function.value_at(quantity) for quantity in column.tolist()])


def _met(table: EvidenceTable, thresholds: Collection[Threshold]) -> NDArray[np.bool_]:
    met = np.ones(len(table), dtype=np.bool_)
    for threshold in thresholds:
        column = table.column(threshold.measure).tolist()
        met &= np.array([threshold.is_met_by(None if np.isnan(quantity) else quantity) for quantity in column])
    return met


def _replicates(table: EvidenceTable) -> NDArray[np.int64]:
    counts = np.zeros(len(table), dtype=np.int64)
    for samples in table.samples.values():
        counts = np.maximum(counts, samples.ran.sum(axis=1))
    return counts
