"""A trade-off as plain arrays, for analyses that look at it as a whole: values, weights, feasibility."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rgss.tradeoff.infeasibility import resampled_tables
from rgss.tradeoff.problem import EvidenceTable, Resamples, tabulated
from rgss.tradeoff.programs import TradeProblem, value_column, violations
from rgss.tradeoff.weights import WeightSet


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class TradeArrays:
    """The alternatives of a trade-off as arrays, by ascending id.

    Attributes:
        variants: Ids, shape (n,).
        measures: The m valued measures, in the order of the weights, those of weight 0 included.
        quantities: Quantities in the measures' units, shape (n, m); NaN where unknown.
        values: Values from 0 to 1, shape (n, m); NaN where unknown.
        weights: Weights, shape (m,).
        requirements: Ids of the r demands.
        violated: Which alternative violates which demand, shape (n, r).
        feasible: Which alternatives violate nothing, shape (n,).
    """

    variants: NDArray[np.int64]
    measures: tuple[str, ...]
    quantities: NDArray[np.float64]
    values: NDArray[np.float64]
    weights: NDArray[np.float64]
    requirements: tuple[str, ...]
    violated: NDArray[np.bool_]
    feasible: NDArray[np.bool_]


def trade_arrays(problem: TradeProblem) -> TradeArrays:
    """The arrays of a trade-off."""
    table = tabulated(problem.alternatives)
    measures = tuple(problem.weighting.weights)
    violated = violations(problem, table)
    return TradeArrays(
        variants=table.variants,
        measures=measures,
        quantities=np.stack([table.column(measure) for measure in measures], axis=1),
        values=_values(problem, table),
        weights=np.array([problem.weighting.weights[measure] for measure in measures]),
        requirements=problem.requirements,
        violated=violated,
        feasible=np.asarray(~violated.any(axis=1)),
    )


def resampled_arrays(problem: TradeProblem, resamples: Resamples) -> tuple[NDArray[np.float64], NDArray[np.bool_]]:
    """Values and feasibility as they might have been with other draws of the replicates.

    Every demand is judged anew in each draw: means, chances and tails alike.

    Args:
        problem: The trade-off.
        resamples: The b draws.

    Returns:
        Values, shape (b, n, m), NaN where unknown; feasibility, shape (b, n).
    """
    values, feasible = [], []
    for table in resampled_tables(tabulated(problem.alternatives), resamples):
        values.append(_values(problem, table))
        feasible.append(~violations(problem, table).any(axis=1))
    return np.stack(values), np.stack(feasible)


def admitted_weights(problem: TradeProblem) -> WeightSet:
    """The weights that agree with everything that was elicited, over the measures of `trade_arrays`."""
    measures = tuple(problem.weighting.weights)
    inequality, limits = problem.weight_bounds.inequalities(measures)
    equality, equals = problem.weight_bounds.equations(measures)
    return WeightSet(size=len(measures), inequality=inequality, limits=limits, equality=equality, equals=equals)


def _values(problem: TradeProblem, table: EvidenceTable) -> NDArray[np.float64]:
    return np.stack(
        [value_column(problem.value_function(measure), table.column(measure)) for measure in problem.weighting.weights],
        axis=1,
    )
