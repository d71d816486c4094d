"""Oracle: the right decision of a random trade-off, from the definitions alone.

Shares nothing with the package but the data: plain loops and NumPy, no solver, none of the package's
arithmetic. Used by ``benchmarks/tradeoff_agreement.py`` and by the tests.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

import numpy as np
from scipy.optimize import brentq

from rgss.tradeoff import (
    AdditiveValue,
    Alternative,
    ChanceBound,
    Comparison,
    Condition,
    EpsilonConstraint,
    ExponentialValue,
    Lexicographic,
    MinimaxRegret,
    PortfolioAim,
    PortfolioProblem,
    Scenarios,
    TailBound,
    TargetValue,
    Tchebycheff,
    TradeProblem,
    ValueFunction,
)

TIE = 1e-9
DIGITS = 6
"""Quantities of equals that agree to so many digits of the largest count as equal."""


@dataclass(frozen=True, slots=True)
class Expected:
    """The right answer: the tied best, the violated demands, and the last objective."""

    tied: tuple[int, ...]
    violated: dict[int, set[str]]
    objective: float | None


def expected(problem: TradeProblem) -> Expected:
    """The right decision of a trade-off."""
    alternatives = sorted(problem.alternatives, key=lambda one: one.variant)
    violated = {one.variant: violations(problem, one) for one in alternatives}
    feasible = [one for one in alternatives if not violated[one.variant]]
    if not feasible:
        return Expected((), violated, None)
    tied, objective = _best(problem, feasible)
    return Expected(tuple(one.variant for one in chosen_first(problem, tied)), violated, objective)


def chosen_first(problem: TradeProblem, tied: list[Alternative]) -> list[Alternative]:
    """The tied by their ids, those last that another of them surpasses: as good in each quantity, and better in one."""
    names = [name for name, weight in problem.weighting.weights.items() if weight > 0.0]

    def goods(one: Alternative) -> list[float]:
        found = []
        for name in names:
            function, quantity = _function(problem, name), one.measures[name]
            largest = max(abs(other.measures[name] or 0.0) for other in tied) or 1.0
            if isinstance(function, TargetValue):
                found.append(round(value_at(function, quantity or 0.0), DIGITS))
            else:
                share = round((quantity or 0.0) / largest, DIGITS)
                found.append(share if function.best > function.worst else -share)  # type: ignore[attr-defined]
        return found

    rows = {one.variant: goods(one) for one in tied}
    surpassed = {
        one
        for one, row in rows.items()
        if any(
            all(more >= less for more, less in zip(other, row, strict=True)) and other != row for other in rows.values()
        )
    }
    return sorted(tied, key=lambda one: (one.variant in surpassed, one.variant))


def violations(problem: TradeProblem, one: Alternative) -> set[str]:
    """The demands that an alternative violates."""
    program, weights = problem.program, problem.weighting.weights
    weighted = [name for name, weight in weights.items() if weight > 0.0]
    limits = program.bounds if isinstance(program, EpsilonConstraint) else ()
    conditions: list[Condition] = [*problem.thresholds, *limits, *problem.risks]
    broken = {condition.requirement for condition in conditions if not holds(condition, one)}
    needed: list[str] = weighted
    if isinstance(program, Lexicographic):
        needed = [aim.measure for aim in program.aims]
    elif isinstance(program, EpsilonConstraint):
        needed = [program.aim.measure, *weighted]
    over_replicates = isinstance(program, MinimaxRegret) and program.scenarios is Scenarios.REPLICATES
    if isinstance(program, MinimaxRegret) and not over_replicates:
        needed = list(weights)
    bounded = {threshold.measure for threshold in (*problem.thresholds, *limits)}
    for name in needed:
        unknown = one.measures[name] is None
        if over_replicates:
            if unknown or None in one.samples.get(name, ()):
                broken.add(f"evidence:{name}")
        elif unknown and name not in bounded:
            broken.add(f"evidence:{name}")
    return broken


def holds(condition: Condition, one: Alternative) -> bool:
    """Whether an alternative meets a condition, by its definition."""
    if isinstance(condition, ChanceBound):
        row = one.samples.get(condition.measure, (one.measures[condition.measure],))
        met = sum(within(entry, condition.comparison, condition.value) for entry in row)
        return met >= condition.probability * len(row) - 1e-9
    if isinstance(condition, TailBound):
        entries = one.samples.get(condition.measure, (one.measures[condition.measure],))
        if None in entries:
            return False
        return within(tail_mean(entries, condition), condition.comparison, condition.value)  # type: ignore[arg-type]
    return within(one.measures[condition.measure], condition.comparison, condition.value)


def tail_mean(entries: Sequence[float], bound: TailBound) -> float:
    """The conditional value at risk, as the minimum over the value at risk (Rockafellar and Uryasev).

    The minimum of that piecewise linear function lies at one of the entries.
    """
    sign = 1 if bound.comparison is Comparison.AT_MOST else -1
    losses = [sign * Fraction(entry) for entry in entries]
    # The share as it is written: 0.9 is nine tenths, not the nearest binary number.
    tail = Fraction(repr(bound.share)) * len(losses)
    return float(sign * min(level + sum(max(loss - level, Fraction(0)) for loss in losses) / tail for level in losses))


def within(quantity: float | None, sense: Comparison, limit: float) -> bool:
    """Whether a quantity keeps a limit; one part in 10⁹ does not matter."""
    if quantity is None:
        return False
    if abs(quantity - limit) <= 1e-9 * max(abs(quantity), abs(limit)):
        return True
    return quantity > limit if sense.value == ">=" else quantity < limit


def value_at(function: ValueFunction, quantity: float) -> float:
    """The value of a quantity."""
    if isinstance(function, ExponentialValue):
        z = min(max((quantity - function.worst) / (function.best - function.worst), 0.0), 1.0)
        half = (function.halfway - function.worst) / (function.best - function.worst)
        if abs(half - 0.5) < 1e-12:
            return z
        rate = brentq(
            lambda r: math.expm1(r * half) / math.expm1(r) - 0.5, *((-99.0, -1e-7) if half < 0.5 else (1e-7, 99.0))
        )
        return math.expm1(rate * z) / math.expm1(rate)
    if isinstance(function, TargetValue):
        if quantity <= function.target:
            return max(0.0, 1.0 - (function.target - quantity) / (function.target - function.too_low))
        return max(0.0, 1.0 - (quantity - function.target) / (function.too_high - function.target))
    points = [(function.worst, 0.0), *function.interior, (function.best, 1.0)]  # type: ignore[attr-defined]
    share = (quantity - function.worst) / (function.best - function.worst)  # type: ignore[attr-defined]
    shares = [((at - function.worst) / (function.best - function.worst), value) for at, value in points]  # type: ignore[attr-defined]
    if share <= 0.0:
        return 0.0
    for (start, low), (end, high) in itertools.pairwise(shares):
        if share < end:
            return low + (high - low) * (share - start) / (end - start)
    return 1.0


def weighted_value(problem: TradeProblem, one: Alternative, weights: dict[str, float] | None = None) -> float:
    """The weighted sum of values."""
    total = []
    for name, weight in (weights or dict(problem.weighting.weights)).items():
        quantity = one.measures[name]
        if weight > 0.0 and quantity is not None:
            total.append(weight * value_at(_function(problem, name), quantity))
    return math.fsum(total)


def _function(problem: TradeProblem, name: str) -> ValueFunction:
    return next(function for function in problem.value_functions if function.measure == name)


def _best(problem: TradeProblem, feasible: list[Alternative]) -> tuple[list[Alternative], float]:
    program = problem.program
    if isinstance(program, AdditiveValue):
        return _top(feasible, [weighted_value(problem, one) for one in feasible])
    if isinstance(program, Lexicographic):
        kept = feasible
        for place, aim in enumerate(program.aims):
            last = place == len(program.aims) - 1
            kept, best = _keep(kept, aim, 0.0 if last else aim.absolute, 0.0 if last else aim.relative)
        return kept, best
    if isinstance(program, EpsilonConstraint):
        kept, _ = _keep(feasible, program.aim, 0.0, 0.0)
        return _top(kept, [weighted_value(problem, one) for one in kept])
    if isinstance(program, Tchebycheff):
        scores = []
        for one in feasible:
            gaps = {
                name: program.reference.get(name, 1.0) - value_at(_function(problem, name), one.measures[name])  # type: ignore[arg-type]
                for name, weight in problem.weighting.weights.items()
                if weight > 0.0
            }
            worst = max(problem.weighting.weights[name] * gap for name, gap in gaps.items())
            scores.append(-(worst + program.augmentation * math.fsum(gaps.values())))
        tied, score = _top(feasible, scores)
        return tied, -score
    table = _scenario_table(problem, feasible)
    regrets = (table.max(axis=0) - table).max(axis=1)
    tied, score = _top(feasible, list(-regrets))
    return tied, -score


def _top(some: list[Alternative], scores: list[float]) -> tuple[list[Alternative], float]:
    best = max(scores)
    return [one for one, score in zip(some, scores, strict=True) if score >= best - TIE], best


def _keep(some: list[Alternative], aim: object, absolute: float, relative: float) -> tuple[list[Alternative], float]:
    more = aim.sense is Comparison.AT_LEAST  # type: ignore[attr-defined]
    quantities = [one.measures[aim.measure] for one in some]  # type: ignore[attr-defined]
    best = max(quantities) if more else min(quantities)  # type: ignore[type-var]
    slack = absolute + relative * abs(best)  # type: ignore[arg-type, operator]
    bound = best - slack if more else best + slack  # type: ignore[operator]
    return [one for one, q in zip(some, quantities, strict=True) if within(q, aim.sense, bound)], best  # type: ignore[attr-defined, return-value]


def _scenario_table(problem: TradeProblem, feasible: list[Alternative]) -> np.ndarray:
    """The value of each alternative in each scenario."""
    weights = dict(problem.weighting.weights)
    names = list(weights)
    if problem.program.scenarios is Scenarios.REPLICATES:  # type: ignore[attr-defined]
        count = max(len(row) for row in feasible[0].samples.values())
        return np.array(
            [
                [
                    math.fsum(
                        weight
                        * value_at(
                            _function(problem, name),
                            one.samples[name][r] if name in one.samples else one.measures[name],
                        )  # type: ignore[arg-type]
                        for name, weight in weights.items()
                        if weight > 0.0
                    )
                    for r in range(count)
                ]
                for one in feasible
            ]
        )
    return np.array(
        [[weighted_value(problem, one, dict(zip(names, w, strict=True))) for w in corners(problem)] for one in feasible]
    )


def corners(problem: TradeProblem) -> list[tuple[float, ...]]:
    """The corners of the admitted weights, by what is known of each kind of bounds."""
    names = list(problem.weighting.weights)
    if problem.weight_bounds.orders:
        # Of w1 >= w2 >= …, the corners weigh the first k alike (Barron and Barrett, 1996).
        first = [problem.weight_bounds.orders[0].heavier] + [order.lighter for order in problem.weight_bounds.orders]
        return [tuple(1.0 / k if first.index(name) < k else 0.0 for name in names) for k in range(1, len(names) + 1)]
    low = dict.fromkeys(names, 0.0) | {each.name: each.least for each in problem.weight_bounds.intervals}
    high = dict.fromkeys(names, 1.0) | {each.name: each.most for each in problem.weight_bounds.intervals}
    found = []
    # Of a box cut by the sum, all weights but one are at an end at every corner.
    for free in names:
        others = [name for name in names if name != free]
        for ends in itertools.product((0, 1), repeat=len(others)):
            weights = {name: (low, high)[end][name] for name, end in zip(others, ends, strict=True)}
            weights[free] = 1.0 - math.fsum(weights.values())
            if low[free] - 1e-12 <= weights[free] <= high[free] + 1e-12:
                found.append(tuple(weights[name] for name in names))
    return found


def expected_portfolio(problem: PortfolioProblem) -> float | None:
    """The best objective of all portfolios of the size, by trying each; None if none serves every task."""
    answers = [(task, expected(task.problem)) for task in problem.tasks]
    variants = [one.variant for one in problem.tasks[0].problem.alternatives]
    group = {variant: str(variant) if problem.groups is None else problem.groups[variant] for variant in variants}
    best = None
    for size in range(1, problem.at_most + 1):
        for members in itertools.combinations(sorted(set(group.values())), size):
            values = []
            for task, answer in answers:
                able = [
                    weighted_value(task.problem, one)
                    for one in task.problem.alternatives
                    if group[one.variant] in members and not answer.violated[one.variant]
                ]
                values.append(max(able) if able else None)
            if None in values:
                continue
            known = [value for value in values if value is not None]
            mean = math.fsum(task.weight * value for task, value in zip(problem.tasks, known, strict=True))
            score = mean if problem.aim is PortfolioAim.MEAN else min(known)
            best = score if best is None else max(best, score)
    return best
