"""Preferred alternatives of each program, by enumeration in NumPy: the oracle of the solver's answers.

It shares the data and the corners of the weights with the programs, but neither their terms nor
their stages: values are interpolated column by column, statistics are sorted, orders are masks.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import singledispatch

import numpy as np

from rgss.errors import TradeoffError
from rgss.tradeoff.problem import Comparison, EvidenceTable
from rgss.tradeoff.programs.additive import AdditiveValue
from rgss.tradeoff.programs.lexicographic import Aim, EpsilonConstraint, Lexicographic
from rgss.tradeoff.programs.minimax_regret import MinimaxRegret, Scenarios
from rgss.tradeoff.programs.orderings import Column, Mask, Ordering, ScoreOrdering, SequenceOrdering, Step
from rgss.tradeoff.programs.preferences import Preferences, Program
from rgss.tradeoff.programs.tchebycheff import Tchebycheff

VALUE_DECIMALS = 12
"""Values are rounded to it, so that what is equal on paper is equal whatever the order of summation."""


@singledispatch
def ordering_of(program: Program, preferences: Preferences, table: EvidenceTable, feasible: Mask) -> Ordering:  # noqa: ARG001 - read by the programs' own
    """Ordering of alternatives under a program.

    Args:
        program: The program.
        preferences: The preferences.
        table: The alternatives.
        feasible: Mask of the feasible alternatives, shape (n,).

    Raises:
        TradeoffError: The program has no enumeration.
    """
    raise TradeoffError(
        f"no enumeration is known for the program {program.name!r}", hint="register one with ordering_of"
    )


@ordering_of.register
def _(program: AdditiveValue, preferences: Preferences, table: EvidenceTable, feasible: Mask) -> Ordering:  # noqa: ARG001
    return ScoreOrdering(
        name="value", scores=weighted_values(preferences, table), monotone=_value_columns(preferences, table)
    )


@ordering_of.register
def _(program: Lexicographic, preferences: Preferences, table: EvidenceTable, feasible: Mask) -> Ordering:  # noqa: ARG001
    return SequenceOrdering(steps=_steps(program.aims, table))


@ordering_of.register
def _(program: EpsilonConstraint, preferences: Preferences, table: EvidenceTable, feasible: Mask) -> Ordering:  # noqa: ARG001
    return SequenceOrdering(steps=_steps((program.aim,), table), ties_by_value=weighted_values(preferences, table))


@ordering_of.register
def _(program: Tchebycheff, preferences: Preferences, table: EvidenceTable, feasible: Mask) -> Ordering:  # noqa: ARG001
    deciding = preferences.weighting.deciding_measures
    weights = np.array([preferences.weighting.weights[measure] for measure in deciding])
    aspired = np.array([program.reference.get(measure, 1.0) for measure in deciding])
    values = _value_columns(preferences, table)
    shortfalls = aspired - values
    distance = (weights * shortfalls).max(axis=1) + program.augmentation * shortfalls.sum(axis=1)
    return ScoreOrdering(name="distance", scores=-np.round(distance, VALUE_DECIMALS), monotone=values, reported=-1.0)


@ordering_of.register
def _(program: MinimaxRegret, preferences: Preferences, table: EvidenceTable, feasible: Mask) -> Ordering:
    return _regret_orderings(program, preferences, table)(feasible)


def orderings_of(program: Program, preferences: Preferences, table: EvidenceTable) -> Callable[[Mask], Ordering]:
    """Function that orders alternatives under a program for a mask of the feasible ones.

    Computations that do not depend on the mask are made once.
    """
    if isinstance(program, MinimaxRegret):
        return _regret_orderings(program, preferences, table)
    return lambda feasible: ordering_of(program, preferences, table, feasible)


def _regret_orderings(
    program: MinimaxRegret, preferences: Preferences, table: EvidenceTable
) -> Callable[[Mask], Ordering]:
    from rgss.tradeoff.programs.weight_regret import WeightRegret
    from rgss.tradeoff.programs.weight_vertices import FEW_CANDIDATES, corner_candidates

    over_weights = program.scenarios is Scenarios.WEIGHTS
    monotone = _columns_of(preferences, table, tuple(preferences.weighting.weights)) if over_weights else None
    if monotone is not None and corner_candidates(preferences.weight_system()[0]) > FEW_CANDIDATES:
        regret = WeightRegret(monotone, *preferences.weight_system())
        worst_of: Callable[[Mask], Column] = regret.of_all
    else:
        scenarios = _scenario_values(program, preferences, table)
        worst_of = lambda feasible: _largest_regret(scenarios, feasible, len(table))  # noqa: E731

    def ordering(feasible: Mask) -> Ordering:
        scores = -np.round(worst_of(feasible), VALUE_DECIMALS)
        return ScoreOrdering(name="regret", scores=scores, monotone=monotone, reported=-1.0)

    return ordering


def _largest_regret(scenarios: Sequence[Column], feasible: Mask, count: int) -> Column:
    worst = np.full(count, -np.inf)
    for values in scenarios:
        best = values[feasible].max() if feasible.any() else np.nan
        worst = np.maximum(worst, best - values)
    return worst


def weighted_values(preferences: Preferences, table: EvidenceTable) -> Column:
    """The weighted value of every alternative, shape (n,); NaN where a weighted measure is unknown."""
    values = np.zeros(len(table))
    for measure in sorted(preferences.weighting.deciding_measures):
        weight = preferences.weighting.weights[measure]
        values = values + weight * preferences.value_function(measure).values_at(table.column(measure))
    return np.round(values, VALUE_DECIMALS)


def _value_columns(preferences: Preferences, table: EvidenceTable) -> Column:
    return _columns_of(preferences, table, preferences.weighting.deciding_measures)


def _columns_of(preferences: Preferences, table: EvidenceTable, measures: Sequence[str]) -> Column:
    columns = [preferences.value_function(measure).values_at(table.column(measure)) for measure in measures]
    return np.stack(columns, axis=1)


def _steps(aims: Sequence[Aim], table: EvidenceTable) -> tuple[Step, ...]:
    found = []
    for aim in aims:
        sign = 1.0 if aim.sense is Comparison.AT_LEAST else -1.0
        found.append(
            Step(
                name=aim.measure,
                column=sign * table.column(aim.measure),
                absolute=aim.absolute,
                relative=aim.relative,
                reported=sign,
            )
        )
    return tuple(found)


def _scenario_values(program: MinimaxRegret, preferences: Preferences, table: EvidenceTable) -> Sequence[Column]:
    weights: Mapping[str, float] = preferences.weighting.weights
    if program.scenarios is Scenarios.WEIGHTS:
        columns = _columns_of(preferences, table, tuple(weights))
        return [columns @ corner for corner in preferences.weight_corners()]
    deciding = preferences.weighting.deciding_measures
    found = []
    for replicate in range(preferences.replicate_count(deciding)):
        values = np.zeros(len(table))
        for measure in deciding:
            rows = table.replicates(measure).values
            column = rows[:, replicate if measure in table.samples else 0]
            values = values + weights[measure] * preferences.value_function(measure).values_at(column)
        found.append(values)
    return found
