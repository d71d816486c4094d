"""Additive program: the highest weighted sum of values."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from rgss.tradeoff.milp import Stage, StageSolution, StageSolver, WeightedValue
from rgss.tradeoff.problem import Threshold
from rgss.tradeoff.programs.preferences import Preferences, Program


@dataclass(frozen=True, slots=True, kw_only=True)
class AdditiveValue(Program):
    """Maximise the weighted sum of the values: ``max Σ_i w_i v_i(x)``."""

    name: ClassVar[str] = "additive"

    def solve(self, preferences: Preferences, solver: StageSolver) -> tuple[StageSolution, ...]:
        """One stage."""
        return (solver.solve(additive_stage(preferences)),)


def additive_stage(preferences: Preferences, *constraints: Threshold) -> Stage:
    """The stage that finds the highest weighted value."""
    weights = preferences.weighting.weights
    return Stage(
        name="value",
        objective=tuple(
            WeightedValue(function=preferences.value_function(measure), weight=weights[measure])
            for measure in preferences.weighting.deciding_measures
        ),
        constraints=constraints,
    )
