"""Every alternative evaluated in NumPy: the oracle against which the solver's answer is held.

It shares the data with the program, but none of the program's arithmetic: values come from
`numpy.interp` over the points of the value functions, feasibility from comparisons of columns.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rgss.tradeoff.problem import EVIDENCE_PREFIX, Comparison, TradeProblem
from rgss.tradeoff.values import TIE_TOLERANCE

_VALUE_DECIMALS = 12


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Enumeration:
    """All alternatives with their values and violations, by ascending id.

    Attributes:
        variants: Ids, shape (n,), ascending.
        values: Weighted value without regard to the thresholds, shape (n,); NaN where a weighted
            measure is unknown. Rounded to 12 decimals, so that alternatives that are equal on
            paper are equal here, in whatever order their terms were added.
        requirements: Ids of the r requirements.
        violated: Which alternative violates which requirement, shape (n, r).
    """

    variants: NDArray[np.int64]
    values: NDArray[np.float64]
    requirements: tuple[str, ...]
    violated: NDArray[np.bool_]

    @property
    def feasible(self) -> NDArray[np.bool_]:
        """Which alternatives violate nothing, shape (n,)."""
        return np.asarray(~self.violated.any(axis=1), dtype=np.bool_)

    @property
    def best_value(self) -> float | None:
        """The highest value of a feasible alternative; None if there is none."""
        values = self.values[self.feasible]
        return float(values.max()) if values.size else None

    @property
    def tied(self) -> NDArray[np.bool_]:
        """Which feasible alternatives have the best value within `TIE_TOLERANCE`, shape (n,)."""
        best = self.best_value
        if best is None:
            return np.zeros(self.variants.shape, dtype=np.bool_)
        return self.feasible & (self.values >= best - TIE_TOLERANCE)

    def value_of(self, variant: int) -> float | None:
        """The value of one alternative; None where it is unknown."""
        value = float(self.values[self._row(variant)])
        return None if np.isnan(value) else value

    def violated_by(self, variant: int) -> tuple[str, ...]:
        """The requirements that one alternative violates."""
        flags = self.violated[self._row(variant)]
        return tuple(requirement for requirement, flag in zip(self.requirements, flags, strict=True) if flag)

    def _row(self, variant: int) -> int:
        return int(np.searchsorted(self.variants, variant))


def enumerate_alternatives(problem: TradeProblem) -> Enumeration:
    """Evaluate every alternative of a trade-off.

    Args:
        problem: The trade-off.

    Returns:
        Values and violations.
    """
    alternatives = sorted(problem.alternatives, key=lambda alternative: alternative.variant)

    def column(measure: str) -> NDArray[np.float64]:
        # None becomes NaN, which compares false and propagates: unknown stays unknown.
        return np.array([alternative.measures[measure] for alternative in alternatives], dtype=np.float64)

    values = np.zeros(len(alternatives))
    for function in sorted(problem.value_functions, key=lambda function: function.measure):
        weight = problem.weighting.weights[function.measure]
        if weight > 0.0:
            points = np.array(sorted(function.points), dtype=np.float64)
            values = values + weight * np.interp(column(function.measure), points[:, 0], points[:, 1])

    requirements = problem.requirements
    violated = np.zeros((len(alternatives), len(requirements)), dtype=np.bool_)
    for threshold in problem.thresholds:
        quantities = column(threshold.measure)
        at_least = threshold.comparison is Comparison.AT_LEAST
        met = quantities >= threshold.value if at_least else quantities <= threshold.value
        violated[:, requirements.index(threshold.requirement)] |= ~met
    for measure in problem.evidence_measures:
        violated[:, requirements.index(EVIDENCE_PREFIX + measure)] |= np.isnan(column(measure))

    return Enumeration(
        variants=np.array([alternative.variant for alternative in alternatives], dtype=np.int64),
        values=np.round(values, _VALUE_DECIMALS),
        requirements=requirements,
        violated=violated,
    )
