"""Which alternatives each program prefers, by enumeration in NumPy: the oracle of the solver's answers.

It shares the data and the corners of the weights with the programs, but neither their terms nor
their stages: values are interpolated column by column, statistics are sorted, orders are masks.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import singledispatch

import numpy as np

from rgss.errors import TradeoffError
from rgss.tradeoff.columns import value_column
from rgss.tradeoff.conditions import Comparison
from rgss.tradeoff.evidence_table import EvidenceTable
from rgss.tradeoff.lexicographic import Aim, EpsilonConstraint, Lexicographic
from rgss.tradeoff.minimax_regret import MinimaxRegret, Scenarios
from rgss.tradeoff.orderings import Column, Mask, Ordering, ScoreOrdering, SequenceOrdering, Step
from rgss.tradeoff.preferences import Preferences
from rgss.tradeoff.program import AdditiveValue, Program
from rgss.tradeoff.tchebycheff import Tchebycheff

VALUE_DECIMALS = 12
"""Values are rounded to it, so that what is equal on paper is equal whatever the order of summation."""


@singledispatch
def ordering_of(program: Program, preferences: Preferences, table: EvidenceTable, feasible: Mask) -> Ordering:  # noqa: ARG001 - read by the programs' own
    """How alternatives compare under a program.

    Args:
        program: The program.
        preferences: What is wanted.
        table: The alternatives.
        feasible: Which of them meet every demand, shape (n,).

    Raises:
        TradeoffError: There is no enumeration for the program.
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
    worst = np.full(len(table), -np.inf)
    for values in _scenario_values(program, preferences, table):
        best = values[feasible].max() if feasible.any() else np.nan
        worst = np.maximum(worst, best - values)
    monotone = None
    if program.scenarios is Scenarios.WEIGHTS:
        monotone = np.stack(
            [value_column(preferences.value_function(m), table.column(m)) for m in preferences.weighting.weights],
            axis=1,
        )
    return ScoreOrdering(name="regret", scores=-np.round(worst, VALUE_DECIMALS), monotone=monotone, reported=-1.0)


def weighted_values(preferences: Preferences, table: EvidenceTable) -> Column:
    """The weighted value of every alternative, shape (n,); NaN where a weighted measure is unknown."""
    values = np.zeros(len(table))
    for measure in sorted(preferences.weighting.deciding_measures):
        weight = preferences.weighting.weights[measure]
        values = values + weight * value_column(preferences.value_function(measure), table.column(measure))
    return np.round(values, VALUE_DECIMALS)


def _value_columns(preferences: Preferences, table: EvidenceTable) -> Column:
    return np.stack(
        [
            value_column(preferences.value_function(measure), table.column(measure))
            for measure in preferences.weighting.deciding_measures
        ],
        axis=1,
    )


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
        columns = np.stack(
            [value_column(preferences.value_function(measure), table.column(measure)) for measure in weights], axis=1
        )
        return [columns @ corner for corner in preferences.weight_corners()]
    deciding = preferences.weighting.deciding_measures
    found = []
    for replicate in range(preferences.replicate_count(deciding)):
        values = np.zeros(len(table))
        for measure in deciding:
            rows = table.replicates(measure).values
            column = rows[:, replicate if measure in table.samples else 0]
            values = values + weights[measure] * value_column(preferences.value_function(measure), column)
        found.append(values)
    return found
