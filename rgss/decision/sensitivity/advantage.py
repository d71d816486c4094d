"""Advantage of a choice over its best rival at one value of an input."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rgss.tradeoff.problem import TIE_TOLERANCE
from rgss.tradeoff.robustness import Standing


@dataclass(frozen=True, slots=True, kw_only=True)
class Advantage:
    """Lead of a choice in weighted value.

    Attributes:
        lead: The value of the choice minus that of its best rival; below 0 if another is better. None if
            the choice is not feasible, or there is no rival.
        feasible: True if the choice meets every requirement.
        winners: The rows of the best designs, ascending; empty if nothing is feasible.
        rival: The row of the best rival; None if there is none.
    """

    lead: float | None
    feasible: bool
    winners: tuple[int, ...]
    rival: int | None


def advantage_of(standing: Standing, chosen: int, tied: tuple[int, ...]) -> Advantage:
    """The advantage of a choice.

    Rivals are all other feasible designs; those tied with the choice in the study count only
    if they are better than it.

    Args:
        standing: Weighted values and feasibility of the designs.
        chosen: The row of the choice.
        tied: The rows that are tied with it in the study, itself among them.
    """
    winners = standing.best()
    feasible = bool(standing.feasible[chosen])
    rivals = standing.feasible.copy()
    mine = standing.totals[chosen]
    for row in tied:
        rivals[row] &= row != chosen and (not feasible or bool(standing.totals[row] > mine + TIE_TOLERANCE))
    if not rivals.any():
        return Advantage(lead=None, feasible=feasible, winners=winners, rival=None)
    best = int(np.argmax(np.where(rivals, standing.totals, -np.inf)))
    lead = float(mine - standing.totals[best]) if feasible else None
    return Advantage(lead=lead, feasible=feasible, winners=winners, rival=best)
