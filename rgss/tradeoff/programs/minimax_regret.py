"""The minimax-regret program, over elicited weights or over the replicates."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from enum import Enum
from typing import TYPE_CHECKING, ClassVar

from rgss.errors import TradeoffError
from rgss.tradeoff.milp import Exclusion, Stage, StageSolution, StageSolver, WeightedValue, WorstOf
from rgss.tradeoff.problem import Alternative
from rgss.tradeoff.programs.preferences import Program

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from rgss.tradeoff.programs.preferences import Preferences
    from rgss.tradeoff.programs.worst_weights import WeightProgram

Scenario = tuple[float, tuple[WeightedValue, ...]]

REGRET_TOLERANCE = 1e-10
"""A choice whose regret exceeds the proven least by no more is the best; ties are ten times as far apart."""

MOST_GENERATED = 500
"""So many weights are generated before it is given up."""

MOST_RIVALS = 100_000
"""Up to so many combinations of levels are listed as rivals, against which worst weights are found by programs."""

FEWEST_SCENARIOS = 2
"""Of a single replicate there is nothing to regret: the best of it would be chosen, noise and all."""


class Scenarios(str, Enum):
    """Scenarios of the greatest regret: elicited weights, or the replicates."""

    WEIGHTS = "weights"
    REPLICATES = "replicates"


@dataclass(frozen=True, slots=True, kw_only=True)
class MinimaxRegret(Program):
    """The alternative whose largest regret over all scenarios is smallest.

    The regret in a scenario is how much more value the best feasible alternative has there (Savage,
    "The theory of statistical decision", 1951). Over weights, the scenarios are the corners of the set
    of weights that agree with the elicited bounds: regret is convex in the weights, so its largest
    value over the whole set is at a corner. Where the corners may be many, only the binding ones are
    generated: the worst weights of a candidate against one rival are a linear program (constraint
    generation; Kouvelis and Yu, "Robust discrete optimization and its applications", 1997). Of levels
    that is done up to `MOST_RIVALS` combinations; beyond, all corners are needed. Over
    replicates, scenario r is the r-th seed, and every replicate must have every weighted measure.
    """

    name: ClassVar[str] = "minimax_regret"

    scenarios: Scenarios = Scenarios.WEIGHTS

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
        rivals = self._rivals(preferences, solver)
        if rivals is not None:
            return self._generated(preferences, solver, rivals)
        solutions = []
        scenarios: list[Scenario] = []
        for name, terms in self.scenario_terms(preferences):
            solution = solver.solve(Stage(name=f"best value, {name}", objective=terms))
            solutions.append(solution)
            if solution.alternative is None:
                return (solution,)
            scenarios.append(_scenario(terms, solution.alternative))
        return (*solutions, solver.solve(_regret_stage(scenarios)))

    def _rivals(self, preferences: Preferences, solver: StageSolver) -> Sequence[Alternative] | None:
        """The alternatives that can be chosen, where the corners of the weights may be many; None elsewhere."""
        from rgss.tradeoff.programs.weight_vertices import FEW_CANDIDATES, corner_candidates

        if self.scenarios is not Scenarios.WEIGHTS:
            return None
        if corner_candidates(preferences.weight_system()[0]) <= FEW_CANDIDATES:
            return None
        feasible = preferences.feasible_alternatives(at_most=MOST_RIVALS)
        if feasible is None:
            return None
        excluded = {one.alternative.variant for one in solver.constraints if isinstance(one, Exclusion)}
        return [one for one in feasible if one.variant not in excluded]

    def _generated(
        self, preferences: Preferences, solver: StageSolver, rivals: Sequence[Alternative]
    ) -> tuple[StageSolution, ...]:
        """Scenario generation: each is the worst case of the last choice, until its regret equals the bound.

        The regret over some weights is at most that over all, so the choice is optimal when its regret over all is not
        greater. The number of worst-case weights is finite.
        """
        from rgss.tradeoff.programs.worst_weights import WeightProgram

        program = WeightProgram(*preferences.weight_system())
        solutions: list[StageSolution] = []
        scenarios: list[Scenario] = []
        weights = tuple(preferences.weighting.weights.values())
        while True:
            terms = _terms(preferences, weights)
            stage = Stage(name=f"best value, weights {len(scenarios) + 1}", objective=terms)
            solution = solver.solve(stage)
            if solution.alternative is None:
                return (solution,)
            solutions.append(solution)
            scenarios.append(_scenario(terms, solution.alternative))
            answer = solver.solve(_regret_stage(scenarios))
            if answer.alternative is None or answer.objective is None:
                return (*solutions, answer)
            regret, weights = _worst(preferences, program, answer.alternative, rivals)
            if regret <= answer.objective + REGRET_TOLERANCE:
                return (*solutions, answer)
            if len(scenarios) == MOST_GENERATED:
                raise TradeoffError(
                    f"minimax regret is not proven after {MOST_GENERATED} weights: the best choice so far is variant "
                    f"{answer.alternative.variant} with a regret of {regret:.6g}, and none is below "
                    f"{answer.objective:.6g}",
                    hint="narrow the bounds of the weights, or decide between fewer variants",
                )

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
            (f"weights {place + 1}", _terms(preferences, corner.tolist()))
            for place, corner in enumerate(preferences.weight_corners())
        ]


def _terms(preferences: Preferences, weights: Sequence[float]) -> tuple[WeightedValue, ...]:
    """The weighted value at some weights, in the measures' order."""
    return tuple(
        WeightedValue(function=preferences.value_function(measure), weight=weight)
        for measure, weight in zip(preferences.weighting.weights, weights, strict=True)
        if weight > 0.0
    )


def _scenario(terms: tuple[WeightedValue, ...], best: Alternative) -> Scenario:
    # Evaluated at the selected alternative, for the solver's own number is only so exact.
    return -math.fsum(term.at(best) for term in terms), terms


def _regret_stage(scenarios: Sequence[Scenario]) -> Stage:
    return Stage(name="regret", objective=(WorstOf(scenarios=tuple(scenarios)),), sign=-1.0)


def _worst(
    preferences: Preferences, program: WeightProgram, choice: Alternative, rivals: Sequence[Alternative]
) -> tuple[float, tuple[float, ...]]:
    """The largest regret of a choice over all weights, by a program for each rival, and the weights there."""
    import numpy as np

    functions = [preferences.value_function(measure) for measure in preferences.weighting.weights]

    def values(alternative: Alternative) -> NDArray[np.float64]:
        quantities = [alternative.measures[function.measure] for function in functions]
        return np.array(
            [
                0.0 if quantity is None else function.value_at(quantity)
                for function, quantity in zip(functions, quantities, strict=True)
            ]
        )

    mine = values(choice)
    # Of rivals alike in every value one is enough.
    leads = [np.array(one) for one in dict.fromkeys(tuple((values(rival) - mine).tolist()) for rival in rivals)]
    best: tuple[float, tuple[float, ...]] = (-math.inf, ())
    # No lead exceeds its largest difference, so that rivals with small ones need no program.
    for lead in sorted(leads, key=lambda one: -float(one.max())):
        if float(lead.max()) <= best[0]:
            break
        optimum = program.maximise(lead)
        if optimum.value > best[0]:
            best = (optimum.value, tuple(optimum.weights.tolist()))
    return best
