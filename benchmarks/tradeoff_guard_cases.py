"""Random level problems of 10⁴ to 10⁶ combinations and portfolios, each with its brute force.

Shares nothing with the package but the data: every combination is a point of a grid, every measure and value
an array over it. Used by ``benchmarks/tradeoff_guard.py`` and by the tests.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rgss.tradeoff import (
    AdditiveValue,
    Aim,
    Alternative,
    Comparison,
    ElicitedOrder,
    EpsilonConstraint,
    Incompatibility,
    LevelFactor,
    LevelProblem,
    LevelSpace,
    LevelTable,
    Lexicographic,
    MinimaxRegret,
    PiecewiseValue,
    PortfolioAim,
    PortfolioProblem,
    PortfolioTask,
    TargetValue,
    Tchebycheff,
    Threshold,
    TradeProblem,
    WeightBounds,
    Weighting,
)

PROGRAMS = ("additive", "tchebycheff", "lexicographic", "epsilon_constraint", "minimax_regret")
NAMES = "abc"
SMALLEST, LARGEST = 1e4, 1e6
"""So many combinations the random level problems have."""

EQUAL = 1e-9

Grid = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class LevelCase:
    """A level problem; whether a design is feasible at all; and by how much a design misses the best."""

    problem: LevelProblem
    any_feasible: bool
    missed_by: Callable[[int], float | None]


@dataclass(frozen=True, slots=True)
class PortfolioCase:
    """A portfolio problem, with the value of each design in each task, -1 where it does not serve."""

    problem: PortfolioProblem
    values: Grid
    weights: Grid


def seven_factors(seed: int) -> LevelCase:
    """Seven factors of six levels, additive or Tchebycheff, sums of two-factor tables, one threshold."""
    rng = np.random.default_rng(seed)
    return _case(rng, (6,) * 7, "additive" if seed % 2 == 0 else "tchebycheff", plain=True)


def small_case(seed: int, counts: tuple[int, ...], program: str) -> LevelCase:
    """A problem of the same kind with other numbers of levels."""
    return _case(np.random.default_rng(seed), counts, program, plain=True)


def level_case(seed: int, *, largest: float = LARGEST) -> LevelCase:
    """A random level problem: rules, unknown entries, coarse tables with ties, tight and impossible demands.

    The number of combinations is log-uniform from `SMALLEST` to the largest.
    """
    rng = np.random.default_rng([seed, 7])
    return _case(rng, _counts(rng, largest), PROGRAMS[seed % len(PROGRAMS)], plain=False)


def _counts(rng: np.random.Generator, largest: float) -> tuple[int, ...]:
    """Numbers of levels from 2 to 7 whose product is within a tenth of a number that is log-uniform."""
    aim = math.exp(rng.uniform(math.log(SMALLEST), math.log(largest)))
    low, high = max(SMALLEST, 0.9 * aim), min(largest, 1.1 * aim)
    while True:
        counts: list[int] = []
        while math.prod(counts) < low:
            counts.append(int(rng.integers(2, 8)))
        if math.prod(counts) <= high:
            return tuple(counts)


def _case(rng: np.random.Generator, counts: tuple[int, ...], program: str, *, plain: bool) -> LevelCase:
    space = LevelSpace(
        factors=tuple(
            LevelFactor(id=f"f{place}", levels=tuple(f"l{level}" for level in range(count)))
            for place, count in enumerate(counts)
        ),
        rules=() if plain or rng.random() < 0.5 else (_rule(rng, counts),),
    )
    allowed = np.ones(counts, dtype=bool)
    for rule in space.rules:
        for combination in rule.combinations:
            index: list[Any] = [slice(None)] * len(counts)
            for factor, level in zip(rule.factors, combination, strict=True):
                index[int(factor[1:])] = int(level[1:])
            allowed[tuple(index)] = False
    tables, grids = {}, {}
    coarse = not plain and rng.random() < 0.25
    for name in NAMES:
        tables[name], grids[name] = _tables(rng, counts, coarse=coarse, unknown=not plain and rng.random() < 0.15)
    functions = tuple(_function(rng, name, grids[name], plain=plain) for name in NAMES)
    shares = rng.dirichlet(np.ones(len(NAMES)))
    weights = {name: float(share) for name, share in zip(NAMES, shares / shares.sum(), strict=True)}
    thresholds = []
    for number in range(1 if plain else int(rng.integers(0, 4))):
        name = str(rng.choice(list(NAMES)))
        share = rng.uniform(0.3, 0.7) if plain else rng.choice([0.02, 0.3, 0.5, 0.9, 0.999])
        thresholds.append(_threshold(rng, f"R-{number}", name, grids[name], float(share)))
    kind = _program(rng, program, grids)
    bounds = WeightBounds()
    if program == "minimax_regret" and rng.random() < 0.5:
        order = sorted(NAMES, key=lambda name: -weights[name])
        bounds = WeightBounds(
            orders=tuple(
                ElicitedOrder(heavier=one, heavier_measures=(one,), lighter=other, lighter_measures=(other,))
                for one, other in itertools.pairwise(order)
            )
        )
    problem = LevelProblem(
        space=space,
        tables=tables,
        thresholds=tuple(thresholds),
        value_functions=functions,
        weighting=Weighting(weights=weights),
        program=kind,
        weight_bounds=bounds,
    )
    feasible = allowed.copy()
    for name in NAMES:
        feasible &= ~np.isnan(grids[name]) | (name not in _needed(problem))
    limits = kind.bounds if isinstance(kind, EpsilonConstraint) else ()
    for threshold in (*thresholds, *limits):
        feasible &= _within(grids[threshold.measure], threshold.comparison.value, threshold.value)
    values = {name: _valued(function, grids[name]) for name, function in zip(NAMES, functions, strict=True)}
    flat = {name: grid.ravel() for name, grid in grids.items()}
    missed = _missed(problem, flat, {name: one.ravel() for name, one in values.items()}, feasible.ravel())
    return LevelCase(problem=problem, any_feasible=bool(feasible.any()), missed_by=missed)


def _needed(problem: LevelProblem) -> set[str]:
    """The measures that must be known."""
    program = problem.program
    if isinstance(program, Lexicographic):
        return {aim.measure for aim in program.aims} | {one.measure for one in problem.thresholds}
    return set(NAMES)


def _tables(
    rng: np.random.Generator, counts: tuple[int, ...], *, coarse: bool, unknown: bool
) -> tuple[tuple[LevelTable[float | None], ...], Grid]:
    tables, grid = [], np.zeros(counts)
    for part in range(int(rng.integers(2, 6))):
        one, other = sorted(rng.choice(len(counts), 2, replace=False).tolist())
        entries = rng.normal(size=(counts[one], counts[other]))
        if coarse:
            entries = np.round(entries * 2.0) / 2.0
        if unknown and part == 0:
            entries[rng.random(entries.shape) < 0.2] = np.nan
        shape = [1] * len(counts)
        shape[one], shape[other] = counts[one], counts[other]
        grid = grid + entries.reshape(shape)
        tables.append(
            LevelTable(
                factors=(f"f{one}", f"f{other}"),
                entries={
                    (f"l{first}", f"l{second}"): None if np.isnan(entry) else float(entry)
                    for (first, second), entry in np.ndenumerate(entries)
                },
            )
        )
    return tuple(tables), grid


def _rule(rng: np.random.Generator, counts: tuple[int, ...]) -> Incompatibility:
    one, other = sorted(rng.choice(len(counts), 2, replace=False).tolist())
    pairs = [(f"l{first}", f"l{second}") for first in range(counts[one]) for second in range(counts[other])]
    rows = rng.choice(len(pairs), int(rng.integers(1, len(pairs))), replace=False)
    return Incompatibility(
        id="rule", factors=(f"f{one}", f"f{other}"), combinations=frozenset(pairs[row] for row in rows)
    )


def _quantiles(grid: Grid, shares: float | list[float]) -> Any:
    """Quantiles of what is known; 0 where nothing is, so that a measure may be unknown of every combination."""
    known = grid[~np.isnan(grid)]
    return np.quantile(known if known.size else np.zeros(1), shares)


def _function(rng: np.random.Generator, name: str, grid: Grid, *, plain: bool) -> PiecewiseValue | TargetValue:
    low, high = (float(one) for one in _quantiles(grid, [0.05, 0.95]))
    if high - low < 0.1:
        low, high = low - 1.0, low + 1.0
    if not plain and rng.random() < 0.2:
        return TargetValue(measure=name, target=low + 0.4 * (high - low), too_low=low, too_high=high)
    if rng.random() < 0.5:
        low, high = high, low
    points = ((low + 0.3 * (high - low), 0.5), (low + 0.6 * (high - low), 0.7))
    return PiecewiseValue(measure=name, worst=low, best=high, interior=points)


def _threshold(rng: np.random.Generator, requirement: str, name: str, grid: Grid, share: float) -> Threshold:
    at_least = rng.random() < 0.5
    return Threshold(
        requirement=requirement,
        measure=name,
        comparison=Comparison.AT_LEAST if at_least else Comparison.AT_MOST,
        value=float(_quantiles(grid, share if at_least else 1.0 - share)),
        unit="1",
    )


def _program(rng: np.random.Generator, name: str, grids: dict[str, Grid]) -> Any:
    if name == "tchebycheff":
        return Tchebycheff()
    if name == "lexicographic":
        order = rng.permutation(list(NAMES)).tolist()
        return Lexicographic(
            aims=tuple(
                Aim(
                    measure=one,
                    sense=Comparison.AT_LEAST if rng.random() < 0.5 else Comparison.AT_MOST,
                    absolute=float(rng.choice([0.0, 0.5, 1.5])),
                )
                for one in order
            )
        )
    if name == "epsilon_constraint":
        aim, other = rng.permutation(list(NAMES)).tolist()[:2]
        return EpsilonConstraint(
            aim=Aim(measure=aim, sense=Comparison.AT_LEAST if rng.random() < 0.5 else Comparison.AT_MOST),
            bounds=(_threshold(rng, f"limit:{other}", other, grids[other], float(rng.choice([0.3, 0.8, 0.99]))),),
        )
    return MinimaxRegret() if name == "minimax_regret" else AdditiveValue()


def _valued(function: PiecewiseValue | TargetValue, grid: Grid) -> Grid:
    points = (
        [(function.too_low, 0.0), (function.target, 1.0), (function.too_high, 0.0)]
        if isinstance(function, TargetValue)
        else [(function.worst, 0.0), *function.interior, (function.best, 1.0)]
    )
    points.sort()
    found = np.full(grid.shape, points[0][1])
    for (start, before), (end, after) in itertools.pairwise(points):
        within = (grid > start) & (grid <= end)
        found[within] = before + (after - before) * (grid[within] - start) / (end - start)
    found[grid > points[-1][0]] = points[-1][1]
    found[np.isnan(grid)] = 0.0
    return found


def _within(grid: Grid, sense: str, limit: float) -> NDArray[np.bool_]:
    slack = EQUAL * abs(limit)
    kept = grid >= limit - slack if sense == ">=" else grid <= limit + slack
    return np.asarray(kept)


def _missed(
    problem: LevelProblem, quantities: dict[str, Grid], values: dict[str, Grid], feasible: NDArray[np.bool_]
) -> Callable[[int], float | None]:
    """By how much a design misses the best; None if it is not feasible or not kept by an earlier stage."""
    program, weights = problem.program, problem.weighting.weights
    kept = feasible
    additive = sum((weights[name] * values[name] for name in NAMES), start=np.zeros(feasible.shape))
    if isinstance(program, Lexicographic):
        for aim in program.aims:
            score = quantities[aim.measure] * (1.0 if aim.sense is Comparison.AT_LEAST else -1.0)
            if kept.any() and aim is not program.aims[-1]:
                best = score[kept].max()
                kept = kept & (score >= best - aim.absolute - EQUAL * max(1.0, abs(best)))
    elif isinstance(program, EpsilonConstraint):
        aim = program.aim
        first = quantities[aim.measure] * (1.0 if aim.sense is Comparison.AT_LEAST else -1.0)
        if kept.any():
            kept = kept & (first >= first[kept].max() - EQUAL * max(1.0, abs(first[kept].max())))
        score = additive
    elif isinstance(program, Tchebycheff):
        short = np.stack([1.0 - values[name] for name in NAMES])
        share = np.array([weights[name] for name in NAMES])[:, None]
        score = -((share * short).max(axis=0) + program.augmentation * short.sum(axis=0))
    elif isinstance(program, MinimaxRegret):
        score = -_greatest_regret(problem, values, feasible)
    else:
        score = additive
    best = float(score[kept].max()) if kept.any() else math.nan
    chosen, final = score, kept

    def missed(row: int) -> float | None:
        return (best - float(chosen[row])) / max(1.0, abs(best)) if final[row] else None

    return missed


def _greatest_regret(problem: LevelProblem, values: dict[str, Grid], feasible: NDArray[np.bool_]) -> Grid:
    """Greatest regret over the corners of the admitted weights."""
    corners = np.eye(len(NAMES))
    if problem.weight_bounds.orders:
        order = [problem.weight_bounds.orders[0].heavier, *(one.lighter for one in problem.weight_bounds.orders)]
        corners = np.zeros((len(NAMES), len(NAMES)))
        for count in range(1, len(NAMES) + 1):
            for name in order[:count]:
                corners[count - 1, NAMES.index(name)] = 1.0 / count
    columns = np.stack([values[name] for name in NAMES])
    worst = np.full(feasible.shape, -np.inf)
    for corner in corners:
        one = corner @ columns
        worst = np.maximum(worst, (one[feasible].max() if feasible.any() else 0.0) - one)
    return worst


def portfolio_case(seed: int) -> PortfolioCase:
    """A random portfolio: ties, designs that do not serve a task, tasks of no weight, mean or worst."""
    rng = np.random.default_rng([seed, 11])
    shape = (int(rng.choice([6, 20, 40, 110])), int(rng.integers(2, 13)))
    most = 4 if shape[0] < 40 else 3 if shape[0] < 110 else 2
    if rng.random() < 0.1:
        shape, most = (40, 10), 4
    values = rng.random(shape)
    kind = rng.choice(["uniform", "coarse", "holes", "holes"])
    if kind == "coarse":
        values = np.round(values * 4.0) / 4.0
    if kind == "holes":
        values[rng.random(shape) < rng.choice([0.2, 0.5, 0.8])] = -1.0
    weights = rng.dirichlet(np.ones(shape[1]))
    if shape[1] > 2 and rng.random() < 0.2:
        weights[0] = 0.0
    weights = weights / weights.sum()
    tasks = tuple(
        PortfolioTask(
            name=f"task {task}",
            weight=float(weights[task]),
            problem=TradeProblem(
                alternatives=tuple(
                    Alternative(variant=row + 1, measures={"a": float(values[row, task])}) for row in range(shape[0])
                ),
                thresholds=(
                    Threshold(requirement="R", measure="a", comparison=Comparison.AT_LEAST, value=0.0, unit="1"),
                ),
                value_functions=(PiecewiseValue(measure="a", worst=0.0, best=1.0),),
                weighting=Weighting(weights={"a": 1.0}),
            ),
        )
        for task in range(shape[1])
    )
    aim = PortfolioAim.MEAN if rng.random() < 0.5 else PortfolioAim.WORST
    return PortfolioCase(problem=PortfolioProblem(tasks=tasks, at_most=most, aim=aim), values=values, weights=weights)
