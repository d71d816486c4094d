"""The augmented weighted Tchebycheff program, which reaches every undominated alternative."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, ClassVar

from rgss.errors import TradeoffError
from rgss.tradeoff.milp import Stage, StageSolution, StageSolver, WeightedValue, WorstOf
from rgss.tradeoff.programs.preferences import Program

if TYPE_CHECKING:
    from rgss.tradeoff.programs.preferences import Preferences


@dataclass(frozen=True, slots=True, kw_only=True)
class Tchebycheff(Program):
    """Augmented Tchebycheff program: least largest weighted shortfall from a reference point.

    ``min max_i w_i (z_i - v_i(x)) + ρ Σ_i (z_i - v_i(x))``, the augmented weighted Tchebycheff metric (Steuer and Choo,
    "An interactive weighted Tchebycheff procedure", 1983). With suitable weights it reaches every non-dominated
    alternative, including unsupported ones that no weighted sum selects; the augmentation excludes weakly non-dominated
    ones.

    Attributes:
        reference: The aspiration values z_i, by measure; 1 by default.
        augmentation: The factor ρ, positive.

    Raises:
        TradeoffError: A reference value or the augmentation is out of range.
    """

    name: ClassVar[str] = "tchebycheff"

    reference: Mapping[str, float] = field(default_factory=dict, hash=False)
    augmentation: float = 1e-3

    def __post_init__(self) -> None:
        for measure, value in self.reference.items():
            if not 0.0 <= value <= 1.0:
                raise TradeoffError(
                    f"reference value of {measure!r} must be from 0 to 1, got {value:g}",
                    hint="give a value, not a quantity",
                )
        if not 0.0 < self.augmentation <= 1.0:
            raise TradeoffError(
                f"augmentation must be above 0 and at most 1, got {self.augmentation:g}",
                hint="give a small number, such as 0.001",
            )

    def check(self, preferences: Preferences) -> None:
        """Reference values name measures that decide."""
        for measure in self.reference:
            if measure not in preferences.weighting.deciding_measures:
                raise TradeoffError(
                    f"the reference names {measure!r}, which has no weight",
                    hint=f"measures with a weight: {', '.join(preferences.weighting.deciding_measures)}",
                )

    def solve(self, preferences: Preferences, solver: StageSolver) -> tuple[StageSolution, ...]:
        """One stage."""
        weights = preferences.weighting.weights
        deciding = preferences.weighting.deciding_measures
        functions = {measure: preferences.value_function(measure) for measure in deciding}
        aspired = {measure: self.reference.get(measure, 1.0) for measure in deciding}
        shortfalls = WorstOf(
            scenarios=tuple(
                (
                    -weights[measure] * aspired[measure],
                    (WeightedValue(function=functions[measure], weight=weights[measure]),),
                )
                for measure in deciding
            )
        )
        augmentation = WorstOf(
            scenarios=(
                (
                    -self.augmentation * math.fsum(aspired.values()),
                    tuple(WeightedValue(function=functions[measure], weight=self.augmentation) for measure in deciding),
                ),
            )
        )
        return (solver.solve(Stage(name="distance", objective=(shortfalls, augmentation), sign=-1.0)),)
