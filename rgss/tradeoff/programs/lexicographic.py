"""Programs that optimise one measure after another: lexicographic, and epsilon-constraint."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

from rgss.errors import TradeoffError
from rgss.tradeoff.milp import QuantityRank, Stage, StageSolution, StageSolver
from rgss.tradeoff.problem import LIMIT_PREFIX, Comparison, Threshold
from rgss.tradeoff.programs.additive import additive_stage
from rgss.tradeoff.programs.preferences import Program

if TYPE_CHECKING:
    from rgss.tradeoff.programs.preferences import Preferences


@dataclass(frozen=True, slots=True, kw_only=True)
class Aim:
    """Measure that is optimised, and how much of it may be given up.

    Attributes:
        measure: The measure.
        sense: At least if more of it is better, at most if less is.
        absolute: Tolerance, in the measure's unit.
        relative: Tolerance, as a share of the best quantity.

    Raises:
        TradeoffError: The tolerances contradict each other or are out of range.
    """

    measure: str
    sense: Comparison
    absolute: float = 0.0
    relative: float = 0.0

    def __post_init__(self) -> None:
        for kind, tolerance in (("absolute", self.absolute), ("relative", self.relative)):
            if not (math.isfinite(tolerance) and tolerance >= 0.0):
                raise TradeoffError(
                    f"{kind} tolerance of {self.measure!r} must be at least 0, got {tolerance:g}",
                    hint="give 0 for no tolerance",
                )
        if self.absolute and self.relative:
            raise TradeoffError(
                f"{self.measure!r} has two tolerances that contradict each other: {self.absolute:g} and "
                f"{100.0 * self.relative:g} %",
                hint="give an absolute or a relative tolerance",
            )
        if self.relative >= 1.0:
            raise TradeoffError(
                f"relative tolerance of {self.measure!r} must be below 100 %, got {100.0 * self.relative:g} %",
                hint="leave the measure out: such a tolerance bounds nothing",
            )

    def bound(self, best: float) -> float:
        """The quantity that is still good enough where the best one is known."""
        given_up = self.absolute + self.relative * abs(best)
        return best - given_up if self.sense is Comparison.AT_LEAST else best + given_up

    def kept(self, best: float) -> Threshold:
        """Constraint that keeps this criterion within its tolerance."""
        return Threshold(
            requirement=f"stage {self.measure}",
            measure=self.measure,
            comparison=self.sense,
            value=self.bound(best),
            unit="1",
        )

    def stage(self, constraints: tuple[Threshold, ...]) -> Stage:
        """The stage that finds its best quantity."""
        return Stage(
            name=self.measure,
            objective=(QuantityRank(measure=self.measure, sense=self.sense),),
            constraints=constraints,
            scale=1.0,
            quantity=self.measure,
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class Lexicographic(Program):
    """Lexicographic program: optimum of each measure in turn, within the tolerances of the previous ones.

    Attributes:
        aims: The measures, the most important first. The tolerance of the last one only defines near-ties.

    Raises:
        TradeoffError: The measures are empty, or one is a duplicate.
    """

    name: ClassVar[str] = "lexicographic"

    aims: tuple[Aim, ...]

    def __post_init__(self) -> None:
        if not self.aims:
            raise TradeoffError("a lexicographic program has no measures", hint="name at least one, in order")
        measures = [aim.measure for aim in self.aims]
        for measure in measures:
            if measures.count(measure) > 1:
                raise TradeoffError(
                    f"{measure!r} occurs twice in a lexicographic program", hint="keep the more important place"
                )

    @property
    def aimed_measures(self) -> tuple[str, ...]:
        """The measures of its aims."""
        return tuple(aim.measure for aim in self.aims)

    def needs(self, preferences: Preferences) -> Mapping[str, bool]:  # noqa: ARG002 - part of the protocol
        """The measures of its aims."""
        return dict.fromkeys(self.aimed_measures, False)

    def solve(self, preferences: Preferences, solver: StageSolver) -> tuple[StageSolution, ...]:  # noqa: ARG002
        """One stage for each aim."""
        return solve_in_order(self.aims, solver)


@dataclass(frozen=True, slots=True, kw_only=True)
class EpsilonConstraint(Program):
    """Epsilon-constraint program: optimum of one measure under limits on others; of equals the highest weighted value.

    Attributes:
        aim: The optimised measure. Alternatives within its tolerance are listed as near-ties.
        bounds: The limits, as thresholds whose requirements begin with ``limit:``.

    Raises:
        TradeoffError: The limits are empty, or one has another id.
    """

    name: ClassVar[str] = "epsilon_constraint"

    aim: Aim
    bounds: tuple[Threshold, ...]

    def __post_init__(self) -> None:
        if not self.bounds:
            raise TradeoffError(
                "an epsilon-constraint program has no limits",
                hint="bound at least one measure, or name another program",
            )
        for bound in self.bounds:
            if not bound.requirement.startswith(LIMIT_PREFIX):
                raise TradeoffError(
                    f"the limit {bound.requirement!r} has no id of a limit", hint=f"begin it with {LIMIT_PREFIX!r}"
                )

    @property
    def limits(self) -> tuple[Threshold, ...]:
        """The limits on the other measures."""
        return self.bounds

    @property
    def aimed_measures(self) -> tuple[str, ...]:
        """The measure that is optimised."""
        return (self.aim.measure,)

    def needs(self, preferences: Preferences) -> Mapping[str, bool]:
        """The measure that is optimised, and those that have a weight, which break ties."""
        return dict.fromkeys((self.aim.measure, *preferences.weighting.deciding_measures), False)

    def solve(self, preferences: Preferences, solver: StageSolver) -> tuple[StageSolution, ...]:
        """A stage for the measure, and one for the weighted value among equals."""
        first = solver.solve(self.aim.stage(()))
        if first.alternative is None:
            return (first,)
        best = quantity_of(first, self.aim)
        exactly = Aim(measure=self.aim.measure, sense=self.aim.sense).kept(best)
        return first, solver.solve(additive_stage(preferences, exactly))


def solve_in_order(aims: tuple[Aim, ...], solver: StageSolver) -> tuple[StageSolution, ...]:
    """Solve a stage for each aim, with the previous optima as constraints within their tolerances."""
    solutions: list[StageSolution] = []
    kept: list[Threshold] = []
    for aim in aims:
        solution = solver.solve(aim.stage(tuple(kept)))
        solutions.append(solution)
        if solution.alternative is None:
            break
        kept.append(aim.kept(quantity_of(solution, aim)))
    return tuple(solutions)


def quantity_of(solution: StageSolution, aim: Aim) -> float:
    """The quantity of an aim's measure that a stage reached; the constraints see to it that it is known."""
    quantity = solution.chosen.measures[aim.measure]
    if quantity is None:
        raise TradeoffError(
            f"the solver's answer is unknown in {aim.measure!r}", hint="the answer is not used; report this problem"
        )
    return quantity
