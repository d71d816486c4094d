"""Alternatives of the same value: one that another surpasses beyond an end of a value function is not chosen."""

from __future__ import annotations

from operator import ge

import numpy as np
import pytest

from rgss.tradeoff import decide
from rgss.tradeoff.problem import PiecewiseValue, TargetValue, surpassed_equals, tabulated

CLIPPED = {"cost": (10.0, 5.0), "time": (30.0, 15.0)}
WEIGHTS = {"cost": 0.5, "time": 0.5}


def test_of_equals_the_one_that_no_other_surpasses(build_problem):
    """All three times are worth 1; the second and third are faster at the same cost, in the same time."""
    problem = build_problem(
        {
            1: {"cost": 6.0, "time": 14.4},
            2: {"cost": 6.0, "time": 12.4},
            3: {"cost": 6.0, "time": 12.4 * (1 + 1e-13)},
            4: {"cost": 9.0, "time": 1.0},
        },
        values=CLIPPED,
        weights=WEIGHTS,
    )
    decision = decide(problem)
    assert (decision.chosen, decision.ties, decision.surpassed) == (2, (2, 3, 1), (1,))
    assert [one.variant for one in decision.ranking] == [2, 3, 1, 4]
    assert decision.certificate.objective == pytest.approx(0.9)
    last = decide(problem, last_of_equals=True)
    assert (last.chosen, last.ties, last.surpassed) == (3, (3, 2, 1), (1,))


def test_a_quantity_surpasses_another_beside_one_of_another_magnitude(build_problem):
    """All three are worth 1; of the same time 2 costs less, by little beside what 3 costs."""
    problem = build_problem(
        {1: {"cost": 2.0, "time": 2e7}, 2: {"cost": 1.0, "time": 2e7}, 3: {"cost": 1e8, "time": 1.0}},
        values={"cost": (1e9, 5e8), "time": (1e9, 5e8)},
        weights=WEIGHTS,
    )
    assert decide(problem).surpassed == (1,)
    paper = build_problem(
        {1: {"cost": 0.1 + 0.2, "time": 1.0}, 2: {"cost": 0.3, "time": 1.0}},
        values={"cost": (1.0, 0.5), "time": (3.0, 2.0)},
        weights=WEIGHTS,
    )
    assert decide(paper).surpassed == ()


def test_quantities_against_each_other_leave_the_smallest_id(build_problem):
    problem = build_problem(
        {1: {"cost": 4.0, "time": 14.0}, 2: {"cost": 3.0, "time": 15.0}}, values=CLIPPED, weights=WEIGHTS
    )
    assert (decide(problem).chosen, decide(problem).surpassed) == (1, ())


def test_a_measure_without_weight_decides_nothing(build_problem):
    problem = build_problem(
        {1: {"cost": 4.0, "time": 14.0, "mass": 9.0}, 2: {"cost": 4.0, "time": 14.0, "mass": 1.0}},
        values=CLIPPED,
        weights=WEIGHTS,
    )
    assert (decide(problem).chosen, decide(problem).surpassed) == (1, ())


@pytest.mark.parametrize("seed", range(20))
def test_the_mask_is_that_of_all_pairs(build_problem, seed):
    generator = np.random.default_rng(seed)
    functions = (
        PiecewiseValue(measure="a", worst=0.0, best=1.0),
        PiecewiseValue(measure="b", worst=9.0, best=8.0),
        TargetValue(measure="c", target=2.0, too_low=0.0, too_high=4.0),
    )
    measures = {
        number: {
            "a": float(generator.integers(1, 5)),
            "b": float(generator.integers(4, 9)),
            "c": float(generator.integers(1, 4)),
        }
        for number in range(1, 25)
    }
    table = tabulated(build_problem(measures, values={"a": (0.0, 1.0)}).alternatives)
    rows = np.flatnonzero(generator.random(24) < 0.8)
    compared = [(one["a"], -one["b"], -abs(one["c"] - 2.0)) for one in measures.values()]
    expected = [
        any(compared[other] != compared[row] and all(map(ge, compared[other], compared[row])) for other in rows)
        for row in rows
    ]
    assert surpassed_equals(table, functions, rows).tolist() == expected


def test_few_alternatives_and_unknown_quantities(build_problem):
    table = tabulated(build_problem({1: {"a": 0.5}, 2: {"a": None}}).alternatives)
    function = PiecewiseValue(measure="a", worst=0.0, best=1.0)
    assert surpassed_equals(table, (function,), np.array([0])).tolist() == [False]
    assert surpassed_equals(table, (function,), np.array([0, 1])).tolist() == [False, False]
    assert surpassed_equals(table, (), np.array([0, 1])).tolist() == [False, False]
