"""Smallest set of answers that no positive weights satisfy together."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from rgss.tradeoff.elicitation.answers import PairwiseAnswer

_ROUNDING = 1e-9


@dataclass(frozen=True, slots=True, kw_only=True)
class Contradiction:
    """Answers around a circle whose product exceeds 1: each would make a criterion heavier than itself.

    Without any one of them the others can hold together.

    Attributes:
        places: The places of the answers in the list that was given, ascending.
        answers: The answers.
        factor: The product around the circle, above 1: loosening one bound by so much mends it.
    """

    places: tuple[int, ...]
    answers: tuple[PairwiseAnswer, ...]
    factor: float

    @property
    def words(self) -> str:
        """The answers in a phrase."""
        return ", ".join(answer.words for answer in self.answers)


def contradiction_of(names: Sequence[str], answers: Sequence[PairwiseAnswer]) -> Contradiction | None:
    """The fewest answers that contradict each other; None if positive weights satisfy all.

    In the logarithms of weights each bound is a difference constraint, and these have a solution if and only
    if no circle of them has a positive sum (Bellman, "On a routing problem", 1958). A circle of the fewest
    bounds passes no criterion twice, so it is minimal: without one of its bounds the rest is a path.

    Args:
        names: The criteria.
        answers: The answers; each must hold.
    """
    place_of = {name: place for place, name in enumerate(names)}
    bounds: list[tuple[int, int, float, int]] = []
    for place, answer in enumerate(answers):
        one, other = place_of[answer.swing_of], place_of[answer.over]
        bounds.append((other, one, math.log(answer.least), place))
        if math.isfinite(answer.most):
            bounds.append((one, other, -math.log(answer.most), place))
    found = min(
        (circle for start in range(len(names)) if (circle := _shortest_circle(start, len(names), bounds))),
        key=lambda circle: (len(circle), circle),
        default=None,
    )
    if found is None:
        return None
    places = tuple(sorted({bounds[one][3] for one in found}))
    return Contradiction(
        places=places,
        answers=tuple(answers[place] for place in places),
        factor=math.exp(math.fsum(bounds[one][2] for one in found)),
    )


def _shortest_circle(start: int, size: int, bounds: Sequence[tuple[int, int, float, int]]) -> tuple[int, ...] | None:
    """The fewest bounds that lead from a criterion back to it with a positive sum; None if none do."""
    reached: dict[int, tuple[float, tuple[int, ...]]] = {start: (0.0, ())}
    for _ in range(size):
        further: dict[int, tuple[float, tuple[int, ...]]] = {}
        for number, (tail, head, gain, _place) in enumerate(bounds):
            if tail not in reached:
                continue
            total, path = reached[tail]
            if head not in further or total + gain > further[head][0]:
                further[head] = (total + gain, (*path, number))
        if start in further and further[start][0] > _ROUNDING:
            return further[start][1]
        reached = further
    return None
