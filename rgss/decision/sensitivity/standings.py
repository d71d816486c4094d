"""Values and feasibility of the designs with one input of the decision changed, all else fixed."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rgss.decision.moved_thresholds import problem_with_thresholds
from rgss.decision.preference_model import quantity_of, value_function_of
from rgss.decision.robustness import Remeasuring, allowed_variants
from rgss.decision.what_if import ModelNumber
from rgss.errors import DefinitionError
from rgss.studies import Project
from rgss.tradeoff import AnchoredValue, TradeProblem
from rgss.tradeoff.problem import AnchoredBent, Array, EvidenceTable, Mask, bent_values
from rgss.tradeoff.programs import Preferences, single_values, violations, weighted_values
from rgss.tradeoff.robustness import Standing


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Standings:
    """Designs of a study under changed inputs; decided by weighted value.

    Attributes:
        project: The project with its study.
        problem: The trade-off.
        table: Its evidence.
        values: The single values in the measures with a weight above 0, shape (n, m).
        weights: Their weights, shape (m,).
        feasible: Mask of the designs that are feasible by their estimates, shape (n,).
        remeasuring: Evaluator of the evidence.
    """

    project: Project
    problem: TradeProblem
    table: EvidenceTable
    values: Array
    weights: Array
    feasible: Mask
    remeasuring: Remeasuring

    @property
    def measures(self) -> tuple[str, ...]:
        """The measures with a weight above 0."""
        return self.problem.weighting.deciding_measures

    def as_it_is(self) -> Standing:
        """The study as it is."""
        return self._valued(self.values)

    def with_weight(self, place: int) -> Callable[[float], Standing]:
        """Another weight of one measure, the others in proportion."""
        others = self.weights.copy()
        others[place] = 0.0
        rest = float(others.sum())
        # If one measure has all weight, there are no proportions to keep: the others get equal shares.
        shares = others / rest if rest > 0.0 else (np.arange(len(others)) != place) / max(1, len(others) - 1)

        def standing(weight: float) -> Standing:
            weights = shares * (1.0 - weight)
            weights[place] = weight
            return Standing(totals=self.values @ weights, feasible=self.feasible)

        return standing

    def with_anchor(self, valued: AnchoredValue, key: str) -> Callable[[float], Standing]:
        """Another end of one value function."""
        place = self.measures.index(valued.measure)
        column = self.table.column(valued.measure)

        def standing(quantity: float) -> Standing:
            function = value_function_of(self.project, valued.with_anchor(key, quantity))
            return self._with_column(place, function.values_at(column))

        return standing

    def curvature_of(self, place: int) -> float:
        """Curvature by which a supposition has bent the value function of a measure; 0 if none has."""
        valued = self._anchored(place)
        return valued.curvature if isinstance(valued, AnchoredBent) else 0.0

    def with_curvature(self, places: tuple[int, ...]) -> Callable[[float], Standing]:
        """Some value functions bent by a curvature, which replaces one that they have."""
        straight = np.column_stack([self._straight_values(place) for place in places])

        def standing(curvature: float) -> Standing:
            values = self.values.copy()
            values[:, places] = bent_values(straight, curvature)
            return self._valued(values)

        return standing

    def with_threshold(self, requirement: str) -> Callable[[float], Standing]:
        """Another threshold of one requirement, as it is required; the tolerance and what is anchored on it follow."""

        def standing(threshold: float) -> Standing:
            moved = problem_with_thresholds(self.project, self.problem, self.table, {requirement: threshold})
            return _decided(moved, self.table)

        return standing

    def with_number(self, number: ModelNumber) -> Callable[[float], Standing]:
        """Another value of an assumed number; results of trials are held fixed."""
        allowed = allowed_variants(self.project, self.remeasuring.measured, number)

        def standing(value: float) -> Standing:
            mask: NDArray[np.bool_] = allowed(value)
            try:
                table = self.remeasuring.table_with(number, value)
            except DefinitionError:
                # If a measure is undefined there, nothing can be chosen.
                return Standing(totals=np.full(len(self.table), np.nan), feasible=mask & False)
            found = _decided(self.problem, table)
            return Standing(totals=found.totals, feasible=found.feasible & mask)

        return standing

    def _anchored(self, place: int) -> AnchoredValue:
        measure = self.measures[place]
        return next(one for one in self.project.study.trade_off.valued if one.measure == measure)

    def _straight_values(self, place: int) -> Array:
        """The values in a measure before a supposition bends its value function."""
        valued = self._anchored(place)
        if not isinstance(valued, AnchoredBent):
            return self.values[:, place]
        return value_function_of(self.project, valued.straight).values_at(self.table.column(valued.measure))

    def _with_column(self, place: int, column: Array) -> Standing:
        values = self.values.copy()
        values[:, place] = column
        return self._valued(values)

    def _valued(self, values: Array) -> Standing:
        return Standing(totals=values @ self.weights, feasible=self.feasible)


def standings_of(remeasuring: Remeasuring, problem: TradeProblem) -> Standings:
    """Standings of the designs of a study.

    Args:
        remeasuring: The evidence, which can be evaluated again.
        problem: The trade-off, decided by weighted value.
    """
    table = remeasuring.table
    return Standings(
        project=remeasuring.project,
        problem=problem,
        table=table,
        values=single_values(problem, table),
        weights=np.array([problem.weighting.weights[name] for name in problem.weighting.deciding_measures]),
        feasible=_feasible(problem, table),
        remeasuring=remeasuring,
    )


def anchored_on_requirements(project: Project) -> bool:
    """True if an end of a value function is anchored on a requirement."""
    trade_off = project.study.trade_off
    return any(not isinstance(anchor, float) for valued in trade_off.valued for anchor in valued.anchors.values())


def anchor_quantity(project: Project, valued: AnchoredValue, key: str) -> float:
    """The quantity of an end of a value function, in the measure's unit."""
    return quantity_of(project, valued.anchors[key], valued.measure)


def _decided(preferences: Preferences, table: EvidenceTable) -> Standing:
    return Standing(totals=weighted_values(preferences, table), feasible=_feasible(preferences, table))


def _feasible(preferences: Preferences, table: EvidenceTable) -> Mask:
    return np.asarray(~violations(preferences, table).any(axis=1), dtype=np.bool_)
