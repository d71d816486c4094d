"""Errors of assumed numbers that do not change the choice: each alone, and all costs together."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from rgss.decision.robustness.linearity import is_affine
from rgss.decision.robustness.remeasuring import Remeasuring
from rgss.decision.robustness.rules import allowed_variants, rule_kinks
from rgss.decision.what_if import ModelNumber, assumed_numbers, simulated_numbers, symbols_of
from rgss.errors import DefinitionError
from rgss.tradeoff.problem import EvidenceTable, Samples, Threshold
from rgss.tradeoff.programs import Preferences, violations, weighted_values
from rgss.tradeoff.robustness import (
    AssumptionRange,
    Standing,
    linear_range,
    scanned_range,
)

SCAN_FACTOR = 4.0
"""A number with a nonlinear effect is scanned over [x/4, 4x]."""


@dataclass(frozen=True, slots=True, kw_only=True)
class AssumptionFinding:
    """Effect of an assumed number on the choice.

    Attributes:
        number: The number.
        columns: The measures of the trade-off that depend on it; may be empty.
        range: The values over which the choice stays best; None if it could not be computed, with
            the reason in `reason`.
        reason: Reason for the lack of a range; empty otherwise.
        simulated: True if the trials were simulated with the number: their evidence is held fixed, although
            another value would need other trials.
    """

    number: ModelNumber
    columns: tuple[str, ...]
    range: AssumptionRange | None
    reason: str
    simulated: bool


def assumption_findings(
    remeasuring: Remeasuring, preferences: Preferences, chosen: int
) -> tuple[AssumptionFinding, ...]:
    """Ranges of each assumed number of the catalogue and of the measures, one at a time.

    Where every affected measure is affine in the number and its value function piecewise linear,
    the ends are solved for exactly; otherwise the dependence is scanned and bisected.

    Args:
        remeasuring: The evidence, which can be evaluated again.
        preferences: Preferences by which the alternatives are compared; the highest weighted value is chosen.
        chosen: The row of the choice.
    """
    numbers = assumed_numbers(remeasuring.project)
    variants = [entry.variant for entry in remeasuring.measured]
    follower = _Follower(
        remeasuring=remeasuring,
        preferences=preferences,
        chosen=chosen,
        simulated=simulated_numbers(remeasuring.project, variants, numbers),
    )
    return tuple(follower.finding(number) for number in numbers)


@dataclass(frozen=True, slots=True, kw_only=True)
class _Follower:
    """Range computation for one number after another."""

    remeasuring: Remeasuring
    preferences: Preferences
    chosen: int
    simulated: frozenset[str]

    def finding(self, number: ModelNumber) -> AssumptionFinding:
        columns = self._decisive(self.remeasuring.affected(number))
        found, reason = self._range(number, columns)
        return AssumptionFinding(
            number=number,
            columns=columns,
            range=found,
            reason=reason,
            simulated=number.id in self.simulated,
        )

    def _decisive(self, columns: Sequence[str]) -> tuple[str, ...]:
        """The columns with a weight or a bound."""
        preferences = self.preferences
        decisive = {*preferences.weighting.deciding_measures}
        decisive.update(condition.measure for condition in preferences.conditions)
        return tuple(column for column in columns if column in decisive)

    def _range(self, number: ModelNumber, columns: tuple[str, ...]) -> tuple[AssumptionRange | None, str]:
        if number.value < 0.0:
            return None, "it is negative"
        project, measured = self.remeasuring.project, self.remeasuring.measured
        allowed = allowed_variants(project, measured, number)
        ends_of_rules = rule_kinks(project, measured, number)
        if ends_of_rules is not None and all(self._is_linear(number, column) for column in columns):
            line = _Line.of(self.remeasuring, number, columns)
            kinks = [*self._kinks(line, columns), *ends_of_rules]
            return (
                linear_range(
                    lambda value: self._standing(line.at(value), allowed(value)),
                    self.chosen,
                    number.value,
                    kinks=np.array(kinks),
                    lowest=0.0,
                    highest=math.inf,
                ),
                "",
            )
        if number.value == 0.0:
            return None, "it is assumed to be 0 and its effect is not linear"

        def evaluate(value: float) -> Standing:
            try:
                table = self.remeasuring.table_with(number, value)
            except DefinitionError:
                # If a measure is undefined there, nothing can be chosen.
                return Standing(totals=np.full(len(self.remeasuring.table), np.nan), feasible=allowed(value) & False)
            return self._standing(table, allowed(value))

        found = scanned_range(
            evaluate,
            self.chosen,
            number.value,
            lowest=number.value / SCAN_FACTOR,
            highest=number.value * SCAN_FACTOR,
        )
        return found, ""

    def _standing(self, table: EvidenceTable, allowed: NDArray[np.bool_]) -> Standing:
        feasible = ~violations(self.preferences, table).any(axis=1) & allowed
        return Standing(totals=weighted_values(self.preferences, table), feasible=feasible)

    def _is_linear(self, number: ModelNumber, column: str) -> bool:
        remeasuring = self.remeasuring
        measures, measure = remeasuring.project.measures, remeasuring.measure_of(column)
        function = next((one for one in self.preferences.value_functions if one.measure == column), None)
        weighted = column in self.preferences.weighting.deciding_measures
        return (
            is_affine(measures, measure, symbols_of(measures, number))
            and (not weighted or (function is not None and function.breakpoints is not None))
            and all(
                isinstance(condition, Threshold)
                for condition in self.preferences.conditions
                if condition.measure == column
            )
        )

    def _kinks(self, line: _Line, columns: tuple[str, ...]) -> list[float]:
        """Points at which a quantity meets a breakpoint of its value function or a threshold."""
        levels: dict[str, set[float]] = {column: set() for column in columns}
        for function in self.preferences.value_functions:
            if function.measure in levels:
                levels[function.measure].update(quantity for quantity, _ in function.breakpoints or ())
        for condition in self.preferences.conditions:
            if condition.measure in levels:
                levels[condition.measure].add(condition.limit)
        return [
            kink for column, found in levels.items() for level in sorted(found) for kink in line.reaching(column, level)
        ]


@dataclass(frozen=True, slots=True, kw_only=True)
class _Line:
    """The evidence as an affine function of one number."""

    table: EvidenceTable
    start: float
    slopes: dict[str, NDArray[np.float64]]
    sample_slopes: dict[str, NDArray[np.float64]]

    @staticmethod
    def of(remeasuring: Remeasuring, number: ModelNumber, columns: tuple[str, ...]) -> _Line:
        table = remeasuring.table
        if not columns:
            return _Line(table=table, start=number.value, slopes={}, sample_slopes={})
        step = max(1.0, abs(number.value))
        moved = remeasuring.table_with(number, number.value + step)
        return _Line(
            table=table,
            start=number.value,
            slopes={column: (moved.column(column) - table.column(column)) / step for column in columns},
            sample_slopes={
                column: (moved.samples[column].values - table.samples[column].values) / step
                for column in columns
                if column in table.samples
            },
        )

    def at(self, value: float) -> EvidenceTable:
        quantities, samples = self.table.quantities.copy(), dict(self.table.samples)
        for column, slope in self.slopes.items():
            quantities[:, self.table.measures.index(column)] += slope * (value - self.start)
        for column, slope in self.sample_slopes.items():
            old = self.table.samples[column]
            samples[column] = Samples(values=old.values + slope * (value - self.start), ran=old.ran)
        return replace(self.table, quantities=quantities, samples=samples)

    def reaching(self, column: str, level: float) -> list[float]:
        """The values at which a quantity of the column is at a level."""
        slope, quantities = self.slopes[column], self.table.column(column)
        moving = np.isfinite(quantities) & (np.abs(slope) > 0.0)
        return sorted(set((self.start + (level - quantities[moving]) / slope[moving]).tolist()))
