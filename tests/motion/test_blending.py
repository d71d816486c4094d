"""Rounded corners: smooth, near the polyline, and never in collision when the polyline is not."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest

from rgss.errors import MotionError
from rgss.motion import JointPath, blend

RESOLUTION = 0.02
ELL = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]])


def derivative(path, s, order, step=1e-5):
    """Derivative of the path by central differences of the one below."""
    return (path(s + step, order - 1) - path(s - step, order - 1)) / (2 * step)


def distances_to(points, queries):
    """Distance of each query to a polyline."""
    best = np.full(len(queries), np.inf)
    for start, end in itertools.pairwise(points):
        along = np.clip((queries - start) @ (end - start) / ((end - start) @ (end - start)), 0.0, 1.0)
        best = np.minimum(best, np.linalg.norm(queries - start - along[:, None] * (end - start), axis=1))
    return best


def test_the_ends_are_kept_and_pieces_join(anything, polylines):
    for points in polylines(20):
        path = blend(JointPath(points), anything, resolution_rad=RESOLUTION).path
        assert path(path.breaks[:1])[0] == pytest.approx(points[0], abs=1e-9)
        assert path(path.breaks[-1:])[0] == pytest.approx(points[-1], abs=1e-9)
        inner = path.breaks[1:-1]
        for order in (0, 1, 2):
            before, after = path(inner - 1e-9, order), path(inner + 1e-9, order)
            assert before == pytest.approx(after, abs=1e-4)


def test_derivatives_are_those_of_the_path(anything, polylines):
    for points in polylines(10, seed=1):
        path = blend(JointPath(points), anything, resolution_rad=RESOLUTION).path
        s = np.random.default_rng(0).uniform(path.breaks[0] + 1e-3, path.breaks[-1] - 1e-3, 50)
        s = s[np.min(np.abs(s[:, None] - path.breaks), axis=1) > 1e-4]
        for order in (1, 2):
            assert path(s, order) == pytest.approx(derivative(path, s, order), abs=2e-3)


def test_straight_pieces_have_unit_speed_and_blends_are_near_it(anything, polylines):
    for points in polylines(10, seed=2):
        path = blend(JointPath(points), anything, resolution_rad=RESOLUTION).path
        speed = np.linalg.norm(path(np.linspace(0.0, path.breaks[-1], 500), 1), axis=1)
        assert np.max(speed) <= 1.0 + 1e-9
        assert np.min(speed) > 0.2


@pytest.mark.parametrize("largest", [0.02, 0.1])
def test_blends_stay_near_the_corners(anything, polylines, largest):
    for points in polylines(20, seed=3):
        blended = blend(JointPath(points), anything, resolution_rad=RESOLUTION, largest_deviation_rad=largest)
        states = blended.path(np.linspace(0.0, blended.path.breaks[-1], 800))
        assert np.max(distances_to(points, states)) <= largest + 1e-9
        assert blended.blended + blended.stops == len(points) - 2


def test_the_deviation_is_that_of_the_formula(anything):
    blended = blend(JointPath(ELL), anything, resolution_rad=RESOLUTION, largest_deviation_rad=0.05)
    states = blended.path(np.linspace(0.0, blended.path.breaks[-1], 4001))
    assert np.min(np.linalg.norm(states - ELL[1], axis=1)) == pytest.approx(0.05, abs=1e-4)


def test_a_blend_that_touches_something_is_halved(corner):
    for gap, expected in ((0.5, 0.1), (0.06, 0.05)):
        validity = corner(gap)
        blended = blend(JointPath(ELL), validity, resolution_rad=RESOLUTION)
        states = blended.path(np.linspace(0.0, blended.path.breaks[-1], 4001))
        assert all(validity.is_valid(state) for state in states)
        assert np.min(np.linalg.norm(states - ELL[1], axis=1)) == pytest.approx(expected, rel=0.01)
        assert (blended.is_valid, blended.blended, blended.stops) == (True, 1, 0)


def test_where_no_blend_fits_the_motion_stops_at_the_corner(corner):
    blended = blend(JointPath(ELL), corner(1e-9), resolution_rad=RESOLUTION)
    assert (blended.is_valid, blended.blended, blended.stops) == (True, 0, 1)
    assert blended.path.breaks.tolist() == pytest.approx([0.0, 1.0, 2.0])
    assert blended.path.stops == (0, 1, 2)


def test_one_bad_corner_does_not_touch_the_others(corner):
    points = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [2.0, 1.0], [2.0, 0.4]])
    validity = corner(1e-9)
    blended = blend(JointPath(points), validity, resolution_rad=RESOLUTION)
    assert (blended.blended, blended.stops) == (2, 1)
    assert blended.is_valid


def test_a_path_that_turns_back_stops(anything):
    back = np.array([[0.0, 0.0], [1.0, 0.0], [0.2, 0.05]])
    blended = blend(JointPath(back), anything, resolution_rad=RESOLUTION)
    assert (blended.blended, blended.stops) == (0, 1)


def test_a_polyline_in_collision_is_told(corner):
    class Gate:
        def is_valid(self, q):
            return not 0.45 < q[0] < 0.55

    blended = blend(JointPath(ELL), Gate(), resolution_rad=RESOLUTION)
    assert not blended.is_valid


def test_straight_pieces_are_checked_where_the_polyline_was(corner):
    """A post thinner than the resolution, that no state of the polyline meets, is not found by other states either."""

    class ThinPost:
        def is_valid(self, q):
            return not 0.2005 < q[0] < 0.2095 or q[1] > 0.0

    assert blend(JointPath(ELL), ThinPost(), resolution_rad=RESOLUTION, largest_deviation_rad=0.013).is_valid


def test_checks_are_counted(corner):
    calls = 0

    class Counting:
        def is_valid(self, q):
            nonlocal calls
            calls += 1
            return True

    assert blend(JointPath(ELL), Counting(), resolution_rad=RESOLUTION).checks == calls
    # No state is left unchecked: the path is two long, the blend is checked four times as densely.
    assert calls >= 2.0 / RESOLUTION * 0.9


def test_repeated_and_straight_corners(anything):
    points = np.array([[0.0, 0.0], [0.0, 0.0], [0.5, 0.0], [1.0, 0.0], [1.0, 0.0]])
    blended = blend(JointPath(points), anything, resolution_rad=RESOLUTION)
    assert blended.stops == 0
    assert blended.path.breaks[-1] == pytest.approx(1.0)
    states = blended.path(np.linspace(0.0, 1.0, 11))
    assert states == pytest.approx(np.column_stack([np.linspace(0.0, 1.0, 11), np.zeros(11)]), abs=1e-9)


@pytest.mark.parametrize("points", [[[0.3, 0.4]], [[0.3, 0.4], [0.3, 0.4]]])
def test_a_path_of_no_length_stays_where_it_is(anything, points):
    blended = blend(JointPath(np.array(points)), anything, resolution_rad=RESOLUTION)
    assert blended.is_valid
    assert blended.path(np.array([0.0]))[0] == pytest.approx([0.3, 0.4])


@pytest.mark.parametrize("resolution", [0.0, -1.0, math.nan])
def test_a_resolution_that_is_none(anything, resolution):
    with pytest.raises(MotionError) as caught:
        blend(JointPath(ELL), anything, resolution_rad=resolution)
    assert caught.value.message == f"the resolution must be above 0 rad, got {resolution:g} rad"
    assert caught.value.hint == "give a distance above zero"
