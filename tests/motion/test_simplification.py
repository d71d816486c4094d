"""Shortening: valid, never longer, within its budget, and the same every time."""

from __future__ import annotations

import numpy as np
import pytest

from rgss.motion import path_length
from rgss.motion.paths import path_states
from rgss.motion.simplification import shorten

RESOLUTION = 0.05


def wandering(seed, corners=8):
    """A path from one side of the wall to the other through the doorway, with detours."""
    generator = np.random.default_rng(seed)
    before = generator.uniform(-2.0, 2.0, (corners, 6))
    after = generator.uniform(-2.0, 2.0, (corners, 6))
    before[:, 0], after[:, 0] = -1.0 - generator.random(corners), 1.0 + generator.random(corners)
    doorway = np.array([[-0.3, 1.5, 0.0, 0.0, 0.0, 0.0], [0.3, 1.5, 0.0, 0.0, 0.0, 0.0]])
    return np.vstack([before, doorway, after])


def shortened(wall, path, *, seed=0, budget=1000):
    return shorten(
        path,
        wall,
        generator=np.random.default_rng(seed),
        budget_checks=budget,
        resolution_rad=RESOLUTION,
    )


@pytest.mark.parametrize("seed", range(12))
def test_the_result_is_valid_shorter_and_keeps_its_ends(wall, seed):
    path = wandering(seed)
    result, _ = shortened(wall, path, seed=seed)
    assert all(map(wall.is_valid, path_states(result, RESOLUTION, density=4)))
    assert path_length(result) < 0.6 * path_length(path)
    assert np.array_equal(result[0], path[0])
    assert np.array_equal(result[-1], path[-1])


class Batched:
    """A validity that answers for many states at once."""

    def __init__(self, validity):
        self._validity = validity

    def is_valid(self, q):
        raise AssertionError("one state at a time")

    def first_invalid_between(self, qs):
        return next((index for index, q in enumerate(qs) if not self._validity.is_valid(q)), None)


@pytest.mark.parametrize("budget", [3, 40, 500, 2500])
def test_many_states_at_once_give_what_one_after_another_gives(wall, budget):
    one, other = shortened(wall, wandering(6), budget=budget), shortened(Batched(wall), wandering(6), budget=budget)
    assert np.array_equal(one[0], other[0])
    assert one[1] == other[1]


@pytest.mark.parametrize("budget", [0, 1, 17, 200, 1000, 5000])
def test_the_count_is_exact_and_the_budget_is_kept(wall, budget):
    path = wandering(1)
    result, spent = shortened(wall, path, budget=budget)
    assert spent == wall.calls
    final = 4 * sum(int(np.ceil(np.linalg.norm(step) / RESOLUTION)) for step in np.diff(result, axis=0)) + 1
    assert spent <= budget + 3 * final
    if budget == 0:
        assert (result is path, spent) == (True, 0)


def test_more_budget_makes_no_longer_path(wall):
    path = wandering(2)
    lengths = [path_length(shortened(wall, path, budget=budget)[0]) for budget in (100, 300, 1000, 3000)]
    assert lengths == sorted(lengths, reverse=True)


def test_the_same_generator_gives_the_same_path(wall):
    one, other = (shortened(wall, wandering(3), seed=5) for _ in range(2))
    assert np.array_equal(one[0], other[0])
    assert one[1] == other[1]


def test_in_open_space_the_straight_segment_is_left(anything):
    result, _ = shortened(anything, wandering(4), budget=2000)
    assert len(result) == 2


def test_a_straight_path_is_left_as_it_is(wall):
    path = np.array([[-2.0, 0.0, 0.0, 0.0, 0.0, 0.0], [-1.0, 0.0, 0.0, 0.0, 0.0, 0.0]])
    result, _ = shortened(wall, path)
    assert np.array_equal(result, path)


def test_repeated_points_do_no_harm(wall):
    path = np.repeat(wandering(5), 2, axis=0)
    result, _ = shortened(wall, path)
    assert path_length(result) < path_length(path)
    still = np.zeros((3, 6)) - 1.0
    assert path_length(shortened(wall, still)[0]) == 0.0


def test_a_shortcut_that_touches_between_the_checked_states_is_taken_back():
    class ThinPost:
        """Thinner than the resolution: seen by the denser check alone."""

        def is_valid(self, q):
            return not (0.501 < q[0] < 0.509 and abs(q[1]) < 0.2)

    path = np.array([[0.0, 0.0], [0.3, 0.6], [0.7, 0.6], [1.0, 0.0]])
    post = ThinPost()
    straight = path[[0, -1]]
    assert all(map(post.is_valid, path_states(straight, 0.031)))
    assert not all(map(post.is_valid, path_states(straight, 0.031, density=4)))
    result, _ = shorten(path, post, generator=np.random.default_rng(0), budget_checks=2000, resolution_rad=0.031)
    assert all(map(post.is_valid, path_states(result, 0.031, density=4)))
