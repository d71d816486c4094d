"""Primal search for portfolios: greedy, then exchanges of one member for another."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

Values = NDArray[np.float64]
Rows = tuple[int, ...]

RANDOM_STARTS = 8
"""So many random portfolios of each size are improved beside the greedy one."""

UNSERVED = -2.0
"""Value of a task that no member serves: more than all tasks together can be worth."""


def profits_of(values: Values, weights: Values) -> Values:
    """Contribution of each member to the mean by serving each task, shape (members, tasks)."""
    return np.where(values >= 0.0, values * weights, UNSERVED)


def merit(profits: Values, rows: Sequence[int]) -> float:
    """The weighted mean of a portfolio; negative where a task is not served, or by an empty one."""
    if not len(rows):
        return -np.inf
    return float(profits[list(rows)].max(axis=0).sum())


def greedy(profits: Values, start: Rows, size: int) -> Rows:
    """Add the member that gains most until there are so many."""
    rows = list(start)
    best = profits[rows].max(axis=0) if rows else np.full(profits.shape[1], -np.inf)
    while len(rows) < min(size, len(profits)):
        row = int(np.maximum(profits, best).sum(axis=1).argmax())
        if row in rows:
            break
        rows.append(row)
        best = np.maximum(best, profits[row])
    return tuple(rows)


def exchanged(profits: Values, start: Rows) -> Rows:
    """The portfolio that no exchange of one member for another improves."""
    rows = list(start)
    if not rows:
        return ()
    here = merit(profits, rows)
    improved = True
    while improved:
        improved = False
        for place in range(len(rows)):
            others = rows[:place] + rows[place + 1 :]
            best = profits[others].max(axis=0) if others else np.full(profits.shape[1], -np.inf)
            totals = np.maximum(profits, best).sum(axis=1)
            row = int(totals.argmax())
            if totals[row] > here + 1e-12:
                rows[place], here, improved = row, float(totals[row]), True
    return tuple(sorted(set(rows)))


def search_portfolio(profits: Values, size: int, starts: Sequence[Rows]) -> Rows:
    """A portfolio of high mean value with at most so many members, by a fixed seed."""
    draw = np.random.default_rng(size)
    found = [exchanged(profits, greedy(profits, start, size)) for start in ((), *starts)]
    for _ in range(RANDOM_STARTS):
        chosen = draw.choice(len(profits), min(size, len(profits)), replace=False)
        found.append(exchanged(profits, tuple(int(row) for row in chosen)))
    return max(found, key=lambda rows: merit(profits, rows))
