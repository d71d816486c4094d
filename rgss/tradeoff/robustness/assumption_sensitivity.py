"""Range of one assumed number within which the choice stays the same."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rgss.tradeoff.problem import TIE_TOLERANCE, Array, Mask

SCANNED = 64
"""Steps in which each side is scanned where the dependence is not piecewise linear."""

_HALVINGS = 60
_NO_SLOPE = 1e-9


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Standing:
    """Values of the alternatives at one value of the assumption.

    Attributes:
        totals: Weighted values, shape (n,); NaN only where not feasible.
        feasible: Mask of the alternatives that can be chosen, shape (n,).
    """

    totals: Array
    feasible: Mask

    def best(self) -> tuple[int, ...]:
        """The best alternatives, ascending; empty where none is feasible."""
        if not self.feasible.any():
            return ()
        totals = np.where(self.feasible, self.totals, -np.inf)
        return tuple(int(row) for row in np.flatnonzero(totals >= totals.max() - TIE_TOLERANCE))


@dataclass(frozen=True, slots=True, kw_only=True)
class AssumptionRange:
    """Range of an assumption around its assumed value over which the choice stays best.

    Attributes:
        low: The least such value; None if nothing changes down to `lowest`.
        high: The greatest such value; None if nothing changes up to `highest`.
        lowest: Lower end of the scan.
        highest: Upper end of the scan; may be infinite.
        below: The best alternatives just below `low`, ascending; empty if nothing is feasible there.
        above: The best alternatives just above `high`.
        exact: True if the ends were solved exactly, for a piecewise linear dependence; otherwise they were bracketed by
        a scan and bisected, and a change that reverts within one step of the scan may have been missed.
    """

    low: float | None
    high: float | None
    lowest: float
    highest: float
    below: tuple[int, ...]
    above: tuple[int, ...]
    exact: bool

    @property
    def always(self) -> bool:
        """True if the choice stays best as far as was looked."""
        return self.low is None and self.high is None


def linear_range(
    evaluate: Callable[[float], Standing], chosen: int, start: float, *, kinks: Array, lowest: float, highest: float
) -> AssumptionRange:
    """The exact range where every total is linear and feasibility constant between given kinks.

    Args:
        evaluate: Callback: weighted values and feasibility of the alternatives at a value.
        chosen: The alternative that is best at `start`, alone or tied.
        start: The assumed value.
        kinks: Every value at which a total has a kink or an alternative meets or misses a
            threshold; others may be among them.
        lowest: The least value that makes sense, such as 0 for a cost.
        highest: The largest; may be infinite.
    """
    low, below = _walk(evaluate, chosen, start, kinks, lowest)
    high, above = _walk(evaluate, chosen, start, kinks, highest)
    return AssumptionRange(low=low, high=high, lowest=lowest, highest=highest, below=below, above=above, exact=True)


def scanned_range(
    evaluate: Callable[[float], Standing], chosen: int, start: float, *, lowest: float, highest: float
) -> AssumptionRange:
    """The range by scan and bisection, for any dependence.

    Args:
        evaluate: Callback: weighted values and feasibility of the alternatives at a value.
        chosen: The alternative that is best at `start`, alone or tied.
        start: The assumed value.
        lowest: Down to where it is followed; finite.
        highest: Up to where it is followed; finite.
    """
    low, below = _scan(evaluate, chosen, start, lowest)
    high, above = _scan(evaluate, chosen, start, highest)
    return AssumptionRange(low=low, high=high, lowest=lowest, highest=highest, below=below, above=above, exact=False)


def _walk(
    evaluate: Callable[[float], Standing], chosen: int, start: float, kinks: Array, end: float
) -> tuple[float | None, tuple[int, ...]]:
    """Breakpoint search until the choice is no longer best; returns the position and the new best."""
    for near, far in _segments(start, kinks, end):
        if chosen not in evaluate(near).best():
            return near, evaluate(near).best()
        points = _inner_points(near, far)
        if points[0] == points[1]:
            # Equal numbers, or kinks that only rounding distinguishes: no number between them to evaluate.
            continue
        first, second = (evaluate(point) for point in points)
        rivals = np.flatnonzero(first.feasible)
        slope = (second.totals[rivals] - first.totals[rivals]) / (points[1] - points[0])
        entering = first.totals[rivals] + (near - points[0]) * slope
        outward = slope * math.copysign(1.0, far - near)
        if not first.feasible[chosen]:
            return near, tuple(int(row) for row in rivals[_leaders(entering, outward)])
        mine = int(np.flatnonzero(rivals == chosen)[0])
        loss = _first_loss(entering[mine] - entering, outward[mine] - outward, abs(far - near))
        if loss is not None:
            there = entering + loss * outward
            return near + math.copysign(loss, far - near), tuple(int(row) for row in rivals[_leaders(there, outward)])
    if math.isfinite(end) and chosen not in evaluate(end).best():
        return end, evaluate(end).best()
    return None, ()


def _segments(start: float, kinks: Array, end: float) -> Iterator[tuple[float, float]]:
    """The pieces between neighbouring kinks, from the start outwards; kinks themselves come as both ends."""
    low, high = min(start, end), max(start, end)
    between = sorted({float(kink) for kink in kinks if low < kink < high}, reverse=end < start)
    return itertools.pairwise([start, *between, end])


def _inner_points(near: float, far: float) -> tuple[float, float]:
    if math.isfinite(far):
        return near + (far - near) / 3.0, near + 2.0 * (far - near) / 3.0
    step = math.copysign(max(1.0, abs(near)), far)
    return near + step, near + 2.0 * step


def _first_loss(lead: Array, rate: Array, length: float) -> float | None:
    """Distance at which the first lead becomes negative; None if none does.

    At the start no lead is negative beyond a tie, so negative values there are rounding errors.
    """
    losing = rate < -_NO_SLOPE * np.abs(rate).max(initial=0.0)
    reach = np.full(len(lead), math.inf)
    reach[losing] = np.maximum(lead[losing], 0.0) / -rate[losing]
    if math.isfinite(length):
        # A loss that is a tie up to the end of the piece belongs to the next piece.
        reach[lead + rate * length >= -TIE_TOLERANCE] = math.inf
    nearest = float(reach.min(initial=math.inf))
    return nearest if nearest < length else None


def _leaders(totals: Array, rate: Array) -> NDArray[np.intp]:
    """Alternatives that are best from here on: of those that are best here, the ones that gain fastest."""
    if not len(totals):
        return np.array([], dtype=np.intp)
    level = totals >= totals.max() - TIE_TOLERANCE
    return np.flatnonzero(level & (rate >= rate[level].max() - _NO_SLOPE * np.abs(rate).max()))


def _scan(
    evaluate: Callable[[float], Standing], chosen: int, start: float, end: float
) -> tuple[float | None, tuple[int, ...]]:
    inside = start
    for step in range(1, SCANNED + 1):
        outside = start + (end - start) * step / SCANNED
        if chosen in evaluate(outside).best():
            inside = outside
            continue
        for _ in range(_HALVINGS):
            middle = 0.5 * (inside + outside)
            if middle in (inside, outside):
                break
            if chosen in evaluate(middle).best():
                inside = middle
            else:
                outside = middle
        return inside, evaluate(outside).best()
    return None, ()
