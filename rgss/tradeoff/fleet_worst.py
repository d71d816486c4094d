"""Best worst value of a portfolio: the largest value at which a few members cover all tasks."""

from __future__ import annotations

from collections.abc import Sequence
from enum import Enum

import numpy as np

from rgss.tradeoff.fleet_mean import SizeAnswer
from rgss.tradeoff.fleet_primal import Rows, Values
from rgss.tradeoff.fleet_work import Work

PARTS = 12
"""A cover is looked for with one such part of the work, so that some is left for other levels."""


class _Cover(Enum):
    """Outcome of a search for a cover that found none."""

    NONE = "none"
    UNKNOWN = "unknown"


def best_worst(values: Values, size: int, start: Rows, tolerance: float, work: Work) -> SizeAnswer:
    """The portfolio whose worst task is served best.

    The objective is one of the values, so it is bisected: members serve a task at a level where their value
    reaches it, and at most k of them have to cover all tasks (as Minieka, "The m-center problem", 1970). Whether
    they can is decided exactly, by branching over the members that serve the task that the fewest serve.

    Args:
        values: The value of each member in each task, shape (members, tasks); negative where it does not serve.
        size: At most so many members.
        start: A portfolio to start from; empty if none is known.
        tolerance: Differences up to it do not count.
        work: What is left of the work limit.
    """
    ideal = float(values.max(axis=0).min())
    best, known = start, worst_of(values, start)
    levels = np.unique(values[(values >= 0.0) & (values <= ideal)])
    low, high = int(np.searchsorted(levels, known, side="right")), len(levels)
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


def _cover(values: Values, level: float, size: int, work: Work) -> Rows | _Cover:
    """At most so many members that serve every task at a level."""
    reached = values >= level
    rows, masks = [], list[int]()
    for row in np.flatnonzero(reached.any(axis=1)).tolist():
        mask = int.from_bytes(np.packbits(reached[row], bitorder="little").tobytes(), "little")
        rows.append(row)
        masks.append(mask)
    order = sorted(range(len(rows)), key=lambda at: (-masks[at].bit_count(), at))
    kept: list[int] = []
    for at in order:
        work.spend(len(kept))
        # A member that covers what another covers as well is not needed.
        if not any(masks[at] & ~masks[other] == 0 for other in kept):
            kept.append(at)
    tasks = values.shape[1]
    by_task = [[at for at in kept if masks[at] >> task & 1] for task in range(tasks)]
    failed: dict[int, int] = {}
    found = _covered((1 << tasks) - 1, size, masks, by_task, failed, work)
    return found if isinstance(found, _Cover) else tuple(sorted(rows[at] for at in found))


def _covered(
    left: int, size: int, masks: list[int], by_task: list[list[int]], failed: dict[int, int], work: Work
) -> Rows | _Cover:
    """Members that cover the tasks that are left; `failed` says with how many members that is impossible."""
    if not left:
        return ()
    if size == 0 or failed.get(left, 0) >= size:
        return _Cover.NONE
    if work.spent:
        return _Cover.UNKNOWN
    uncovered = [task for task in range(len(by_task)) if left >> task & 1]
    task = min(uncovered, key=lambda one: len(by_task[one]))
    work.spend(4 * len(masks) + 10 * len(by_task))
    gains = sorted((-(masks[at] & left).bit_count(), at) for at in by_task[task])
    most = max((mask & left).bit_count() for mask in masks) if size > 1 else -gains[0][0] if gains else 0
    if most * size < len(uncovered):
        failed[left] = size
        return _Cover.NONE
    seen: set[int] = set()
    outcome = _Cover.NONE
    for _, at in gains:
        rest = left & ~masks[at]
        if rest in seen:
            continue
        seen.add(rest)
        found = _covered(rest, size - 1, masks, by_task, failed, work)
        if isinstance(found, tuple):
            return (at, *found)
        if found is _Cover.UNKNOWN:
            outcome = _Cover.UNKNOWN
            break
    if outcome is _Cover.NONE:
        failed[left] = size
    return outcome
