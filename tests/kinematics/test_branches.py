"""The choice of branches against trying every choice."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rgss.errors import DefinitionError
from rgss.kinematics import choose_branches

CYCLE = [(0, 1), (1, 2), (2, 0)]


def travel(choice, legs, weights=None):
    scale = np.ones(choice[0].shape) if weights is None else np.array(weights)
    return sum(float(np.linalg.norm((choice[one] - choice[other]) * scale)) for one, other in legs)


def drawn(seed, sizes, joints=3):
    generator = np.random.default_rng(seed)
    return [list(generator.uniform(-3.0, 3.0, (size, joints))) for size in sizes]


@given(
    seed=st.integers(0, 10_000),
    sizes=st.lists(st.integers(1, 4), min_size=2, max_size=4),
    closed=st.booleans(),
)
def test_the_choice_is_the_cheapest_of_all(seed, sizes, closed):
    candidates = drawn(seed, sizes)
    legs = list(itertools.pairwise(range(len(sizes)))) + ([(len(sizes) - 1, 0)] if closed else [])
    chosen = choose_branches(candidates, legs=legs)
    best = min(travel(choice, legs) for choice in itertools.product(*candidates))
    assert travel(chosen, legs) == pytest.approx(best, abs=1e-8)


@given(seed=st.integers(0, 10_000))
def test_weights_bounds_and_home_enter_the_cost(seed):
    candidates = drawn(seed, (3, 4, 3))
    weights, home, bound = (1.0, 0.2, 3.0), np.array([0.5, -0.5, 0.0]), {(0, 1): 2.5}

    def cost(choice):
        if np.max(np.abs(choice[0] - choice[1])) > 2.5:
            return np.inf
        away = sum(float(np.linalg.norm((q - home) * weights)) for q in choice)
        return travel(choice, CYCLE, weights) + 0.3 * away

    chosen = choose_branches(
        candidates, legs=CYCLE, weights=weights, home=home, home_weight=0.3, largest_travel_rad=bound
    )
    best = min(cost(choice) for choice in itertools.product(*candidates))
    if np.isfinite(best):
        assert cost(chosen) == pytest.approx(best, abs=1e-8)
    else:
        assert chosen is None


def test_the_waypoints_need_not_be_numbered_along_the_legs():
    candidates = drawn(7, (3, 3, 3, 3))
    legs = [(2, 0), (0, 3), (3, 1), (1, 2)]
    chosen = choose_branches(candidates, legs=legs)
    best = min(travel(choice, legs) for choice in itertools.product(*candidates))
    assert travel(chosen, legs) == pytest.approx(best, abs=1e-8)


def test_ties_go_to_the_earlier_candidate():
    same = [np.zeros(2), np.zeros(2) + 1e-13, np.zeros(2)]
    chosen = choose_branches([same, same, same], legs=CYCLE)
    assert all(q is not None and np.array_equal(q, same[0]) for q in chosen)


def test_home_decides_between_cycles_that_are_whole_turns_apart():
    turn = 2 * np.pi
    waypoints = [[np.array([angle - turn]), np.array([angle])] for angle in (3.0, 3.2, 3.4)]
    near_zero = choose_branches(waypoints, legs=CYCLE, home=[0.0])
    assert [float(q[0]) for q in near_zero] == pytest.approx([3.0 - turn, 3.2 - turn, 3.4 - turn])
    far = choose_branches(waypoints, legs=CYCLE, home=[4.0])
    assert [float(q[0]) for q in far] == pytest.approx([3.0, 3.2, 3.4])


def test_a_waypoint_without_a_candidate_has_no_choice():
    assert choose_branches([[np.zeros(2)], [], [np.zeros(2)]], legs=CYCLE) is None


def test_bounds_that_nothing_keeps_have_no_choice():
    candidates = [[np.zeros(2)], [np.ones(2)], [np.zeros(2)]]
    assert choose_branches(candidates, legs=CYCLE, largest_travel_rad={(1, 2): 0.5}) is None


@pytest.mark.parametrize(
    "legs",
    [[], [(0, 1)], [(0, 1), (2, 0)], [(0, 1), (1, 0), (0, 2)], [(0, 1), (1, 3)]],
    ids=["none", "one left out", "broken", "one twice", "unknown"],
)
def test_legs_that_are_no_chain_over_all_waypoints(legs):
    with pytest.raises(DefinitionError) as caught:
        choose_branches([[np.zeros(2)]] * 3, legs=legs)
    assert caught.value.message == f"the legs must form a chain or cycle over all 3 waypoints, got {legs}"
    assert caught.value.hint == "start each leg where the previous one ends, and visit every waypoint once"
