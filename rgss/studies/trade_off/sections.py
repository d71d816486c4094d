"""How a study compares its designs: values, weights, program, risks, as its file says."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

from rgss.errors import TradeoffError
from rgss.tradeoff import (
    Comparison,
    CriterionNode,
    ElicitedInterval,
    ElicitedOrder,
    ExponentialValue,
    PiecewiseValue,
    PortfolioAim,
    Scenarios,
    TargetValue,
    ValueFunction,
    WeightBounds,
    Weighting,
    weighting_of,
)


@dataclass(frozen=True, slots=True, kw_only=True)
class RequirementAnchor:
    """A quantity that is a multiple of a requirement's threshold.

    Attributes:
        requirement: The requirement's id.
        times: The multiple.
    """

    requirement: str
    times: float


Anchor = float | RequirementAnchor
"""A quantity in the measure's unit, or one that a requirement gives."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ValuedMeasure:
    """The value function of a measure.

    Linear with worst and best alone; piecewise with points between; exponential with a half-way
    quantity; a target with what is too low and too high.

    Attributes:
        measure: The measure.
        worst: The quantity worth 0; None for a target.
        best: The quantity worth 1; None for a target.
        between: Points of a piecewise value: quantities and what they are worth.
        halfway: The quantity worth one half.
        target: The quantity worth 1 from which the value falls on both sides.
        too_low: The quantity below the target that is worth 0.
        too_high: The quantity above the target that is worth 0.
    """

    measure: str
    worst: Anchor | None = None
    best: Anchor | None = None
    between: tuple[tuple[Anchor, float], ...] = ()
    halfway: Anchor | None = None
    target: Anchor | None = None
    too_low: Anchor | None = None
    too_high: Anchor | None = None

    def function(self, quantity_of: Callable[[Anchor], float]) -> ValueFunction:
        """The value function.

        Args:
            quantity_of: Gives the quantity of an anchor in the measure's unit.

        Raises:
            TradeoffError: The anchors make no value function.
        """
        if self.target is not None and self.too_low is not None and self.too_high is not None:
            return TargetValue(
                measure=self.measure,
                target=quantity_of(self.target),
                too_low=quantity_of(self.too_low),
                too_high=quantity_of(self.too_high),
            )
        if self.worst is None or self.best is None:
            raise TradeoffError(
                f"{self.measure!r} has no value function", hint="say what is worst and best, or what is the target"
            )
        worst, best = quantity_of(self.worst), quantity_of(self.best)
        if self.halfway is not None:
            return ExponentialValue(measure=self.measure, worst=worst, best=best, halfway=quantity_of(self.halfway))
        interior = tuple((quantity_of(at), worth) for at, worth in self.between)
        return PiecewiseValue(measure=self.measure, worst=worst, best=best, interior=interior)


@dataclass(frozen=True, slots=True, kw_only=True)
class AimChoice:
    """A measure of which the best is wanted.

    Attributes:
        measure: The measure.
        more_is_better: Whether more of it is better.
        absolute: What may be given up, in the measure's unit.
        relative: What may be given up, as a share of the best.
    """

    measure: str
    more_is_better: bool
    absolute: float
    relative: float


@dataclass(frozen=True, slots=True, kw_only=True)
class BoundChoice:
    """A bound on a measure.

    Attributes:
        measure: The measure.
        comparison: At least or at most.
        value: The bound.
    """

    measure: str
    comparison: Comparison
    value: Anchor


@dataclass(frozen=True, slots=True, kw_only=True)
class ProgramChoice:
    """The program that decides.

    Attributes:
        name: Its name, such as ``lexicographic``.
        aims: The measures in order; of an epsilon-constraint program the one that is optimised.
        limits: The limits of an epsilon-constraint program.
        reference: The quantities that a Tchebycheff program aspires to, by measure.
        augmentation: The augmentation of a Tchebycheff program.
        scenarios: Over what a minimax-regret program takes the largest regret.
    """

    name: str = "additive"
    aims: tuple[AimChoice, ...] = ()
    limits: tuple[BoundChoice, ...] = ()
    reference: tuple[tuple[str, Anchor], ...] = ()
    augmentation: float = 1e-3
    scenarios: Scenarios = Scenarios.WEIGHTS


@dataclass(frozen=True, slots=True, kw_only=True)
class RiskChoice:
    """A demand on the replicates.

    Attributes:
        id: Its id, such as ``chance:SYS-005``.
        requirement: The requirement whose criterion it takes over; None if it has a bound of its own.
        bound: The bound; None if a requirement gives it.
        probability: The share of replicates that must meet the bound; None for a tail.
        worst_share: The share of replicates whose mean must meet the bound; None for a chance.
    """

    id: str
    requirement: str | None
    bound: BoundChoice | None
    probability: float | None
    worst_share: float | None


@dataclass(frozen=True, slots=True, kw_only=True)
class PortfolioChoice:
    """A portfolio that serves several studies.

    Attributes:
        at_most: The largest number of members.
        aim: What it is judged by.
        member: What counts as one member: a role of the catalogue (``component.gripper``) or a
            factor; None where every design does.
        studies: The studies with their weights.
    """

    at_most: int
    aim: PortfolioAim
    member: str | None
    studies: tuple[tuple[str, float], ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class TradeOff:
    """How a study compares its designs.

    Attributes:
        valued: The value function of each measure, in the order of the file.
        criteria: The hierarchy of criteria with their weights.
        intervals: Elicited bounds on weights.
        orders: Elicited orders of weights.
        program: The program that decides.
        risks: What is demanded of the replicates.
        practical_margin: Alternatives within it of the best are near-ties.
        choose_levels: Whether levels of factors are chosen instead of variants.
        fleet: The portfolio that is asked for; None if none is.
    """

    valued: tuple[ValuedMeasure, ...]
    criteria: tuple[CriterionNode, ...]
    intervals: tuple[ElicitedInterval, ...] = ()
    orders: tuple[ElicitedOrder, ...] = ()
    program: ProgramChoice = field(default_factory=ProgramChoice)
    risks: tuple[RiskChoice, ...] = ()
    practical_margin: float = 0.0
    choose_levels: bool = False
    fleet: PortfolioChoice | None = None

    @property
    def weighting(self) -> Weighting:
        """The weight of every measure."""
        return weighting_of(self.criteria)

    @property
    def weight_bounds(self) -> WeightBounds:
        """What is known of the weights beside their values."""
        return WeightBounds(intervals=self.intervals, orders=self.orders)
