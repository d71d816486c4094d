"""Best mean of a portfolio: branch and bound with Lagrangian bounds that hold whatever the multipliers are."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rgss.tradeoff.portfolio.primal import Rows, Values, exchanged, merit, search_portfolio
from rgss.tradeoff.portfolio.work import WorkBudget

ROOT_STEPS = 400
NODE_STEPS = 15
"""So many steps of the subgradient method at the root, and at every other node."""


@dataclass(frozen=True, slots=True, kw_only=True)
class SizeAnswer:
    """The best portfolio that was found with at most so many members.

    Attributes:
        rows: Its members; empty if none was found that serves every task.
        objective: Its objective; negative if none was found.
        bound: No portfolio exceeds it; negative if none serves every task.
    """

    rows: Rows
    objective: float
    bound: float


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Node:
    """Members that are in and members that are open; the rest is out."""

    inside: Rows
    open: NDArray[np.intp]
    multipliers: Values
    bound: float


def best_mean(profits: Values, size: int, start: Rows, tolerance: float, work: WorkBudget) -> SizeAnswer:
    """The portfolio of the highest mean value.

    ``max_S Σ_t max_{g in S} p_gt`` with ``|S| <= k``, the k-median problem (Cornuejols, Fisher and
    Nemhauser, "Location of bank accounts to optimize float", 1977). With any multipliers u the value
    ``Σ_t u_t + Σ of the k largest ρ_g``, ``ρ_g = Σ_t max(0, p_gt - u_t)``, is an upper bound. Members
    whose choice would bring the bound below the best known portfolio are left out.

    Args:
        profits: Gain of each member in each task, shape (members, tasks).
        size: At most so many members.
        start: A portfolio to start from.
        tolerance: Differences up to it do not count.
        work: The rest of the work limit.
    """
    best = search_portfolio(profits, size, (start,))
    known = merit(profits, best)
    nodes = [
        _Node(
            inside=(),
            open=np.arange(len(profits), dtype=np.intp),
            multipliers=profits.max(axis=0),
            bound=float(profits.max(axis=0).sum()),
        )
    ]
    steps, bound = ROOT_STEPS, -np.inf
    while nodes:
        node = nodes.pop()
        if node.bound <= known + tolerance:
            continue
        if work.spent:
            # What is left open is bounded by its parents.
            bound = max([node.bound, *(one.bound for one in nodes)])
            break
        node, heuristic = _bounded(profits, size, node, known, steps, work)
        steps = NODE_STEPS
        candidate = exchanged(profits, heuristic)
        if len(candidate) <= size and merit(profits, candidate) > known:
            best, known = candidate, merit(profits, candidate)
        if node.bound <= known + tolerance:
            continue
        nodes += _branches(profits, size, node, known, tolerance)
    return SizeAnswer(rows=best if known >= 0.0 else (), objective=known, bound=max(known, bound))


def _bounded(profits: Values, size: int, node: _Node, known: float, steps: int, work: WorkBudget) -> tuple[_Node, Rows]:
    """The node with a better bound, by the subgradient method, and the portfolio of its best multipliers."""
    inside, some = profits[list(node.inside)], profits[node.open]
    free = size - len(node.inside)
    here, best, chosen = node.multipliers, node.multipliers, np.arange(0)
    bound, scale, since = np.inf, 1.0, 0
    for _ in range(steps):
        work.spend(some.size)
        over = some - here
        gains = np.maximum(over, 0.0).sum(axis=1)
        rows = np.argsort(-gains, kind="stable")[:free]
        rows = rows[gains[rows] > 0.0]
        fixed = inside - here
        value = float(here.sum() + gains[rows].sum() + np.maximum(fixed, 0.0).sum())
        if value < bound - 1e-12:
            bound, best, chosen, since = value, here, rows, 0
        else:
            since += 1
            if since >= 10:
                scale, since, here = scale / 2.0, 0, best
                continue
        served = (over[rows] > 0.0).sum(axis=0) + (fixed > 0.0).sum(axis=0)
        slope = 1.0 - served
        length = float((slope**2).sum())
        if length == 0.0 or scale < 1e-4 or bound <= known or work.spent:
            break
        here = here - scale * max(value - known, 1e-6) / length * slope
    selected = tuple(int(one) for one in node.open[chosen])
    bound = min(bound, node.bound)
    return _Node(inside=node.inside, open=node.open, multipliers=best, bound=bound), (*node.inside, *selected)


def _branches(profits: Values, size: int, node: _Node, known: float, tolerance: float) -> list[_Node]:
    """The nodes without and with the member that counts most, the latter to be examined first."""
    free = size - len(node.inside)
    if free == 0 or not len(node.open):
        return []
    here = node.multipliers
    gains = np.maximum(profits[node.open] - here, 0.0).sum(axis=1)
    base = float(here.sum() + np.maximum(profits[list(node.inside)] - here, 0.0).sum())
    order = np.argsort(-gains, kind="stable")
    others = float(gains[order[: free - 1]].sum())
    # The bound with a member in: itself and the best of the others that are still free.
    with_it = base + gains + np.where(gains >= gains[order[min(free, len(order)) - 1]], np.inf, others)
    kept = order[with_it[order] > known + tolerance]
    first, rest = kept[0], np.sort(kept[1:])
    found = []
    if len(rest):
        top = np.sort(gains[rest])[::-1][:free].sum()
        out = min(node.bound, base + float(top))
        found.append(_Node(inside=node.inside, open=node.open[rest], multipliers=here, bound=out))
    elif node.inside:
        alone = merit(profits, node.inside)
        found.append(_Node(inside=node.inside, open=node.open[rest], multipliers=here, bound=alone))
    inside = (*node.inside, int(node.open[first]))
    found.append(_Node(inside=inside, open=node.open[rest], multipliers=here, bound=node.bound))
    return found
