"""Shortening: valid, never longer, within its budget, and the same every time."""

from __future__ import annotations

import numpy as np
import pytest

from rgss.motion import path_length
from rgss.motion.simplification import shorten
from tests.fixtures.planned_paths import path_states

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
    found = shorten(
        path,
        wall,
        generator=np.random.default_rng(seed),
        budget_checks=budget,
        resolution_rad=RESOLUTION,
    )
    return found.corners, found.checks


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
    generator = np.random.default_rng(0)
    result = shorten(path, post, generator=generator, budget_checks=2000, resolution_rad=0.031).corners
    assert all(map(post.is_valid, path_states(result, 0.031, density=4)))


def simplified(wall, path, limit, *, seed=0, budget=1500):
    return shorten(
        path,
        wall,
        generator=np.random.default_rng(seed),
        budget_checks=budget,
        resolution_rad=RESOLUTION,
        limit_checks=limit,
    )


def limited(wall, path, limit, *, seed=0, budget=1500):
    found = simplified(wall, path, limit, seed=seed, budget=budget)
    return found.corners, found.checks


@pytest.mark.parametrize("limit", [0, 1, 40, 300, 700, 1100, 1500, 2000, 3000, 10_000])
def test_the_limit_bounds_the_whole_and_the_result_is_valid(wall, limit):
    for seed in range(12):
        path = wandering(seed)
        wall.calls = 0
        result, spent = limited(wall, path, limit, seed=seed)
        assert spent == wall.calls <= limit
        # The path as found is the planner's own answer for; everything else was checked to the end.
        assert result is path or all(map(wall.is_valid, path_states(result, RESOLUTION, density=4)))
        assert np.array_equal(result, limited(wall, path, limit, seed=seed)[0])


def test_a_limit_that_does_not_bind_changes_nothing(wall):
    for seed in range(12):
        free, spent = limited(wall, wandering(seed), None, seed=seed)
        bound, bound_spent = limited(wall, wandering(seed), 20_000, seed=seed)
        assert np.array_equal(free, bound)
        assert spent == bound_spent


def test_the_final_check_is_kept_back_from_the_limit(wall):
    """Otherwise looking for shortcuts would spend the limit and none of them could be used."""
    lengths = []
    for seed in range(12):
        path = wandering(seed)
        result, spent = limited(wall, path, 1000, seed=seed)
        lengths.append(path_length(result) / path_length(path))
        assert spent <= 1000
    # Where the final check fails there may be none left for the path before.
    assert sum(length < 0.6 for length in lengths) >= 11


def test_shortcuts_are_taken_back_within_the_limit():
    """Thin posts make the final check fail again and again; segments that it has passed are not checked anew."""

    class ThinPosts:
        def is_valid(self, q):
            return not (q[0] % 0.25 < 0.008 and abs(q[1]) < 0.2)

    generator, posts = np.random.default_rng(0), ThinPosts()
    for _ in range(20):
        path = np.column_stack([np.linspace(0.01, 1.99, 12), 0.4 + generator.random(12)])
        path[[0, -1], 1] = 0.0
        path[[0, -1], 0] = 0.1, 1.9
        for limit in (200, 500, 1000, 4000):
            found = shorten(
                path,
                posts,
                generator=np.random.default_rng(1),
                budget_checks=400,
                resolution_rad=0.031,
                limit_checks=limit,
            )
            result = found.corners
            assert found.checks <= limit
            assert result is path or all(map(posts.is_valid, path_states(result, 0.031, density=4)))


@pytest.mark.parametrize("density_of_posts", [0.0, 0.25])
def test_no_limit_from_the_stated_one_on_changes_the_result(wall, density_of_posts):
    """So that the result under another limit is known without another simplification."""

    class Posts:
        def is_valid(self, q):
            inside = density_of_posts and q[1] % density_of_posts < 0.004 and abs(q[2]) < 0.5
            return not inside and wall.is_valid(q)

    validity, known, unknown = Posts(), 0, 0
    limits = [300, 700, 900, 1100, 1300, 1500, 1800, 2200, 3000, None]
    for seed in range(8):
        results = {limit: simplified(validity, wandering(seed), limit, seed=seed) for limit in limits}
        for found in results.values():
            if found.unlimited_from is None:
                unknown += 1
                continue
            known += 1
            others = (limit for limit in limits if limit is None or limit >= found.unlimited_from)
            for limit in (*others, found.unlimited_from):
                other = results.get(limit) or simplified(validity, wandering(seed), limit, seed=seed)
                assert np.array_equal(other.corners, found.corners)
                assert (other.checks, other.unlimited_from) == (found.checks, found.unlimited_from)
    assert known > 8
    assert unknown > 8
