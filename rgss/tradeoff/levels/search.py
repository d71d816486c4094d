"""Primal search over levels: designs that no answer of the solver may fall behind."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from rgss.tradeoff.levels.grid import Designs, LevelGrid
from rgss.tradeoff.levels.stage_bounds import shortfall_of
from rgss.tradeoff.milp import Constraint, Stage
from rgss.tradeoff.problem import Threshold

SAMPLED = 20_000
"""Number of random designs that are evaluated; the best of them are improved."""

STARTS = 24
"""So many designs are improved, beside those that are given."""

MOST_STEPS = 200
MOST_PAIRS = 20_000
"""Pairs of factors are changed together while a design has no more such neighbours."""

Merit = tuple[NDArray[np.float64], NDArray[np.float64]]


def search_levels(
    grid: LevelGrid, stage: Stage, constraints: Sequence[Constraint], starts: Sequence[Designs]
) -> tuple[float, Designs] | None:
    """Find a feasible design of high objective: random sample, then local search.

    Local search goes to the best neighbour, which differs in one factor or two: by the violations first,
    then by the objective. The random numbers have a fixed seed.

    Args:
        grid: The tables.
        stage: The stage.
        constraints: The constraints of every stage.
        starts: Designs to start from as well, shape (f,) each.

    Returns:
        The best objective that was met with its design, shape (f,); None if nothing feasible was met.
    """
    draw = np.random.default_rng(20_000)
    sample = np.stack([draw.integers(0, count, SAMPLED) for count in grid.counts], axis=1)
    merit = _merit(grid, stage, constraints, sample)
    first = sample[_best_first(merit)[:STARTS]]
    best: tuple[float, Designs] | None = None
    moves = _moves(grid)
    for start in [*starts, *first]:
        score, design = _climb(grid, stage, constraints, np.asarray(start, dtype=np.intp), moves)
        if np.isfinite(score) and (best is None or score > best[0]):
            best = (score, design)
    return best


def improve_design(
    grid: LevelGrid, stage: Stage, constraints: Sequence[Constraint], start: Designs
) -> tuple[float, Designs] | None:
    """The local optimum above a design, with its objective; None if it is not feasible. Arguments: `search_levels`."""
    score, design = _climb(grid, stage, constraints, start, _moves(grid))
    return (score, design) if np.isfinite(score) else None


def _climb(
    grid: LevelGrid,
    stage: Stage,
    constraints: Sequence[Constraint],
    design: Designs,
    moves: Sequence[tuple[tuple[int, ...], Designs]],
) -> tuple[float, Designs]:
    """The local optimum above a design."""
    merit = _merit(grid, stage, constraints, design[None, :])
    here = (float(merit[0][0]), float(merit[1][0]))
    for _ in range(MOST_STEPS):
        blocks = []
        for places, levels in moves:
            block = np.repeat(design[None, :], len(levels), axis=0)
            block[:, places] = levels
            blocks.append(block)
        neighbours = np.concatenate(blocks)
        merit = _merit(grid, stage, constraints, neighbours)
        row = int(_best_first(merit)[0])
        there = (float(merit[0][row]), float(merit[1][row]))
        if there[0] > here[0] or (there[0] == here[0] and there[1] <= here[1]):
            break
        here, design = there, neighbours[row]
    return (here[1] if here[0] == 0.0 else -np.inf), design


def _merit(grid: LevelGrid, stage: Stage, constraints: Sequence[Constraint], designs: Designs) -> Merit:
    """Violation of each design, and its objective where it violates nothing."""
    scores = grid.scores(stage, constraints, designs)
    violated = (~grid.allowed(designs)).astype(np.float64)
    quantities = grid.quantities(designs)
    for constraint in (*constraints, *stage.constraints):
        scale = _span(grid, constraint.measure) if isinstance(constraint, Threshold) else 1.0
        violated = violated + shortfall_of(constraint, quantities) / scale
    feasible = np.isfinite(scores)
    # What is infeasible violates something, be it by less than a number can hold.
    tiny = np.finfo(np.float64).tiny
    return np.where(feasible, 0.0, np.maximum(violated, tiny)), np.where(feasible, scores, 0.0)


def _best_first(merit: Merit) -> NDArray[np.intp]:
    return np.lexsort((-merit[1], merit[0]))


def _span(grid: LevelGrid, measure: str) -> float:
    parts = [entries[~np.isnan(entries)] for _, entries in grid.tables[measure]]
    return sum(float(np.ptp(part)) for part in parts if part.size) or 1.0


def _moves(grid: LevelGrid) -> list[tuple[tuple[int, ...], Designs]]:
    """The factors that are changed together, and all their levels."""
    factors = range(len(grid.counts))
    found: list[tuple[tuple[int, ...], Designs]] = [((one,), np.arange(grid.counts[one])[:, None]) for one in factors]
    pairs = [(one, other) for one in factors for other in factors if one < other]
    if sum(grid.counts[one] * grid.counts[other] for one, other in pairs) <= MOST_PAIRS:
        for one, other in pairs:
            levels = np.stack(
                np.unravel_index(
                    np.arange(grid.counts[one] * grid.counts[other]), (grid.counts[one], grid.counts[other])
                ),
                axis=1,
            )
            found.append(((one, other), levels))
    return found
