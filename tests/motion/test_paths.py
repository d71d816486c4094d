"""Polylines and where they are checked."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rgss.motion import JointPath, path_length, segment_states
from rgss.motion.paths import coarse_to_fine
from tests.fixtures.planned_paths import path_states


def test_length_is_the_sum_of_the_steps():
    assert path_length([[0.0, 0.0], [3.0, 4.0], [3.0, 5.0]]) == pytest.approx(6.0)
    assert path_length([[1.0, 2.0]]) == 0.0


def test_a_path_cannot_be_changed():
    points = np.zeros((2, 6))
    path = JointPath(points)
    points[0, 0] = 1.0
    assert path.points_rad[0, 0] == 0.0
    with pytest.raises(ValueError, match="read-only"):
        path.points_rad[0, 0] = 1.0


@given(length=st.floats(0.0, 20.0), resolution=st.floats(0.005, 1.0), density=st.integers(1, 5))
def test_states_of_a_segment_are_close_enough_and_end_at_its_end(length, resolution, density):
    start, end = np.zeros(3), np.array([0.0, length, 0.0])
    states = segment_states(start, end, resolution, density=density)
    steps = np.diff(np.vstack([start, states]), axis=0)
    assert np.all(np.linalg.norm(steps, axis=1) <= resolution / density * (1 + 1e-9))
    assert np.array_equal(states[-1], end)


def test_denser_states_hold_the_others():
    start, end = np.array([0.1, 0.2]), np.array([1.3, -0.7])
    coarse, fine = segment_states(start, end, 0.1), segment_states(start, end, 0.1, density=4)
    assert fine[3::4] == pytest.approx(coarse, abs=1e-15)


@given(count=st.integers(0, 300))
def test_coarse_to_fine_is_every_index_once_the_last_first(count):
    order = coarse_to_fine(count)
    assert sorted(order) == list(range(count))
    assert order[:1] == ((count - 1,) if count else ())


def test_coarse_to_fine_finds_the_middle_early():
    assert coarse_to_fine(8)[:4] == (7, 3, 1, 5)


def test_the_states_of_a_path_are_its_first_corner_and_those_of_its_segments():
    points = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]])
    states = [tuple(state) for state in path_states(points, 0.25).tolist()]
    assert states == [(0, 0), *((x, 0) for x in (0.25, 0.5, 0.75, 1.0)), *((1, y) for y in (0.25, 0.5, 0.75, 1.0))]
    assert path_states(points[:1], 0.25).tolist() == [[0.0, 0.0]]


def test_denser_states_of_a_path_hold_the_others():
    points = np.array([[0.0, 0.0], [1.0, 0.3], [0.2, 1.0]])
    coarse, fine = path_states(points, 0.25), path_states(points, 0.25, density=3)
    assert fine[::3] == pytest.approx(coarse, abs=1e-15)
