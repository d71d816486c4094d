"""Every alternative evaluated in NumPy: the oracle against which the solver's answer is held."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rgss.tradeoff.problem import EVIDENCE_PREFIX, EvidenceTable, tabulated
from rgss.tradeoff.programs.columns import condition_column, keeps
from rgss.tradeoff.programs.orderings import Ordering
from rgss.tradeoff.programs.preferences import Preferences
from rgss.tradeoff.programs.problem import TradeProblem
from rgss.tradeoff.programs.program_orderings import ordering_of, weighted_values


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Enumeration:
    """All alternatives with their values and violations, by ascending id.

    Attributes:
        table: The alternatives.
        values: Weighted value without regard to any demand, shape (n,); NaN where a weighted
            measure is unknown. Rounded to 12 decimals, so that alternatives that are equal on
            paper are equal here, in whatever order their terms were added.
        requirements: Ids of the r demands.
        violated: True where an alternative violates a demand, shape (n, r).
        feasible: Mask of the alternatives that violate nothing, shape (n,).
        tied: Mask of the feasible alternatives that are tied best, shape (n,).
        ordering: Order of the alternatives under the program.
    """

    table: EvidenceTable
    values: NDArray[np.float64]
    requirements: tuple[str, ...]
    violated: NDArray[np.bool_]
    feasible: NDArray[np.bool_]
    tied: NDArray[np.bool_]
    ordering: Ordering

    @property
    def variants(self) -> NDArray[np.int64]:
        """Ids, shape (n,), ascending."""
        return self.table.variants

    @property
    def best_row(self) -> int | None:
        """Row of the best feasible alternative, with the smallest id of several; None if there is none."""
        tied = np.flatnonzero(self.tied)
        return int(tied[0]) if tied.size else None

    def value_of(self, variant: int) -> float | None:
        """The weighted value of one alternative; None where it is unknown."""
        value = float(self.values[self.table.row_of(variant)])
        return None if np.isnan(value) else value

    def violated_by(self, variant: int) -> tuple[str, ...]:
        """The demands that one alternative violates."""
        flags = self.violated[self.table.row_of(variant)]
        return tuple(requirement for requirement, flag in zip(self.requirements, flags, strict=True) if flag)


def enumerate_alternatives(problem: TradeProblem, *, excluded: Collection[int] = ()) -> Enumeration:
    """Evaluate every alternative of a trade-off.

    Args:
        problem: The trade-off.
        excluded: Ids of alternatives that must not be chosen, whatever they meet.

    Returns:
        Values, violations and order; the last demand is then not to be excluded.
    """
    table = tabulated(problem.alternatives)
    violated = violations(problem, table)
    requirements = problem.requirements
    if excluded:
        violated = np.column_stack([violated, np.isin(table.variants, list(excluded))])
        requirements = (*requirements, "excluded")
    feasible = np.asarray(~violated.any(axis=1), dtype=np.bool_)
    ordering = ordering_of(problem.program, problem, table, feasible)
    return Enumeration(
        table=table,
        values=weighted_values(problem, table),
        requirements=requirements,
        violated=violated,
        feasible=feasible,
        tied=ordering.best(feasible),
        ordering=ordering,
    )


def violations(preferences: Preferences, table: EvidenceTable) -> NDArray[np.bool_]:
    """Mask of the demands that each alternative violates, shape (n, r)."""
    requirements = preferences.requirements
    violated = np.zeros((len(table), len(requirements)), dtype=np.bool_)
    for condition in preferences.conditions:
        statistics = condition_column(condition, table)
        violated[:, requirements.index(condition.requirement)] |= ~keeps(condition.sense, statistics, condition.limit)
    for measure, unknown in zip(preferences.evidence_needs, unknown_evidence(preferences, table).T, strict=True):
        violated[:, requirements.index(EVIDENCE_PREFIX + measure)] |= unknown
    return violated


def unknown_evidence(preferences: Preferences, table: EvidenceTable) -> NDArray[np.bool_]:
    """Mask of the needed measures that are unknown of each alternative, shape (n, k), in the order of the needs."""
    needs = preferences.evidence_needs
    unknown = np.zeros((len(table), len(needs)), dtype=np.bool_)
    for place, (measure, every_replicate) in enumerate(needs.items()):
        unknown[:, place] = np.isnan(table.column(measure))
        if every_replicate:
            samples = table.replicates(measure)
            unknown[:, place] |= (samples.ran & np.isnan(samples.values)).any(axis=1)
    return unknown
