from __future__ import annotations

import importlib.util
import random
import sys
from pathlib import Path

import pytest

from rgss.tradeoff import Alternative, Comparison, PiecewiseValue, Threshold, TradeProblem, Weighting


@pytest.fixture
def seeded():
    """A repeatable random generator for a seed."""

    def build(seed):
        return random.Random(seed)  # noqa: S311 (samples for tests, no secrets)

    return build


@pytest.fixture
def build_problem():
    """A problem from plain tables: measures by variant, (id, measure, comparison, value), (worst, best)."""

    def build(measures, *, thresholds=(), values=None, weights=None, alternatives=None, **more):
        values = values or {"a": (0.0, 1.0)}
        weights = weights or {"a": 1.0}
        return TradeProblem(
            alternatives=alternatives
            or tuple(Alternative(variant=variant, measures=quantities) for variant, quantities in measures.items()),
            thresholds=tuple(
                Threshold(
                    requirement=requirement,
                    measure=measure,
                    comparison=Comparison(comparison),
                    value=value,
                    unit="kg",
                )
                for requirement, measure, comparison, value in thresholds
            ),
            value_functions=tuple(
                PiecewiseValue(measure=measure, worst=worst, best=best) for measure, (worst, best) in values.items()
            ),
            weighting=Weighting(weights=weights),
            **more,
        )

    return build


@pytest.fixture
def payload_and_time(build_problem):
    """Five grippers worked by hand: payload P (0 to 2 kg, more is better), time t (60 to 20 s, less is better).

    With weights 0.25 and 0.75 the values are
        1: P 1.0 -> 0.50, t 40 -> 0.50: 0.125 + 0.375 = 0.5
        2: P 0.4 -> 0.20, t 20 -> 1.00: 0.050 + 0.750 = 0.8    but misses R-1 (P >= 0.8)
        3: P 2.0 -> 1.00, t 50 -> 0.25: 0.250 + 0.1875 = 0.4375
        4: P 1.6 -> 0.80, t 30 -> 0.75: 0.200 + 0.5625 = 0.7625  but misses R-2 (cost <= 100)
        5: P 0.6 -> 0.30, t 60 -> 0.00: 0.075                    and misses R-1 and R-2
    """
    return build_problem(
        {
            5: {"P": 0.6, "t": 60.0, "cost": 150.0},
            1: {"P": 1.0, "t": 40.0, "cost": 100.0},
            2: {"P": 0.4, "t": 20.0, "cost": 80.0},
            4: {"P": 1.6, "t": 30.0, "cost": 120.0},
            3: {"P": 2.0, "t": 50.0, "cost": 90.0},
        },
        thresholds=[("R-1", "P", ">=", 0.8), ("R-2", "cost", "<=", 100.0)],
        values={"P": (0.0, 2.0), "t": (60.0, 20.0)},
        weights={"P": 0.25, "t": 0.75},
    )


def _from_benchmarks(name):
    """A module of the folder benchmarks/, which is no package."""
    path = Path(__file__).parents[2] / "benchmarks" / f"{name}.py"
    spec = importlib.util.spec_from_file_location(name, path)
    module = importlib.util.module_from_spec(spec)
    # Its dataclasses look themselves up by the name of their module.
    sys.modules[name] = module
    spec.loader.exec_module(module)
    return module


@pytest.fixture(scope="session")
def cases():
    """Random trade-offs, as the benchmark of agreement draws them."""
    return _from_benchmarks("tradeoff_cases")


@pytest.fixture(scope="session")
def guard_cases():
    """Random level problems and portfolios with their brute force, as the benchmark of the guard draws them."""
    return _from_benchmarks("tradeoff_guard_cases")


@pytest.fixture(scope="session")
def guard(guard_cases):
    """The benchmark of the guard, which compares decisions with brute force."""
    return _from_benchmarks("tradeoff_guard")


@pytest.fixture(scope="session")
def oracle():
    """The right decisions, from the definitions alone."""
    return _from_benchmarks("tradeoff_oracle")
