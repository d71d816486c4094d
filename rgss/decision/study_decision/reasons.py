"""Reasons for a choice: its lead over the runner-up, and its closest limits."""

from __future__ import annotations

from dataclasses import dataclass

from rgss.tradeoff import Decision, Threshold, TradeProblem
from rgss.tradeoff.problem import tabulated
from rgss.tradeoff.programs import condition_column

CLOSEST_LIMITS = 2
"""Most limits that are named."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Gain:
    """Difference of a measure's contributions to the values of the chosen variant and of the runner-up.

    Attributes:
        measure: The measure.
        amount: The difference; above 0 if the chosen variant is ahead.
    """

    measure: str
    amount: float


@dataclass(frozen=True, slots=True, kw_only=True)
class ClosestLimit:
    """A limit that the chosen variant comes close to.

    Attributes:
        requirement: The requirement.
        demand: Its criterion as text, such as ``P_max >= 0.8 kg``.
        statistic: The statistic of the chosen variant that is compared with the limit.
        unit: The unit of both.
        margin: The distance to the required limit as a share of it; negative within the tolerance of the choice.
        is_tolerant: Whether the choice may miss the limit by a tolerance.
    """

    requirement: str
    demand: str
    statistic: float
    unit: str
    margin: float
    is_tolerant: bool


def gains_over_runner_up(decision: Decision) -> tuple[Gain, ...]:
    """The gains of the chosen variant over the runner-up, in the order of the weights.

    Returns:
        A gain for each weighted measure; none if nothing is chosen, there is no runner-up, or the program chooses by
        something else than the weighted value.
    """
    if decision.program != "additive" or decision.runner_up is None or not decision.runner_up_contributions:
        return ()
    pairs = zip(decision.chosen_contributions, decision.runner_up_contributions, strict=True)
    return tuple(Gain(measure=one.measure, amount=one.contribution - other.contribution) for one, other in pairs)


def closest_limits(problem: TradeProblem, chosen: int | None) -> tuple[ClosestLimit, ...]:
    """The limits that the chosen variant comes closest to, as a share of the limit, the closest first.

    Args:
        problem: The trade-off.
        chosen: Id of the chosen variant; None if nothing is chosen.
    """
    # A table of the chosen variant alone, since one of thousands takes long to compute.
    table = tabulated([one for one in problem.alternatives if one.variant == chosen])
    if chosen is None or not len(table):
        return ()
    found = []
    for condition in problem.conditions:
        statistic = float(condition_column(condition, table)[0])
        required = condition.required if isinstance(condition, Threshold) else None
        limit = condition.limit if required is None else required
        margin = condition.sense.margin(statistic, limit) / (abs(limit) or 1.0)
        found.append((margin, condition, statistic, required is not None))
    return tuple(
        ClosestLimit(
            requirement=condition.requirement,
            demand=condition.demand,
            statistic=statistic,
            unit=condition.limit_unit,
            # A limit that is met within the accuracy of the solver is met.
            margin=margin if is_tolerant else max(0.0, margin),
            is_tolerant=is_tolerant,
        )
        for margin, condition, statistic, is_tolerant in sorted(found, key=lambda one: one[0])[:CLOSEST_LIMITS]
    )
