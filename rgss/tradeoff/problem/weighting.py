"""Weights of the measures: stated ones, and swing weights from ranks or points."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from enum import Enum

from rgss.errors import TradeoffError

WEIGHT_SUM_TOLERANCE = 1e-9
"""Largest distance of the sum of the weights from 1."""


class RankRule(str, Enum):
    """Method that turns ranks of importance into weights.

    With n measures, rank 1 being the most important:

    - ``rank_order_centroid``: ``w(r) = (1/n) Σ_{k=r..n} 1/k``, the centre of all weights that have
      this order (Barron and Barrett, "Decision quality using ranked attribute weights", 1996).
    - ``rank_sum``: ``w(r) = 2 (n + 1 - r) / (n (n + 1))`` (Stillwell, Seaver and Edwards, 1981).
    - ``rank_reciprocal``: ``w(r) = (1/r) / Σ_{k=1..n} 1/k`` (the same).
    """

    RANK_ORDER_CENTROID = "rank_order_centroid"
    RANK_SUM = "rank_sum"
    RANK_RECIPROCAL = "rank_reciprocal"


@dataclass(frozen=True, slots=True, kw_only=True)
class Weighting:
    """Weights of the measures in the value of an alternative.

    Attributes:
        weights: Weight by measure, non-negative, with the sum 1. A measure of weight 0 is listed but has no effect, so
        it needs no evidence.

    Raises:
        TradeoffError: The weights are empty, one is negative or not finite, or they do not sum to 1.
    """

    weights: Mapping[str, float] = field(hash=False)

    def __post_init__(self) -> None:
        if not self.weights:
            raise TradeoffError("there are no weights", hint="give a weight to at least one measure")
        for measure, weight in self.weights.items():
            if not (math.isfinite(weight) and weight >= 0.0):
                raise TradeoffError(
                    f"weight of {measure!r} must be at least 0, got {weight:g}", hint="give a number from 0 to 1"
                )
        total = _exact_sum(self.weights.values())
        if abs(total - 1.0) > WEIGHT_SUM_TOLERANCE:
            raise TradeoffError(
                f"weights must sum to 1, got {total:.12g}",
                hint=f"change them by {1.0 - total:+.12g} in all, or divide each by {total:.12g}"
                if total > 0.0
                else "give a positive weight to at least one measure",
            )

    @property
    def deciding_measures(self) -> tuple[str, ...]:
        """The measures whose weight is above 0, in the order in which they are given."""
        return tuple(measure for measure, weight in self.weights.items() if weight > 0.0)


def weights_from_ranks(ranks: Mapping[str, int], rule: RankRule) -> dict[str, float]:
    """Swing weights from ranks.

    Measures with the same rank get the mean weight of their places, and the next rank follows after these places (1, 2,
    2, 4).

    Args:
        ranks: Rank by measure; 1 is the measure whose swing from worst to best is worth most.
        rule: The formula.

    Returns:
        Weights by measure, in the order given; they sum to 1.

    Raises:
        TradeoffError: The ranks are empty, or skip a place.
    """
    count = len(ranks)
    places = sorted(ranks, key=lambda measure: ranks[measure])
    for place, measure in enumerate(places, start=1):
        shared = place > 1 and ranks[measure] == ranks[places[place - 2]]
        if ranks[measure] != place and not shared:
            raise TradeoffError(
                f"rank of {measure!r} must be {place}, got {ranks[measure]}",
                hint="count from 1; equal ranks take as many places as they are, such as 1, 2, 2, 4",
            )
    if not count:
        raise TradeoffError("there are no ranks", hint="give a rank to at least one measure")
    shares: dict[int, list[float]] = {}
    for place, measure in enumerate(places, start=1):
        shares.setdefault(ranks[measure], []).append(_weight_of_place(place, count, rule))
    return {measure: math.fsum(shares[rank]) / len(shares[rank]) for measure, rank in ranks.items()}


def weights_from_points(points: Mapping[str, float]) -> dict[str, float]:
    """Swing weights from points, such as 100 for the most important swing and 40 for another.

    Args:
        points: Points by measure; none is negative.

    Returns:
        Weights by measure, in the given order: share of the sum of points.

    Raises:
        TradeoffError: A number of points is negative or not finite, or the sum is 0.
    """
    for measure, number in points.items():
        if not (math.isfinite(number) and number >= 0.0):
            raise TradeoffError(
                f"points of {measure!r} must be at least 0, got {number:g}",
                hint="give a number such as 100 for the most",
            )
    total = _exact_sum(points.values())
    if not (math.isfinite(total) and total > 0.0):
        raise TradeoffError(
            f"points must sum to more than 0, got {total:g}", hint="give points to at least one measure"
        )
    return {measure: number / total for measure, number in points.items()}


def _weight_of_place(place: int, count: int, rule: RankRule) -> float:
    if rule is RankRule.RANK_ORDER_CENTROID:
        return math.fsum(1.0 / later for later in range(place, count + 1)) / count
    if rule is RankRule.RANK_SUM:
        return 2.0 * (count + 1 - place) / (count * (count + 1))
    return 1.0 / (place * math.fsum(1.0 / each for each in range(1, count + 1)))


def _exact_sum(numbers: Iterable[float]) -> float:
    try:
        return math.fsum(numbers)
    except OverflowError:  # beyond what a float holds
        return math.inf
