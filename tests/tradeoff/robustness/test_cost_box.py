"""How far all assumed costs may be off together, by hand and against random and extreme boxes."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest

from rgss.errors import TradeoffError
from rgss.tradeoff.robustness.cost_box import BoxProblem, box_range

LINEAR = np.array([[0.0, 1.0], [100.0, 0.0]])
"""A cost of 0 is worth 1, one of 100 nothing."""


def problem_of(**changes):
    """Arms at 40 with a hand at 10, or at 30: worth ½ and 0.7 of a value of which half is cost."""
    given = {
        "base": np.zeros(2),
        "coefficients": np.array([[1.0, 1.0, 0.0], [1.0, 0.0, 1.0]]),
        "assumed": np.array([40.0, 10.0, 30.0]),
        "points": LINEAR,
        "weight": 0.5,
        "rest": np.zeros(2),
        "feasible": np.ones(2, dtype=bool),
        "at_least": -math.inf,
        "at_most": math.inf,
    }
    return BoxProblem(**{**given, **changes})


def test_by_hand():
    """The arm is shared, so only the hands count: 10 (1 + x) = 30 (1 - x) at x = ½."""
    found = box_range(problem_of(), 0)

    assert found.factor == pytest.approx(0.5, abs=1e-8)
    assert found.overtaken_by == (1,)
    assert found.corner == pytest.approx([40.0, 15.0, 15.0], abs=1e-6)


def test_a_threshold_may_be_missed_first():
    """The choice costs 50 and may cost 55: all of its parts may be 10 % dearer."""
    found = box_range(problem_of(at_most=55.0), 0)

    assert found.factor == pytest.approx(0.1, abs=1e-8)
    assert found.overtaken_by == ()
    assert found.corner == pytest.approx([44.0, 11.0, 30.0], abs=1e-6)


def test_a_rival_that_lower_costs_make_feasible():
    """The rival is better but costs 70 where 63 is allowed: 70 (1 - x) = 63 at x = 0.1."""
    found = box_range(problem_of(at_most=63.0, rest=np.array([0.0, 0.4])), 0)

    assert found.factor == pytest.approx(0.1, abs=1e-8)
    assert found.overtaken_by == (1,)


def test_what_no_error_can_change():
    found = box_range(problem_of(rest=np.array([0.6, 0.0])), 0)

    assert (found.factor, found.corner, found.overtaken_by, found.most) == (None, None, (), 1.0)


def random_problem(seed):
    generator = np.random.default_rng(seed)
    points = [[10.0, 1.0], [20.0, 0.6], [25.0, 0.0]] if seed % 2 else [[5.0, 1.0], [35.0, 0.0]]
    return BoxProblem(
        base=generator.integers(0, 5, 5).astype(float),
        coefficients=generator.integers(0, 3, (5, 4)).astype(float),
        assumed=generator.integers(1, 10, 4).astype(float),
        points=np.array(points),
        weight=0.7,
        rest=generator.random(5) * 0.3,
        feasible=generator.random(5) > 0.1,
        at_least=-math.inf,
        at_most=float(generator.integers(25, 45)),
    )


def totals_of(problem, costs, slack=0.0):
    quantities = problem.base + problem.coefficients @ costs
    worth = problem.rest + problem.weight * np.interp(quantities, problem.points[:, 0], problem.points[:, 1])
    return np.where(problem.feasible & (quantities <= problem.at_most + slack), worth, -1.0)


@pytest.mark.parametrize("seed", range(40))
def test_against_random_and_extreme_points_of_the_box(seed):
    problem = random_problem(seed)
    assumed = totals_of(problem, problem.assumed)
    chosen = int(assumed.argmax())
    if assumed[chosen] < 0.0:
        with pytest.raises(TradeoffError, match="is not the best at the assumed numbers"):
            box_range(problem, chosen)
        return
    found = box_range(problem, chosen)
    factor = 1.0 if found.factor is None else found.factor
    extreme = np.array(list(itertools.product([-1.0, -0.5, 0.0, 0.5, 1.0], repeat=4)))
    inside = np.vstack([extreme, np.random.default_rng(seed).uniform(-1, 1, (1000, 4))]) * factor * (1 - 1e-7)
    for move in inside:
        totals = totals_of(problem, problem.assumed * (1.0 + move))
        assert totals[chosen] >= totals.max() - 1e-9
    if found.factor is not None:
        assert (np.abs(found.corner / problem.assumed - 1.0) <= factor + 1e-6).all()
        if found.overtaken_by:
            # At the corner that is named the rival meets the threshold and is at least as good.
            totals = totals_of(problem, found.corner, slack=1e-5)
            assert totals[chosen] <= totals[list(found.overtaken_by)].min() + 1e-5
        else:
            # A hair beyond it the choice misses the threshold.
            beyond = problem.assumed + (found.corner - problem.assumed) * (1.0 + 1e-6)
            assert totals_of(problem, beyond)[chosen] == -1.0


def test_a_choice_that_is_not_best():
    with pytest.raises(TradeoffError, match=r"alternative 1 is not the best at the assumed numbers"):
        box_range(problem_of(), 1)


def test_a_negative_cost():
    with pytest.raises(TradeoffError, match="needs assumed numbers of at least 0"):
        box_range(problem_of(assumed=np.array([40.0, -10.0, 30.0])), 0)
