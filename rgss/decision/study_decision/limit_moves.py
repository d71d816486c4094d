"""Nearest changes of the choice on either side of each limit."""

from __future__ import annotations

from dataclasses import dataclass

from rgss.decision.robustness import RequirementPrice, Robustness
from rgss.tradeoff.problem import Comparison, Threshold
from rgss.tradeoff.robustness import changes_of_best, step_at


@dataclass(frozen=True, slots=True, kw_only=True)
class LimitMove:
    """Choice beyond a moved limit.

    Attributes:
        limit: The limit at which the choice changes: when loosened, at that limit; when tightened, beyond it.
        winners: The variants that are then best; empty if none is feasible.
        value: Their weighted value; None if none is feasible.
    """

    limit: float
    winners: tuple[int, ...]
    value: float | None


@dataclass(frozen=True, slots=True, kw_only=True)
class LimitMoves:
    """Moves of one limit that change the choice.

    Attributes:
        requirement: The requirement.
        demand: Its criterion as text, such as ``P_max >= 0.8 kg``.
        unit: The unit of the limit.
        at_least: True if the limit is a lower bound.
        looser: The nearest change when it is loosened; None if there is none.
        tighter: The nearest change when it is tightened; None if there is none.
        is_tolerated: Whether the limits contain the tolerance of the choice, so that the requirement's differs.
        anchored: Measures whose value functions are anchored on the requirement, and do not move with the limit.
    """

    requirement: str
    demand: str
    unit: str
    at_least: bool
    looser: LimitMove | None
    tighter: LimitMove | None
    anchored: tuple[str, ...]
    is_tolerated: bool = False


def limit_moves(found: Robustness, *, chosen: int | None) -> tuple[LimitMoves, ...]:
    """The moves of each limit.

    Args:
        found: The robustness of the decision, with the prices of the requirements.
        chosen: The choice, which is not changed by a move after which it is still one of the best; None without one.
    """
    row = None if chosen is None else found.variants.index(chosen)
    return tuple(_moves(found, price, row) for price in found.prices)


def _moves(found: Robustness, price: RequirementPrice, chosen: int | None) -> LimitMoves:
    condition = price.condition
    at_least = condition.sense is Comparison.AT_LEAST
    steps = changes_of_best(price.steps)
    # A quantity that equals the limit up to one part in 10⁹ meets it.
    slack = 1e-9 * max(1.0, abs(condition.limit))
    here = step_at(steps, condition.limit - slack if at_least else condition.limit + slack, at_least=at_least)
    place = steps.index(here)

    def move(limit: float, other: int) -> LimitMove:
        step = steps[other]
        return LimitMove(limit=limit, winners=tuple(found.variants[row] for row in step.best), value=step.value)

    looser = next((at for at in range(place - 1, -1, -1) if chosen not in steps[at].best), None)
    tighter = next((at for at in range(place + 1, len(steps)) if chosen not in steps[at].best), None)

    return LimitMoves(
        requirement=condition.requirement,
        demand=condition.demand,
        unit=condition.limit_unit,
        at_least=at_least,
        looser=None if looser is None else move(steps[looser].tightest, looser),
        tighter=None if tighter is None else move(steps[tighter - 1].tightest, tighter),
        anchored=price.anchored,
        is_tolerated=isinstance(condition, Threshold) and condition.required is not None,
    )
