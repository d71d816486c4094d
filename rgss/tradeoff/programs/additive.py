"""Additive program: the highest weighted sum of values."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from rgss.tradeoff.milp import Stage, StageSolution, StageSolver, WeightedValue
from rgss.tradeoff.problem import Threshold
from rgss.tradeoff.programs.preferences import Preferences


@dataclass(frozen=True, slots=True, kw_only=True)
class AdditiveValue:
    """Maximise the weighted sum of the values: ``max Σ_i w_i v_i(x)``."""

    @property
    def name(self) -> str:
        """Its name."""
        return "additive"

    @property
    def limits(self) -> tuple[Threshold, ...]:
        """None."""
        return ()

    @property
    def aimed_measures(self) -> tuple[str, ...]:
        """None."""
        return ()

    def needs(self, preferences: Preferences) -> Mapping[str, bool]:
        """The measures that have a weight."""
        return dict.fromkeys(preferences.weighting.deciding_measures, False)

    def check(self, preferences: Preferences) -> None:
        """Nothing can be wrong beyond weights and values."""

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
