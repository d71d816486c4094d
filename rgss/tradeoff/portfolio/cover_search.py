"""Primal search for the best worst task: exchanges of members under weights that grow where tasks stay unserved."""

from __future__ import annotations

import numpy as np

from rgss.tradeoff.portfolio.primal import Rows, Values
from rgss.tradeoff.portfolio.work import WorkBudget

MOST_EXCHANGES = 2_000
"""So many exchanges are made at one level before it is given up."""

TENURE = 3
"""For so many exchanges a member that left does not return."""


def raised(values: Values, size: int, start: Rows, work: WorkBudget) -> Rows:
    """A portfolio whose worst task is served better, from one that is known.

    The level is raised above the worst task again and again. At each level members are exchanged so
    that the weights of the tasks that no member serves at it fall most; the weights of those that stay
    unserved grow, so that no local optimum holds the search (row weighting for set covering, as Gao et al.,
    "An efficient local search heuristic with row weighting for the unicost set covering problem", 2015).

    Args:
        values: The value of each member in each task, shape (members, tasks); negative where it does not serve.
        size: So many members.
        start: The portfolio to start from; any size up to that.
        work: Work limit of the search.
    """
    draw = np.random.default_rng(size)
    rows = list(start)
    others = np.setdiff1d(np.arange(len(values)), rows)
    rows += draw.permutation(others)[: size - len(rows)].tolist()
    best, worst = start, float(values[list(start)].max(axis=0).min()) if start else -1.0
    while not work.spent:
        now = float(values[rows].max(axis=0).min())
        if now > worst:
            best, worst = tuple(sorted(rows)), now
        above = values > worst
        if not above.any(axis=0).all():
            break
        found = _covering(above.astype(np.float64), rows, work)
        if found is None:
            break
        rows = found
    return best


def _covering(reached: Values, rows: list[int], work: WorkBudget) -> list[int] | None:
    """The members of a cover of as many members; None if none is met."""
    rows = list(rows)
    weights = np.ones(reached.shape[1])
    barred = np.zeros(len(reached), dtype=np.intp)
    for step in range(1, MOST_EXCHANGES + 1):
        work.spend(reached.size)
        chosen = reached[rows]
        served = chosen.sum(axis=0)
        if served.all():
            return rows
        if work.spent:
            return None
        # What is unserved once a member has left, shape (members of the portfolio, tasks).
        unserved = (served - chosen == 0.0) * weights
        costs = unserved.sum(axis=1) - reached @ unserved.T
        costs[barred >= step] = np.inf
        costs[rows] = np.inf
        row, place = np.unravel_index(int(costs.argmin()), costs.shape)
        if not np.isfinite(costs[row, place]):
            return None
        barred[rows[place]] = step + TENURE
        rows[place] = int(row)
        weights += reached[rows].sum(axis=0) == 0.0
    return None
