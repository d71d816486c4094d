"""Branch and bound over levels by interval arithmetic: a proof that shares nothing with the solver."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from rgss.tradeoff.levels.grid import BLOCK, Column, Designs, LevelGrid, compensated_sum
from rgss.tradeoff.levels.stage_bounds import Intervals, Quantities, stage_bound
from rgss.tradeoff.milp import Constraint, Stage

MOST_PARTIAL = 1_000_000
"""So many partial designs are kept; beyond, the bound that is reached then is the answer."""

ROUNDING = 1e-12
"""Intervals are widened by it, relative to the sizes of what is added."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class IntervalBound:
    """Result of interval branch and bound.

    Attributes:
        bound: No design's objective exceeds it; minus infinity if none is feasible.
        complete: Whether every design was either pruned or evaluated.
        better: The best design that exceeds the given objective, shape (f,); None if none was met.
    """

    bound: float
    complete: bool
    better: Designs | None


def interval_bound(
    grid: LevelGrid,
    stage: Stage,
    constraints: Sequence[Constraint],
    *,
    known: float,
    tolerance: float,
    most: int = MOST_PARTIAL,
    is_over: Callable[[], bool] = lambda: False,
) -> IntervalBound:
    """Upper bound of a stage's objective over all designs, by interval branch and bound.

    The levels of the factors are fixed one after another, breadth first. Free factors contribute the interval from the
    least to the greatest entry of each table; partial designs whose bound does not exceed a known objective, or that
    cannot satisfy a constraint, are pruned.

    Args:
        grid: The tables.
        stage: The stage.
        constraints: The constraints of every stage.
        known: The objective of a feasible design; minus infinity if none is known.
        tolerance: Least excess over it for a partial design to be kept.
        most: Greatest number of partial designs.
        is_over: Termination predicate; the bound reached then is returned.
    """
    order = _order(grid)
    partial: Designs = np.zeros((1, len(order)), dtype=np.intp)
    # Before any factor is fixed: what no design at all exceeds.
    bounds = np.reshape(stage_bound(stage, constraints, _Reduced(grid, set()).of(partial)), 1)
    for depth in range(1, len(order) + 1):
        fixed = order[:depth]
        quantities = _Reduced(grid, set(fixed))
        kept_designs: list[Designs] = []
        kept_bounds: list[Column] = []
        count = grid.counts[fixed[-1]]
        kept = 0
        step = max(1, BLOCK // count)
        for start in range(0, len(partial), step):
            children = np.repeat(partial[start : start + step], count, axis=0)
            children[:, fixed[-1]] = np.tile(np.arange(count), len(children) // count)
            children = children[quantities.allowed(children)]
            bound = np.broadcast_to(stage_bound(stage, constraints, quantities.of(children)), len(children))
            rows = np.flatnonzero((bound > known + tolerance) & np.isfinite(bound))
            kept += rows.size
            if kept > most or is_over():
                # The parents' bounds hold for all that is below them.
                return IntervalBound(bound=float(bounds.max()), complete=False, better=None)
            kept_designs.append(children[rows])
            kept_bounds.append(bound[rows])
        partial = np.concatenate(kept_designs)
        bounds = np.concatenate(kept_bounds)
        if not len(partial):
            return IntervalBound(bound=known, complete=True, better=None)
    scores = grid.scores(stage, constraints, partial)
    row = int(scores.argmax())
    if scores[row] <= known:
        return IntervalBound(bound=known, complete=True, better=None)
    return IntervalBound(bound=float(scores[row]), complete=True, better=partial[row])


class _Reduced:
    """The tables with the least and the largest entry over the factors that are not fixed."""

    def __init__(self, grid: LevelGrid, fixed: set[int]) -> None:
        self._grid = grid
        self._fixed = fixed
        self._tables: dict[str, list[tuple[tuple[int, ...], Column, Column]]] = {}
        self._slack: dict[str, float] = {}
        for measure, parts in grid.tables.items():
            reduced = []
            for places, entries in parts:
                over = tuple(axis for axis, place in enumerate(places) if place not in fixed)
                low = np.where(np.isnan(entries), np.inf, entries).min(axis=over)
                high = np.where(np.isnan(entries), -np.inf, entries).max(axis=over)
                reduced.append((tuple(place for place in places if place in fixed), low, high))
            self._tables[measure] = reduced
            largest = [float(np.abs(entries[~np.isnan(entries)]).max(initial=0.0)) for _, entries in parts]
            self._slack[measure] = ROUNDING * sum(largest)

    def allowed(self, designs: Designs) -> NDArray[np.bool_]:
        """Mask of the partial designs that no rule on fixed factors excludes."""
        kept = np.ones(len(designs), dtype=np.bool_)
        for places, excluded in self._grid.rules:
            if self._fixed.issuperset(places):
                kept &= ~excluded[tuple(designs[:, place] for place in places)]
        return kept

    def of(self, designs: Designs) -> Quantities:
        """The intervals of partial designs, each measure evaluated once."""
        return lru_cache(maxsize=None)(lambda measure: self.interval(measure, designs))

    def interval(self, measure: str, designs: Designs) -> Intervals:
        """The interval of a measure for each partial design."""
        lows, highs = [], []
        for places, low, high in self._tables[measure]:
            at = tuple(designs[:, place] for place in places)
            lows.append(np.broadcast_to(low[at], len(designs)))
            highs.append(np.broadcast_to(high[at], len(designs)))
        unknown = np.zeros(len(designs), dtype=np.bool_)
        for low in lows:
            unknown |= np.isinf(low)
        low = compensated_sum([np.where(unknown, 0.0, one) for one in lows], len(designs)) - self._slack[measure]
        high = compensated_sum([np.where(unknown, 0.0, one) for one in highs], len(designs)) + self._slack[measure]
        return Intervals(low=np.where(unknown, np.inf, low), high=np.where(unknown, -np.inf, high))


def _order(grid: LevelGrid) -> tuple[int, ...]:
    """The factors so that as many tables as possible are decided early."""
    scopes = [set(places) for parts in grid.tables.values() for places, _ in parts]
    scopes += [set(places) for places, _ in grid.rules]
    left, order = set(range(len(grid.counts))), list[int]()
    while left:
        fixed = set(order)
        order.append(
            min(
                left,
                key=lambda one: (
                    -sum(scope <= fixed | {one} for scope in scopes if one in scope),
                    -sum(one in scope for scope in scopes),
                    one,
                ),
            )
        )
        left.remove(order[-1])
    return tuple(order)
