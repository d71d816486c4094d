"""What a program is, by which a trade-off is decided; and the plainest, the weighted sum of values."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

from rgss.tradeoff.milp import ConditionConstraint, Stage, StageSolution, StageSolver, WeightedValue
from rgss.tradeoff.problem import Threshold

if TYPE_CHECKING:
    from rgss.tradeoff.programs.preferences import Preferences


class Program(Protocol):
    """A way to decide."""

    @property
    def name(self) -> str:
        """Its name."""
        ...

    @property
    def limits(self) -> tuple[Threshold, ...]:
        """Thresholds that it sets beside those of the requirements."""
        ...

    def needs(self, preferences: Preferences) -> Mapping[str, bool]:
        """The measures that must be known, and whether in every replicate, too."""
        ...

    def check(self, preferences: Preferences) -> None:
        """Make sure that it can decide a trade-off.

        Raises:
            TradeoffError: It cannot.
        """
        ...

    def solve(self, preferences: Preferences, solver: StageSolver) -> tuple[StageSolution, ...]:
        """Solve its stages, each standing on the answers of those before; ends where one is infeasible."""
        ...


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

    def needs(self, preferences: Preferences) -> Mapping[str, bool]:
        """The measures that have a weight."""
        return dict.fromkeys(preferences.weighting.deciding_measures, False)

    def check(self, preferences: Preferences) -> None:
        """Nothing can be wrong beyond weights and values."""

    def solve(self, preferences: Preferences, solver: StageSolver) -> tuple[StageSolution, ...]:
        """One stage."""
        return (solver.solve(additive_stage(preferences)),)


def additive_stage(preferences: Preferences, *constraints: ConditionConstraint) -> Stage:
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
