"""How far the weights are from another decision, against geometry, a second solver and brute force."""

from __future__ import annotations

import numpy as np
import pytest

from rgss.errors import TradeoffError
from rgss.tradeoff.robustness.flip import weight_ranges, weight_shifts
from rgss.tradeoff.weights.weight_set import WeightSet

EVERYONE = np.ones(3, dtype=bool)
CORNERS = np.eye(3)


def test_two_specialists_by_hand():
    """At (0.7, 0.3) the second wins from (0.5, 0.5) on: 0.2 √2 away, 0.2 of weight moved."""
    first, second = weight_shifts(np.eye(2), np.ones(2, dtype=bool), np.array([0.7, 0.3]))

    assert (first.rows, first.distance, first.sum_distance) == ((0,), 0.0, 0.0)
    assert second.rows == (1,)
    assert second.nearest == pytest.approx([0.5, 0.5])
    assert second.distance == pytest.approx(0.2 * np.sqrt(2))
    assert second.nearest_in_sum == pytest.approx([0.5, 0.5])
    assert second.sum_distance == pytest.approx(0.4)


def test_the_nearest_weights_lie_on_the_edge_of_the_simplex():
    """From (0.9, 0.1, 0) the second wins at (½, ½, 0), where the third weight is still 0."""
    shifts = {shift.rows: shift for shift in weight_shifts(CORNERS, EVERYONE, np.array([0.9, 0.1, 0.0]))}

    assert shifts[1,].nearest == pytest.approx([0.5, 0.5, 0.0], abs=1e-9)
    assert shifts[2,].nearest[2] >= shifts[2,].nearest[0] - 1e-9


def test_alternatives_that_are_alike_flip_together():
    values = np.array([[1.0, 0.0], [0.0, 1.0], [0.0, 1.0], [1.0, 0.0]])
    shifts = weight_shifts(values, np.ones(4, dtype=bool), np.array([0.6, 0.4]))

    assert [shift.rows for shift in shifts] == [(0, 3), (1, 2)]


def test_what_can_win_nowhere_is_left_out():
    values = np.vstack([CORNERS, [0.2, 0.2, 0.2]])
    shifts = weight_shifts(values, np.ones(4, dtype=bool), np.array([0.5, 0.3, 0.2]))

    assert [shift.rows for shift in shifts] == [(0,), (1,), (2,)]
    assert weight_shifts(values, np.zeros(4, dtype=bool), np.array([0.5, 0.3, 0.2])) == ()


@pytest.mark.parametrize("seed", range(8))
def test_against_a_second_solver_and_random_weights(seed):
    """Least distances by CVXPY with Clarabel and HiGHS; no random weights are nearer and make another choice."""
    import cvxpy

    generator = np.random.default_rng(seed)
    size = 2 + seed % 4
    values = generator.random((14, size))
    weights = generator.dirichlet(np.ones(size))
    shifts = weight_shifts(values, np.ones(14, dtype=bool), weights)
    chosen = int((values @ weights).argmax())

    assert shifts[0].rows == (chosen,)
    for shift in shifts[1:4]:
        variable = cvxpy.Variable(size)
        wins = (values - values[shift.rows[0]]) @ variable <= 0
        constraints = [variable >= 0, cvxpy.sum(variable) == 1, wins]
        least = cvxpy.Problem(cvxpy.Minimize(cvxpy.norm(variable - weights, 2)), constraints)
        assert shift.distance == pytest.approx(least.solve(solver=cvxpy.CLARABEL), abs=1e-6)
        least = cvxpy.Problem(cvxpy.Minimize(cvxpy.norm(variable - weights, 1)), constraints)
        assert shift.sum_distance == pytest.approx(least.solve(solver=cvxpy.HIGHS), abs=1e-6)
        totals = values @ shift.nearest
        assert totals[shift.rows[0]] == pytest.approx(totals.max(), abs=1e-9)
    flip = shifts[1].distance if len(shifts) > 1 else np.inf
    others = weights + 0.2 * generator.standard_normal((20_000, size))
    others = others[(others >= 0).all(axis=1)]
    others /= others.sum(axis=1, keepdims=True)
    nearer = np.linalg.norm(others - weights, axis=1) < flip * (1 - 1e-9)
    assert ((others[nearer] @ values.T).argmax(axis=1) == chosen).all()


