"""Largest relative error of all assumed costs together that leaves the choice best."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rgss.decision.robustness.linearity import is_affine
from rgss.decision.robustness.remeasuring import Remeasuring
from rgss.decision.what_if import COST, ModelNumber, assumed_numbers, symbols_of
from rgss.tradeoff.problem import Comparison, Threshold
from rgss.tradeoff.programs import Preferences, weighted_values
from rgss.tradeoff.robustness import (
    BoxProblem,
    BoxRange,
    box_range,
    condition_masks,
)


@dataclass(frozen=True, slots=True, kw_only=True)
class CostBox:
    """Largest joint error of all assumed costs.

    Attributes:
        numbers: The costs.
        column: The measure that they add up to.
        range: The greatest ±x % that does not change the choice, and the worst corner.
        unmoved: The costs that are assumed to be 0, which no percentage changes.
    """

    numbers: tuple[ModelNumber, ...]
    column: str
    range: BoxRange
    unmoved: tuple[str, ...]


def cost_box(remeasuring: Remeasuring, preferences: Preferences, chosen: int) -> CostBox | str:
    """The largest x such that the choice stays best with every assumed cost anywhere within ±x %.

    Args:
        remeasuring: The evidence, which can be evaluated again.
        preferences: Preferences by which the alternatives are compared; the highest weighted value is chosen.
        chosen: The row of the choice.

    Returns:
        The range; a reason, as part of a sentence, if it does not apply.
    """
    measures, table = remeasuring.project.measures, remeasuring.table
    numbers = tuple(
        number for number in assumed_numbers(remeasuring.project) if number.component and number.name == COST
    )
    symbols = frozenset().union(*(symbols_of(measures, number) for number in numbers))
    decisive = {*preferences.weighting.deciding_measures, *(condition.measure for condition in preferences.conditions)}
    columns = [
        column
        for column in table.measures
        if column in decisive and symbols & measures.used[remeasuring.measure_of(column)]
    ]
    if len(columns) != 1:
        if not columns:
            return "assumed costs decide through no measure"
        return f"assumed costs decide through {', '.join(columns)}, not through one measure"
    (column,) = columns
    measure = remeasuring.measure_of(column)
    function = next((one for one in preferences.value_functions if one.measure == column), None)
    conditions = [condition for condition in preferences.conditions if condition.measure == column]
    if measures.measure(measure).from_trials or not is_affine(measures, measure, symbols):
        return f"{column} is not a sum of assumed costs"
    if function is None:
        return f"{column} has no value function, and decides by its limit alone"
    if function.breakpoints is None:
        return f"the value of {column} is not piecewise linear"
    if not all(isinstance(condition, Threshold) for condition in conditions):
        return f"there are demands on replicates of {column}"
    problem = _box_problem(remeasuring, preferences, numbers, column, function.breakpoints)
    return CostBox(
        numbers=numbers,
        column=column,
        range=box_range(problem, chosen),
        unmoved=tuple(number.id for number in numbers if number.value == 0.0),
    )


def _box_problem(
    remeasuring: Remeasuring,
    preferences: Preferences,
    numbers: tuple[ModelNumber, ...],
    column: str,
    breakpoints: Sequence[tuple[float, float]],
) -> BoxProblem:
    """Total value of each alternative as a function of the costs, which add up to one measure."""
    table = remeasuring.table
    assumed = np.array([number.value for number in numbers])
    quantities = table.column(column)
    coefficients = np.zeros((len(table), len(numbers)))
    for place, number in enumerate(numbers):
        step = max(1.0, abs(number.value))
        moved = remeasuring.table_with(number, number.value + step).column(column)
        coefficients[:, place] = (moved - quantities) / step
    weight = preferences.weighting.weights[column]
    points = np.array(breakpoints, dtype=np.float64)
    totals = weighted_values(preferences, table)
    conditions = [condition for condition in preferences.conditions if condition.measure == column]
    bounds = threshold_bounds([condition for condition in conditions if isinstance(condition, Threshold)])
    others = [
        mask
        for condition, mask in zip(preferences.conditions, condition_masks(preferences, table), strict=True)
        if condition.measure != column
    ]
    feasible = np.logical_and.reduce([~np.isnan(totals), *others])
    return BoxProblem(
        base=quantities - coefficients @ assumed,
        coefficients=coefficients,
        assumed=assumed,
        points=points,
        weight=weight,
        rest=totals - weight * np.interp(quantities, points[:, 0], points[:, 1]),
        feasible=feasible,
        at_least=bounds[0],
        at_most=bounds[1],
    )


def threshold_bounds(thresholds: Sequence[Threshold]) -> tuple[float, float]:
    """The tightest of several thresholds from either side."""
    least = max((one.value for one in thresholds if one.comparison is Comparison.AT_LEAST), default=-math.inf)
    most = min((one.value for one in thresholds if one.comparison is Comparison.AT_MOST), default=math.inf)
    return least, most
