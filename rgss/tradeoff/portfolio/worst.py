"""Best worst value of a portfolio: the largest value at which a few members cover all tasks."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from enum import Enum

import numpy as np
from numpy.typing import NDArray

from rgss.tradeoff.portfolio.cover_bound import CoverBound, Reached, masks_of
from rgss.tradeoff.portfolio.cover_search import raised
from rgss.tradeoff.portfolio.mean import SizeAnswer
from rgss.tradeoff.portfolio.primal import Rows, Values
from rgss.tradeoff.portfolio.work import WorkBudget

PARTS = 12
"""A cover is looked for with one such part of the work, so that some is left for other levels."""

SEARCH_PARTS = 3
"""The primal search takes at most one such part of the work."""

BOUND_WORK = 20
"""Work of the linear program of a bound, in evaluations of every value."""


class _Cover(Enum):
    """Outcome of a search for a cover that found none."""

    NONE = "none"
    UNKNOWN = "unknown"


def best_worst(values: Values, size: int, start: Rows, tolerance: float, work: WorkBudget) -> SizeAnswer:
    """The portfolio whose worst task is served best.

    The objective is one of the values, so it is bisected: members serve a task at a level where their value
    reaches it, and at most k of them have to cover all tasks (as Minieka, "The m-center problem", 1970). Whether
    they can is decided exactly, by branching over the members that serve the task that the fewest serve.

    Args:
        values: The value of each member in each task, shape (members, tasks); negative where it does not serve.
        size: At most so many members.
        start: A portfolio to start from; empty if none is known.
        tolerance: Differences up to it do not count.
        work: The rest of the work limit.
    """
    ideal = float(values.max(axis=0).min())
    best, known = start, worst_of(values, start)
    levels = np.unique(values[(values >= 0.0) & (values <= ideal)])
    low = int(np.searchsorted(levels, known, side="right"))
    high = _unreached(values, levels, low, size, work)
    if low < high:
        best = raised(values, size, start, work.part(SEARCH_PARTS))
        known = worst_of(values, best)
        low = int(np.searchsorted(levels, known, side="right"))
    # Levels from `high` on are proven not to be reached, those below `low` are reached. Each cover is looked for
    # with a part of the work first, then with all that is left.
    for parts in (PARTS, 1):
        open_from = high
        while low < open_from:
            middle = (low + open_from) // 2
            found = _cover(values, float(levels[middle]), size, work.part(parts))
            if isinstance(found, tuple):
                best, known = found, worst_of(values, found)
                low = max(middle + 1, int(np.searchsorted(levels, known, side="right")))
            elif found is _Cover.NONE:
                open_from = high = middle
            else:
                # Not decided: look further below for a portfolio; the bound is looked for above.
                open_from = middle
        below = max(low, open_from)
        while below < high:
            middle = (below + high) // 2
            if _cover(values, float(levels[middle]), size, work.part(parts)) is _Cover.NONE:
                high = middle
            else:
                below = middle + 1
        if low >= high or work.spent:
            break
    bound = known if high <= low else float(levels[high - 1])
    if bound <= known + tolerance:
        bound = known
    return SizeAnswer(rows=best, objective=known, bound=bound)


def worst_of(values: Values, rows: Sequence[int]) -> float:
    """The worst task's value; -1 where a task is not served."""
    return max(-1.0, float(values[list(rows)].max(axis=0).min())) if rows else -1.0


def _unreached(values: Values, levels: NDArray[np.float64], low: int, size: int, work: WorkBudget) -> int:
    """The first level from `low` on that the bounds alone exclude; their number if they exclude none."""
    high = len(levels)
    while low < high and not work.spent:
        middle = (low + high) // 2
        reached = (values >= levels[middle]).astype(np.float64)
        work.spend(BOUND_WORK * reached.size)
        bound, everything = CoverBound.of(reached), np.ones(values.shape[1])
        if bound.excludes(bound.shares(reached, everything), everything, size):
            high = middle
        else:
            low = middle + 1
    return high


def _cover(values: Values, level: float, size: int, work: WorkBudget) -> Rows | _Cover:
    """At most so many members that serve every task at a level."""
    # Reads the clock, so that nothing is begun once the time is over.
    work.spend(0)
    if work.spent:
        return _Cover.UNKNOWN
    reached = values >= level
    rows = np.flatnonzero(reached.any(axis=1))
    masks = masks_of(reached[rows])
    kept = _needed(masks, work)
    if kept is None:
        return _Cover.UNKNOWN
    matrix = reached[rows[kept]].astype(np.float64)
    work.spend(BOUND_WORK * matrix.size)
    search = _CoverSearch(
        reached=matrix,
        masks=[masks[at] for at in kept],
        by_task=[np.flatnonzero(column) for column in matrix.T],
        bound=CoverBound.of(matrix),
        work=work,
    )
    found = search.covered(np.ones(values.shape[1]), (1 << values.shape[1]) - 1, size)
    return found if isinstance(found, _Cover) else tuple(sorted(int(rows[kept[at]]) for at in found))


def _needed(masks: Sequence[int], work: WorkBudget) -> list[int] | None:
    """Members whose cover is not contained in that of another, largest first; None if a limit is exceeded."""
    kept: list[int] = []
    for at in sorted(range(len(masks)), key=lambda at: (-masks[at].bit_count(), at)):
        work.spend(len(kept))
        if work.spent:
            return None
        if not any(masks[at] & ~masks[other] == 0 for other in kept):
            kept.append(at)
    return kept


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _CoverSearch:
    """Branch and bound for a cover.

    Attributes:
        reached: 1 where a member serves a task, shape (members, tasks).
        masks: The same as the bits of whole numbers.
        by_task: The members that serve each task.
        bound: The task weights that bound covers.
        work: The rest of the work limit.
        failed: With how many members the tasks that are left cannot be covered, by their mask.
    """

    reached: Reached
    masks: Sequence[int]
    by_task: Sequence[NDArray[np.intp]]
    bound: CoverBound
    work: WorkBudget
    failed: dict[int, int] = field(default_factory=dict)

    def covered(self, left: NDArray[np.float64], mask: int, size: int) -> Rows | _Cover:
        """Members that cover the tasks that are left, which are given as numbers and as bits."""
        if not mask:
            return ()
        if size == 0 or self.failed.get(mask, 0) >= size:
            return _Cover.NONE
        if self.work.spent:
            return _Cover.UNKNOWN
        self.work.spend(4 * len(self.masks) + 10 * len(self.by_task))
        shares = self.bound.shares(self.reached, left)
        if self.bound.excludes(shares, left, size):
            self.failed[mask] = size
            return _Cover.NONE
        task = min(np.flatnonzero(left).tolist(), key=lambda one: len(self.by_task[one]))
        members = self.by_task[task]
        seen: set[int] = set()
        for at in members[np.argsort(-shares[members, 0], kind="stable")].tolist():
            rest = mask & ~self.masks[at]
            if rest in seen:
                continue
            seen.add(rest)
            found = self.covered(left * (1.0 - self.reached[at]), rest, size - 1)
            if isinstance(found, tuple):
                return (at, *found)
            if found is _Cover.UNKNOWN:
                return found
        self.failed[mask] = size
        return _Cover.NONE