def test_elicited_bounds_keep_the_decision():
    """With w1 >= 0.6 no other specialist can win."""
    bounded = WeightSet.cut(np.array([[-1.0, 0.0, 0.0]]), np.array([-0.6]))
    shifts = weight_shifts(CORNERS, EVERYONE, np.array([0.7, 0.2, 0.1]), among=bounded)

    assert [shift.rows for shift in shifts] == [(0,)]


def test_a_weight_moves_alone_by_hand():
    """At (0.5, 0.3, 0.2) the first specialist leads the second until w1 = w2.

    With w1 = t the others are 0.6 (1 - t) and 0.4 (1 - t): t = 0.6 (1 - t) at t = 3/8. With w2 = t
    the first has 5/7 (1 - t), so t = 5/12; with w3 = t it has 5/8 (1 - t), so t = 5/13.
    """
    ranges = weight_ranges(CORNERS, EVERYONE, np.array([0.5, 0.3, 0.2]), 0)

    assert [(one.low, one.high) for one in ranges] == [
        pytest.approx((3 / 8, 1.0)),
        pytest.approx((0.0, 5 / 12)),
        pytest.approx((0.0, 5 / 13)),
    ]
    assert [(one.below, one.above) for one in ranges] == [((1,), ()), ((), (1,)), ((), (2,))]


@pytest.mark.parametrize("seed", range(6))
def test_a_weight_moves_alone_against_a_fine_walk(seed):
    generator = np.random.default_rng(seed)
    values, weights = generator.random((20, 4)), generator.dirichlet(np.ones(4))
    chosen = int((values @ weights).argmax())
    for place, one in enumerate(weight_ranges(values, np.ones(20, dtype=bool), weights, chosen)):
        others = np.delete(np.arange(4), place)
        for t in np.linspace(0.0, 1.0, 2001):
            moved = np.empty(4)
            moved[place] = t
            moved[others] = (1.0 - t) * weights[others] / weights[others].sum()
            wins = (values @ moved).argmax() == chosen
            if one.low + 1e-9 < t < one.high - 1e-9:
                assert wins
        for end, winners, step in ((one.low, one.below, -1e-6), (one.high, one.above, 1e-6)):
            if winners:
                moved = np.empty(4)
                moved[place] = end + step
                moved[others] = (1.0 - moved[place]) * weights[others] / weights[others].sum()
                assert (values @ moved).argmax() in winners


def test_a_tie_that_ends_at_once():
    """The two are equal at (½, ½); the second wins as soon as its weight grows."""
    ranges = weight_ranges(np.eye(2), np.ones(2, dtype=bool), np.array([0.5, 0.5]), 0)

    assert (ranges[0].low, ranges[0].high, ranges[0].below) == (0.5, 1.0, (1,))
    assert (ranges[1].low, ranges[1].high, ranges[1].above) == (0.0, 0.5, (1,))


def test_all_weight_on_one_measure():
    """The others have no proportions to keep and share alike."""
    values = np.array([[1.0, 0.0, 0.2], [0.4, 1.0, 0.2]])
    first, second, third = weight_ranges(values, np.ones(2, dtype=bool), np.array([1.0, 0.0, 0.0]), 0)

    # t + 0.1 (1 - t) = 0.4 t + 0.6 (1 - t) at t = 5/11.
    assert (first.low, first.below) == (pytest.approx(5 / 11), (1,))
    # 1 - t = 0.4 (1 - t) + t at t = 3/8.
    assert (second.high, second.above) == (pytest.approx(3 / 8), (1,))
    assert (third.low, third.high) == (0.0, 1.0)


@pytest.mark.parametrize("weights", [[0.5, 0.6, 0.1], [0.5, 0.5], [1.5, -0.5, 0.0]])
def test_weights_that_are_none(weights):
    with pytest.raises(TradeoffError, match=r"the weights .* do not fit 3 measures \(give one non-negative weight"):
        weight_shifts(CORNERS, EVERYONE, np.array(weights))
