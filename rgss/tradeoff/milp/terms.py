"""The terms of the mixed-integer programs: each is small and compiles itself to CVXPY.

A term is compiled against a `Selection`, so that it serves the choice among variants and the choice
of levels alike. Each term can also be evaluated at an alternative in plain arithmetic.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Protocol

from rgss.tradeoff.milp.selection import Selection
from rgss.tradeoff.milp.sums import limit_of_sum, order_of_sum, value_of_sum
from rgss.tradeoff.problem import (
    EVIDENCE_PREFIX,
    Alternative,
    Comparison,
    Condition,
    Threshold,
    ValueFunction,
    replicates_of,
)


class ObjectiveTerm(Protocol):
    """Term of the maximised objective."""

    def compile(self, selection: Selection) -> Any:
        """The term as a scalar, concave CVXPY expression."""
        ...


@dataclass(frozen=True, slots=True, kw_only=True)
class WeightedValue:
    """The weighted value of the selected alternative in one measure: w v(m).

    Attributes:
        function: The value function v of the measure m.
        weight: The weight w.
        replicate: The replicate whose quantity is valued; None for the measure's estimate.
    """

    function: ValueFunction
    weight: float
    replicate: int | None = None

    def compile(self, selection: Selection) -> Any:
        """The term as a scalar CVXPY expression."""
        measure = self.function.measure
        if self.replicate is None:
            linear = selection.linear_quantity(measure)
            if linear is not None:
                return self.weight * value_of_sum(linear, self.function)
            return selection.of_selected(measure, [self._coefficient(q) for q in selection.quantities(measure)])
        rows = selection.replicates(measure)
        return selection.of_selected_replicates(measure, [[self._coefficient(self._entry(row))] for row in rows])[0]

    def at(self, alternative: Alternative) -> float:
        """The term at an alternative."""
        if self.replicate is None:
            return self._coefficient(alternative.measures[self.function.measure])
        return self._coefficient(self._entry(replicates_of(alternative, self.function.measure)))

    def _entry(self, row: Sequence[float | None]) -> float | None:
        # A measure that follows from the design alone is the same in every replicate.
        if self.replicate is None or len(row) == 1:
            return row[0]
        return row[self.replicate] if self.replicate < len(row) else None

    def _coefficient(self, quantity: float | None) -> float:
        # An unknown measure has no value; the constraints forbid to select it, whatever this entry is.
        return 0.0 if quantity is None else self.weight * self.function.value_at(quantity)


@dataclass(frozen=True, slots=True, kw_only=True)
class QuantityRank:
    """The rank of the selected alternative's quantity among all: the higher, the better.

    Of one measure alone only the order counts, so its rank is maximised instead of the quantity:
    that is exact whatever the measure's unit and however close two quantities are.

    Attributes:
        measure: The measure.
        sense: At least if more of it is better, at most if less is.
    """

    measure: str
    sense: Comparison

    def compile(self, selection: Selection) -> Any:
        """The term as a scalar CVXPY expression."""
        linear = selection.linear_quantity(self.measure)
        if linear is not None:
            return order_of_sum(linear, self.sense)
        quantities = selection.quantities(self.measure)
        known = {quantity for quantity in quantities if quantity is not None}
        ordered = sorted(known, reverse=self.sense is Comparison.AT_MOST)
        ranks = {quantity: float(rank) for rank, quantity in enumerate(ordered)}
        return selection.of_selected(
            self.measure, [0.0 if quantity is None else ranks[quantity] for quantity in quantities]
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class WorstOf:
    """The least of several sums of terms, each with a constant: the value of the worst scenario.

    Attributes:
        scenarios: For each scenario a constant and the terms that are added to it.
    """

    scenarios: tuple[tuple[float, tuple[WeightedValue, ...]], ...]

    def compile(self, selection: Selection) -> Any:
        """The term as a scalar, concave CVXPY expression."""
        import cvxpy

        sums = [constant + sum(term.compile(selection) for term in terms) for constant, terms in self.scenarios]
        return sums[0] if len(sums) == 1 else cvxpy.minimum(*sums)

    def at(self, alternative: Alternative) -> float:
        """The term at an alternative."""
        return min(constant + math.fsum(term.at(alternative) for term in terms) for constant, terms in self.scenarios)


@dataclass(frozen=True, slots=True, kw_only=True)
class EvidenceConstraint:
    """The selected alternative is known in a measure.

    Attributes:
        measure: The measure.
        every_replicate: Whether each of its replicates must have the measure, too.
    """

    measure: str
    every_replicate: bool = False

    @property
    def name(self) -> str:
        """The pseudo requirement."""
        return EVIDENCE_PREFIX + self.measure

    def compile(self, selection: Selection) -> Any:
        """The term as a CVXPY constraint."""
        import cvxpy

        if self.every_replicate:
            unknown = [[float(None in row)] for row in selection.replicates(self.measure)]
            return selection.of_selected_replicates(self.measure, unknown)[0] <= 0.0
        if selection.linear_quantity(self.measure) is not None:
            # Of a sum, what is unknown cannot be selected in the first place.
            return cvxpy.Constant(0.0) <= 0.0
        missing = [float(quantity is None) for quantity in selection.quantities(self.measure)]
        return selection.of_selected(self.measure, missing) <= 0.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Exclusion:
    """Something else than an alternative is selected."""

    alternative: Alternative

    @property
    def name(self) -> str:
        """The constraint in words."""
        return f"not variant {self.alternative.variant}"

    def compile(self, selection: Selection) -> Any:
        """The term as a CVXPY constraint."""
        return selection.exclusion(self.alternative)


Constraint = Condition | EvidenceConstraint | Exclusion
"""Anything that the selected alternative must keep; each has a `name` that results refer to."""


def compile_constraint(constraint: Constraint, selection: Selection) -> Any:
    """A constraint on the selected alternative, as a CVXPY constraint."""
    if isinstance(constraint, EvidenceConstraint | Exclusion):
        return constraint.compile(selection)
    return _compile_condition(constraint, selection)


def _compile_condition(condition: Condition, selection: Selection) -> Any:
    """The row of a threshold, a chance or a tail.

    Of a selection of exactly one alternative, the quantity, the share of replicates met and the mean
    of the worst replicates are those of that alternative, so the condition is linear in the
    variables. The margins are scaled by the smallest violation and cut to [-1, 1]. That changes
    nothing, and no violation is so small that it would pass under the solver's feasibility
    tolerance, whatever the measure's unit (coefficient tightening).
    """
    if isinstance(condition, Threshold):
        linear = selection.linear_quantity(condition.measure)
        if linear is not None:
            return limit_of_sum(linear, condition.sense, condition.limit)
        quantities = selection.quantities(condition.measure)
        return selection.of_selected(condition.measure, row_coefficients(condition, quantities)) >= 0.0
    statistics = [condition.of_replicates(row) for row in selection.replicates(condition.measure)]
    coefficients = [[entry] for entry in row_coefficients(condition, statistics)]
    return selection.of_selected_replicates(condition.measure, coefficients)[0] >= 0.0


def row_coefficients(condition: Condition, statistics: Sequence[float | None]) -> list[float]:
    """Tightened coefficients of a condition's row: not negative where its statistic keeps the limit."""
    sense, limit = condition.sense, condition.limit
    margins = []
    for statistic in statistics:
        margin = -1.0 if statistic is None else sense.margin(statistic, limit)
        margins.append(max(0.0, margin) if sense.holds(statistic, limit) else margin)
    smallest_violation = min((-margin for margin in margins if margin < 0.0), default=1.0)
    return [
        -1.0 if margin < 0.0 else 1.0 if margin >= smallest_violation else margin / smallest_violation
        for margin in margins
    ]
