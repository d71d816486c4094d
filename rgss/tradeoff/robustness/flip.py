"""Distance of the weights from another decision."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rgss.tradeoff.problem import TIE_TOLERANCE, Array, Mask, checked_values, checked_weights, classes
from rgss.tradeoff.weights import Polytope, WeightSet, of_each_region


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class WeightShift:
    """The least change of weights at which an alternative becomes one of the best.

    Attributes:
        rows: The alternative, and those of the same values; ascending.
        nearest: The weights at the least Euclidean distance, shape (m,).
        distance: That distance.
        nearest_in_sum: Weights at the least sum of absolute differences, shape (m,); there may be
            others as near.
        sum_distance: That sum; half of it is the weight that moves from some measures to others.
    """

    rows: tuple[int, ...]
    nearest: Array
    distance: float
    nearest_in_sum: Array
    sum_distance: float


@dataclass(frozen=True, slots=True, kw_only=True)
class WeightRange:
    """Range of one weight, the others keeping their proportions, within which the decision stays.

    Attributes:
        low: The least weight at which the chosen alternative is still best.
        high: The largest.
        below: The alternatives that win just below it, ascending; empty where `low` is 0.
        above: The alternatives that win just above it; empty where `high` is 1.
    """

    low: float
    high: float
    below: tuple[int, ...]
    above: tuple[int, ...]


def weight_shifts(
    values: Array, feasible: Mask, weights: Array, *, among: WeightSet | None = None
) -> tuple[WeightShift, ...]:
    """Nearest weights at which each potentially optimal alternative wins, the nearest first.

    The decision flips at the first entry whose rows are not the chosen ones: at any nearer weights the chosen
    alternative is best, and there its rows are equally good.

    Args:
        values: The single values, shape (n, m); rows that are not feasible may hold NaN.
        feasible: Mask of the alternatives that can be chosen, shape (n,).
        weights: The weights of the decision, shape (m,).
        among: The admitted weights; all by default.

    Returns:
        One entry for each group of alternatives with the same values that wins for some admitted
        weights, that of the decision first with distance 0.

    Raises:
        TradeoffError: A value or a weight is not what it must be.
    """
    rows = np.flatnonzero(feasible)
    if not len(rows):
        return ()
    distinct, membership = classes(checked_values(values[rows]))
    here = checked_weights(weights, distinct.shape[1])
    admitted = among or WeightSet.simplex(distinct.shape[1])
    shifts = []
    for kind, found in enumerate(of_each_region(distinct, admitted, lambda region: _shift(region, here), None)):
        if found is not None:
            members = tuple(int(row) for row in rows[membership == kind])
            shifts.append(
                WeightShift(
                    rows=members,
                    nearest=found[0],
                    distance=float(np.linalg.norm(found[0] - here)),
                    nearest_in_sum=found[1],
                    sum_distance=float(np.abs(found[1] - here).sum()),
                )
            )
    return tuple(sorted(shifts, key=lambda shift: (shift.distance, shift.rows)))


def weight_ranges(values: Array, feasible: Mask, weights: Array, chosen: int) -> tuple[WeightRange, ...]:
    """Range of each weight alone, the others scaled so that all sum to 1.

    Along that line every weighted value is linear in the weight, so the ends are exact.

    Args:
        values: The single values, shape (n, m); rows that are not feasible may hold NaN.
        feasible: Mask of the alternatives that can be chosen, shape (n,).
        weights: The weights of the decision, shape (m,).
        chosen: The alternative that is best there.

    Returns:
        One range for each weight. Where the chosen one is tied, an end may be the weight itself.

    Raises:
        TradeoffError: A value or a weight is not what it must be.
    """
    rows = np.flatnonzero(feasible)
    checked = checked_values(values[rows])
    here = checked_weights(weights, checked.shape[1])
    mine = int(np.flatnonzero(rows == chosen)[0])
    lead = checked[mine] - checked
    ranges = []
    for place, weight in enumerate(here):
        others = here.copy()
        others[place] = 0.0
        rest = others.sum()
        # Where all weight is on one measure there are no proportions to keep: the others share alike.
        others = others / rest if rest > 0.0 else (np.arange(len(here)) != place) / max(1, len(here) - 1)
        # The lead over each alternative at weight t is base + t slope.
        base = lead @ others
        slope = lead[:, place] - base
        low, below = _first_loss(base, slope, float(weight), towards=0.0)
        high, above = _first_loss(base, slope, float(weight), towards=1.0)
        ranges.append(
            WeightRange(
                low=low,
                high=high,
                below=tuple(int(row) for row in rows[below]),
                above=tuple(int(row) for row in rows[above]),
            )
        )
    return tuple(ranges)


def _shift(region: Polytope, weights: Array) -> tuple[Array, Array] | None:
    nearest = region.nearest(weights)
    nearest_in_sum = region.nearest_in_sum(weights)
    return None if nearest is None or nearest_in_sum is None else (nearest, nearest_in_sum)


def _first_loss(base: Array, slope: Array, start: float, *, towards: float) -> tuple[float, NDArray[np.intp]]:
    """Point at which the first lead becomes negative on the way, and whose it is; the end if none does."""
    direction = 1.0 if towards > start else -1.0
    lead = base + start * slope
    # An equal one that gains on the way beats the chosen one at once; rounding must not hide it.
    lead = np.where(np.abs(lead) <= TIE_TOLERANCE, 0.0, lead)
    losing = direction * slope < -TIE_TOLERANCE
    steps = np.full(len(base), math.inf)
    steps[losing] = np.maximum(lead[losing], 0.0) / (-direction * slope[losing])
    nearest = float(steps.min(initial=math.inf))
    # Leads that vanish at the very end, where one weight is all, are ties there and lose nothing before.
    if not nearest < abs(towards - start) - TIE_TOLERANCE:
        return towards, np.array([], dtype=np.intp)
    # Of those that overtake there, the steepest lead on from there.
    first = np.flatnonzero(steps <= nearest + TIE_TOLERANCE)
    steepest = (-direction * slope[first]).max()
    winners = first[-direction * slope[first] >= steepest - TIE_TOLERANCE]
    return start + direction * nearest, winners
