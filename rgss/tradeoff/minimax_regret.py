"""The minimax-regret program, over elicited weights or over the replicates."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from enum import Enum
from typing import TYPE_CHECKING

from rgss.errors import TradeoffError
from rgss.tradeoff.conditions import Threshold
from rgss.tradeoff.stage import Stage, StageSolution, StageSolver
from rgss.tradeoff.terms import WeightedValue, WorstOf

if TYPE_CHECKING:
    from rgss.tradeoff.preferences import Preferences


FEWEST_SCENARIOS = 2
"""Of a single replicate there is nothing to regret: the best of it would be chosen, noise and all."""


class Scenarios(str, Enum):
    """Over what the largest regret is taken: elicited weights, or the replicates."""

    WEIGHTS = "weights"
    REPLICATES = "replicates"


@dataclass(frozen=True, slots=True, kw_only=True)
class MinimaxRegret:
    """The alternative whose largest regret over all scenarios is smallest.

    The regret in a scenario is how much more value the best feasible alternative has there (Savage,
    "The theory of statistical decision", 1951). Over weights, the scenarios are the corners of the set
    of weights that agree with the elicited bounds: regret is convex in the weights, so its largest
    value over the whole set is at a corner. Over replicates, scenario r is the r-th seed, and every
    replicate has to tell every weighted measure.

    Attributes:
        scenarios: Over what.
    """

    scenarios: Scenarios = Scenarios.WEIGHTS

    @property
    def name(self) -> str:
        """Its name."""
        return "minimax_regret"

    @property
    def limits(self) -> tuple[Threshold, ...]:
        """None."""
        return ()

    def needs(self, preferences: Preferences) -> Mapping[str, bool]:
        """All valued measures over weights; over replicates, those that have a weight."""
        if self.scenarios is Scenarios.WEIGHTS:
            return dict.fromkeys(preferences.weighting.weights, False)
        return dict.fromkeys(preferences.weighting.deciding_measures, True)

    def check(self, preferences: Preferences) -> None:
        """Over replicates, there must be two at least, and as many of each alternative."""
        if self.scenarios is not Scenarios.REPLICATES:
            return
        if preferences.replicate_count(preferences.weighting.deciding_measures) < FEWEST_SCENARIOS:
            raise TradeoffError(
                "regret over replicates needs 2 replicates of each variant, and there is 1",
                hint="run more replicates, or take the regret over weights",
            )

    def solve(self, preferences: Preferences, solver: StageSolver) -> tuple[StageSolution, ...]:
        """The best value in each scenario, and then the least of the largest regrets."""
        solutions = []
        scenarios: list[tuple[float, tuple[WeightedValue, ...]]] = []
        for name, terms in self.scenario_terms(preferences):
            solution = solver.solve(Stage(name=f"best value, {name}", objective=terms))
            solutions.append(solution)
            if solution.alternative is None:
                return (solution,)
            # Evaluated at the selected alternative, for the solver's own number is only so exact.
            best = math.fsum(term.at(solution.alternative) for term in terms)
            scenarios.append((-best, terms))
        regret = Stage(name="regret", objective=(WorstOf(scenarios=tuple(scenarios)),), sign=-1.0)
        return (*solutions, solver.solve(regret))

    def scenario_terms(self, preferences: Preferences) -> list[tuple[str, tuple[WeightedValue, ...]]]:
        """The value in each scenario, as terms."""
        weights = preferences.weighting.weights
        if self.scenarios is Scenarios.REPLICATES:
            deciding = preferences.weighting.deciding_measures
            return [
                (
                    f"replicate {replicate + 1}",
                    tuple(
                        WeightedValue(
                            function=preferences.value_function(measure), weight=weights[measure], replicate=replicate
                        )
                        for measure in deciding
                    ),
                )
                for replicate in range(preferences.replicate_count(deciding))
            ]
        return [
            (
                f"weights {place + 1}",
                tuple(
                    WeightedValue(function=preferences.value_function(measure), weight=float(weight))
                    for measure, weight in zip(weights, corner, strict=True)
                    if weight > 0.0
                ),
            )
            for place, corner in enumerate(preferences.weight_corners())
        ]
