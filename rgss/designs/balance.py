"""Balanced subset of a set of designs.

A subset is balanced if each level of each factor, and each pair of levels of two factors, occurs equally often. Xu's
measure of imbalance for designs of mixed levels is

    J2 = Σ_{i<j} δ_ij²,   δ_ij = Σ_k w_k [design i and design j have the same level of factor k]

with the number of levels of a factor as its weight; it is least for orthogonal arrays (H. Xu, *An algorithm for
constructing orthogonal and nearly-orthogonal arrays with mixed levels and small runs*, Technometrics 44, 2002). The
same sum with δ instead of δ² counts only single levels. Designs are added one by one with the least increase of both,
single levels first, and then exchanged for better ones; the best of several starts is kept.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from random import Random
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import numpy as np

LARGEST_BLOCK = 2_048
"""Block size: larger sets are divided into blocks, from each of which a subset is chosen."""

_BINS = 4
_MOST_PASSES = 20
_MOST_STARTS = 32
_WORK = 100_000
"""Budget of compared pairs of designs for all starts; the first start is always made."""


def balanced_part(rows: Sequence[Sequence[int]], count: int) -> tuple[int, ...]:
    """Balanced subset over the levels of the factors.

    The result is the same on every machine: all arithmetic is in integers, and of equally good designs the first is
    chosen.

    Args:
        rows: The level of each factor of each design, as a number.
        count: Size of the subset, from 0 to all.

    Returns:
        Indices of the chosen rows, ascending.
    """
    chosen: list[int] = []
    total = len(rows)
    for start in range(0, total, LARGEST_BLOCK):
        end = min(start + LARGEST_BLOCK, total)
        here = count * end // total - count * start // total
        chosen += [start + place for place in _part(rows[start:end], here)]
    return tuple(chosen)


def binned(share: float) -> int:
    """Quarter of a range that contains a value, used as its level.

    Args:
        share: Position of the value in the range, from 0 to 1.
    """
    return min(int(share * _BINS), _BINS - 1)


def _part(rows: Sequence[Sequence[int]], count: int) -> list[int]:
    import numpy as np

    if not rows or not rows[0] or count in (0, len(rows)):
        return list(range(count))
    levels = np.asarray(rows, dtype=np.int64)
    weights = np.array([len(np.unique(column)) for column in levels.T], dtype=np.int64)
    # Weight with which counts of single levels always dominate the sum of squares.
    single = int(weights.sum()) ** 2 * (count + 1) + 1

    def alike(place: int) -> np.ndarray[tuple[int], np.dtype[np.int64]]:
        """Weighted agreement of each design with a given one."""
        common = (levels == levels[place]) @ weights
        return np.asarray(single * common + common**2, dtype=np.int64)

    best: tuple[int, list[int]] | None = None
    for start in range(max(1, min(_MOST_STARTS, _WORK // (len(rows) * count)))):
        # The first start is greedy, the others begin with a random subset.
        first = [] if start == 0 else Random(start).sample(range(len(rows)), count)  # noqa: S311 - no secret
        found = _improved(len(rows), count, first, alike)
        if best is None or found < best:
            best = found
    return [] if best is None else best[1]


def _improved(
    size: int, count: int, first: Sequence[int], alike: Callable[[int], np.ndarray[tuple[int], np.dtype[np.int64]]]
) -> tuple[int, list[int]]:
    """Complete a subset, exchange designs while that improves the balance, and return it with its imbalance."""
    import numpy as np

    taken = np.zeros(size, dtype=bool)
    score = np.zeros(size, dtype=np.int64)
    never = np.iinfo(np.int64).max
    for place in first:
        taken[place] = True
        score += alike(place)
    for _ in range(count - len(first)):
        place = int(np.argmin(np.where(taken, never, score)))
        taken[place] = True
        score += alike(place)
    for _ in range(_MOST_PASSES):
        changed = False
        for place in [int(one) for one in np.flatnonzero(taken)]:
            own = alike(place)
            # Agreement of each other design with the subset without this one.
            others = np.where(taken, never, score - own)
            best = int(np.argmin(others))
            if others[best] < score[place] - own[place]:
                taken[place], taken[best] = False, True
                score += alike(best) - own
                changed = True
        if not changed:
            break
    return int(score[taken].sum()), [int(place) for place in np.flatnonzero(taken)]
