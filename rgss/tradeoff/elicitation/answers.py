"""Pairwise answers on swings: a ratio, a range of ratios, or which of two is worth at least as much."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from rgss.errors import TradeoffError
from rgss.tradeoff.problem import ElicitedOrder

GREATEST_SWING_RATIO = 1e9
"""Greatest ratio of two swings, and the inverse of the least."""


@dataclass(frozen=True, slots=True, kw_only=True)
class PairwiseAnswer:
    """Pairwise comparison of swings: one is worth between `least` and `most` times the other.

    A swing is the gain from the worst to the best quantity of a value function; the relative worth of two swings is the
    ratio of the weights (von Winterfeldt and Edwards, *Decision Analysis and Behavioral Research*, 1986, chapter 8).

    Attributes:
        swing_of: The first criterion.
        over: The second criterion.
        least: The least ratio, above 0.
        most: The greatest ratio; infinite if only the least is known.

    Raises:
        TradeoffError: The criteria are the same, or the ratios are no range of positive numbers, or are extreme.
    """

    swing_of: str
    over: str
    least: float
    most: float

    def __post_init__(self) -> None:
        if self.swing_of == self.over:
            raise TradeoffError(f"{self.over!r} is compared with itself", hint="compare two swings")
        if not (0.0 < self.least <= self.most and math.isfinite(self.least)):
            raise TradeoffError(
                f"the ratio of {self.swing_of!r} and {self.over!r} cannot lie between {self.least:g} and {self.most:g}",
                hint="give positive numbers, the smaller one first",
            )
        ends = [self.least] if math.isinf(self.most) else [self.least, self.most]
        if not 1.0 / GREATEST_SWING_RATIO <= min(ends) <= max(ends) <= GREATEST_SWING_RATIO:
            raise TradeoffError(
                f"the ratio of {self.swing_of!r} and {self.over!r} must be from {1.0 / GREATEST_SWING_RATIO:g} to "
                f"{GREATEST_SWING_RATIO:g}, got {' to '.join(f'{end:g}' for end in dict.fromkeys(ends))}",
                hint="leave out a measure whose swing is worth next to nothing",
            )

    @property
    def is_ratio(self) -> bool:
        """True if it states one ratio, which is a judgement with an error; otherwise it is a bound."""
        return self.least == self.most

    @property
    def ratio(self) -> float:
        """The ratio, or the geometric mean of both ends."""
        return math.sqrt(self.least * self.most)

    @property
    def words(self) -> str:
        """The answer as a comparison: ``t_e = 0.6 × C_total``."""
        if self.is_ratio:
            return f"{self.swing_of} = {self.least:g} × {self.over}"
        if math.isinf(self.most):
            times = "" if self.least == 1.0 else f"{self.least:g} × "
            return f"{self.swing_of} ≥ {times}{self.over}"
        return f"{self.swing_of} = {self.least:g} to {self.most:g} × {self.over}"

    def orders(self) -> tuple[ElicitedOrder, ...]:
        """The answer as orders of weights."""
        lower = ElicitedOrder(
            heavier=self.swing_of,
            heavier_measures=(self.swing_of,),
            lighter=self.over,
            lighter_measures=(self.over,),
            times=self.least,
        )
        if math.isinf(self.most):
            return (lower,)
        upper = ElicitedOrder(
            heavier=self.over,
            heavier_measures=(self.over,),
            lighter=self.swing_of,
            lighter_measures=(self.swing_of,),
            times=1.0 / self.most,
        )
        return (lower, upper)


def connected_parts(names: Sequence[str], answers: Sequence[PairwiseAnswer]) -> tuple[tuple[str, ...], ...]:
    """The criteria in groups that answers connect, in the order of the names."""
    part = {name: place for place, name in enumerate(names)}
    for answer in answers:
        keep, drop = sorted((part[answer.swing_of], part[answer.over]))
        part = {name: keep if place == drop else place for name, place in part.items()}
    return tuple(tuple(name for name in names if part[name] == place) for place in sorted(set(part.values())))
