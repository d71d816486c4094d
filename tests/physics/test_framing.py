"""The framing of a picture: everything in view, as near as that allows, by a pinhole camera of its own."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from rgss.physics.pictures.framing import framed_corners, framing

FIELD_OF_VIEW_RAD = math.radians(36)


def in_picture(points, found, aspect):
    """Positions in a picture from -1 to 1 across and upwards, by the rotation that takes the view onto the x axis."""
    ahead = np.subtract(found.target_m, found.eye_m)
    azimuth, elevation = math.atan2(ahead[1], ahead[0]), math.atan2(ahead[2], math.hypot(ahead[0], ahead[1]))
    turned = Rotation.from_euler("zy", [-azimuth, elevation]).apply(np.asarray(points) - found.eye_m)
    depth, left, up = turned.T
    assert (depth > 0.0).all()
    half = math.tan(FIELD_OF_VIEW_RAD / 2)
    return -left / depth / (half * aspect), up / depth / half


@pytest.mark.parametrize("aspect", [0.5, 4 / 3, 3.0])
@pytest.mark.parametrize(("azimuth_deg", "elevation_deg"), [(215, 25), (230, 8), (10, 60), (-80, -10)])
def test_all_corners_are_in_view_and_the_camera_cannot_be_nearer(aspect, azimuth_deg, elevation_deg):
    points = np.random.default_rng(7).normal(size=(40, 3)) * (0.5, 1.0, 0.3) + (3.0, -1.0, 0.4)
    direction = {"azimuth_rad": math.radians(azimuth_deg), "elevation_rad": math.radians(elevation_deg)}
    found = framing(points, **direction, field_of_view_rad=FIELD_OF_VIEW_RAD, aspect=aspect)
    across, upwards = in_picture(points, found, aspect)
    border = 1.0 / 1.04

    assert max(np.abs(across).max(), np.abs(upwards).max()) == pytest.approx(border)
    # One pair of opposite borders is reached on both sides, the other is free alike on both.
    reached = across if np.abs(across).max() > np.abs(upwards).max() else upwards
    assert (reached.min(), reached.max()) == pytest.approx((-border, border))
    seen_from = np.subtract(found.eye_m, found.target_m)
    assert math.atan2(seen_from[1], seen_from[0]) == pytest.approx(math.remainder(direction["azimuth_rad"], math.tau))
    assert math.asin(seen_from[2] / np.linalg.norm(seen_from)) == pytest.approx(direction["elevation_rad"])


def box(low, high):
    return np.array([low, high], dtype=float)


def test_bodies_near_what_moves_are_in_view_and_those_far_away_are_not():
    moving = box((0, 0, 1), (2, 1, 2))  # a diagonal of 2.45
    beneath, far, wide = box((0.5, 0.2, 0), (1, 0.8, 1)), box((4, 4, 0), (5, 5, 1)), box((-50, 0, 0.9), (50, 1, 1))
    corners = framed_corners(moving, [beneath, far, wide])

    assert len(corners) == 3 * 8
    # A long body is in view for half of the size beside what moves, and a twentieth below it.
    size = math.sqrt(6.0)
    assert corners[:, 0].min() == pytest.approx(-0.5 * size)
    assert corners[:, 0].max() == pytest.approx(2.0 + 0.5 * size)
    assert corners[:, 2].min() == pytest.approx(1.0 - 0.05 * size)
    assert corners[:, 1].max() < 4.0


def test_a_lamp_above_is_in_view_as_high_as_it_is():
    corners = framed_corners(box((0, 0, 1), (2, 1, 2)), [box((1, 0.2, 5), (1.1, 0.3, 6))])

    assert corners[:, 2].max() == 6.0
