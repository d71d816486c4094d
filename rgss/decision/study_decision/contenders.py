"""Closest rivals of the choice: their acceptability, and the weights at which they win."""

from __future__ import annotations

from dataclasses import dataclass

from rgss.decision.robustness import Robustness
from rgss.tradeoff.robustness import Support


@dataclass(frozen=True, slots=True, kw_only=True)
class Contender:
    """A variant that comes first in some draws of weights and noise, or is on the Pareto front.

    Attributes:
        variant: Its id.
        support: Its place relative to the Pareto front; None if it is not feasible.
        feasible: True if it meets every requirement.
        single_values: Its value in each weighted measure, rounded so that equal variants compare equal.
        region: The share of weights at which it is best by the evidence; None if not computed.
        first: The share of the draws in which none is better.
        first_error: The standard error of that over repetitions of the study.
        confidence: The probability that it is best at its central weights; NaN if
            it is never first.
        feasible_share: The share of the draws in which it is feasible.
        weight_to_move: The least weight to move until it is best; None if no weights do that.
    """

    variant: int
    support: Support | None
    feasible: bool
    single_values: tuple[float, ...]
    region: float | None
    first: float
    first_error: float
    confidence: float
    feasible_share: float
    weight_to_move: float | None

    @property
    def on_front(self) -> bool:
        """True if it is on the Pareto front."""
        return self.support is not None and self.support is not Support.DOMINATED


def contenders_of(found: Robustness) -> tuple[Contender, ...]:
    """The contenders, the most often first ones at the beginning, equals by ascending id.

    Returns:
        The contenders; none if the acceptability was not computed.
    """
    weighting = found.weighting
    if weighting is None or weighting.acceptability is None:
        return ()
    indices = weighting.acceptability
    errors = indices.rank_errors[:, 0] if weighting.first_errors is None else weighting.first_errors
    supports = {point.row: point.support for point in found.front.points}
    shifts = {row: shift for shift in weighting.shifts or () for row in shift.rows}
    made = []
    for row, variant in enumerate(found.variants):
        if not indices.first[row] > 0.0 and supports.get(row, Support.DOMINATED) is Support.DOMINATED:
            continue
        shift = shifts.get(row)
        made.append(
            Contender(
                variant=variant,
                support=supports.get(row),
                feasible=bool(found.feasible[row]),
                single_values=tuple(round(value, 12) for value in found.values[row].tolist()),
                region=None if weighting.regions is None else float(weighting.regions[row].share),
                first=float(indices.first[row]),
                first_error=float(errors[row]),
                confidence=float(indices.confidence[row]),
                feasible_share=float(1.0 - indices.unranked[row]),
                weight_to_move=None if shift is None else shift.sum_distance / 2.0,
            )
        )
    # The sort is stable: equals keep the order of their ids.
    return tuple(sorted(made, key=lambda one: -one.first))
