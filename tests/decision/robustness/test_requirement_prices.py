"""Prices of requirements, against the choice under every limit by enumeration."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from rgss.decision.robustness.pricing import requirement_prices
from rgss.errors import TradeoffError
from rgss.tradeoff import (
    Alternative,
    Comparison,
    MinimaxRegret,
    PiecewiseValue,
    Scenarios,
    Threshold,
    TradeProblem,
    Weighting,
)
from rgss.tradeoff.problem import tabulated
from rgss.tradeoff.programs import AdditiveValue, Tchebycheff, enumerate_alternatives

PROGRAMS = (
    AdditiveValue(),
    Tchebycheff(reference={}, augmentation=0.001),
    MinimaxRegret(scenarios=Scenarios.REPLICATES),
)


def problem_of(program, seed):
    """Designs of which some have no time in one of three replicates, and one has none at all."""
    draw = np.random.default_rng(seed)
    alternatives = []
    for variant in range(1, 13):
        times = [float(one) for one in draw.uniform(5.0, 20.0, 3)]
        if variant % 3 == 0:
            times[variant % 2] = None
        if variant == 7:
            times = [None] * 3
        known = [one for one in times if one is not None]
        alternatives.append(
            Alternative(
                variant=variant,
                measures={"time": sum(known) / len(known) if known else None, "cost": float(draw.integers(1, 9))},
                samples={"time": tuple(times)},
            )
        )
    return TradeProblem(
        alternatives=tuple(alternatives),
        thresholds=(
            Threshold(requirement="R-1", measure="cost", comparison=Comparison.AT_MOST, value=6.0, unit="USD"),
            Threshold(requirement="R-2", measure="time", comparison=Comparison.AT_MOST, value=15.0, unit="s"),
        ),
        value_functions=(
            PiecewiseValue(measure="time", worst=20.0, best=5.0),
            PiecewiseValue(measure="cost", worst=9.0, best=1.0),
        ),
        weighting=Weighting(weights={"time": 0.6, "cost": 0.4}),
        program=program,
    )


def chosen_at(problem, place, limit):
    thresholds = list(problem.thresholds)
    thresholds[place] = replace(thresholds[place], value=limit)
    try:
        found = enumerate_alternatives(replace(problem, thresholds=tuple(thresholds)))
    except TradeoffError:
        return ()
    return tuple(int(row) for row in np.flatnonzero(found.tied))


@pytest.mark.parametrize("seed", range(6))
@pytest.mark.parametrize("program", PROGRAMS, ids=lambda one: one.name)
def test_each_step_is_the_choice_under_its_limits(program, seed):
    problem = problem_of(program, seed)
    prices = requirement_prices(problem, tabulated(problem.alternatives))
    for place, price in enumerate(prices):
        assert price.steps[-1].best == ()
        for step in price.steps:
            inside = step.tightest if np.isfinite(step.tightest) else step.loosest - 1e-6
            assert step.best == chosen_at(problem, place, inside)
