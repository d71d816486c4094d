"""Derivatives of a path against difference quotients of high order."""

from __future__ import annotations

import numpy as np
import pytest

from rgss.motion import JointPath, blend
from rgss.motion.derivatives import path_derivatives

pytestmark = pytest.mark.engine

STEP = 1e-3


def quotients(function, at):
    """First and second derivative by central differences of fourth order."""
    far_back, back, here, ahead, far_ahead = (function(at + k * STEP) for k in (-2, -1, 0, 1, 2))
    first = (far_back - 8 * back + 8 * ahead - far_ahead) / (12 * STEP)
    second = (-far_back + 16 * back - 30 * here + 16 * ahead - far_ahead) / (12 * STEP**2)
    return first, second


def inside_of_pieces(path, count):
    """Points of every piece, so far from its ends that no difference quotient reaches over them."""
    starts, ends = path.breaks[:-1] + 3 * STEP, path.breaks[1:] - 3 * STEP
    wide = ends > starts
    return np.concatenate([np.linspace(a, b, count) for a, b in zip(starts[wide], ends[wide], strict=True)])


def test_joints_and_tool_against_difference_quotients(anything, arm, polylines):
    curved = 0
    for points in polylines(6, seed=20):
        path = blend(JointPath(points), anything, resolution_rad=0.02).path
        at = inside_of_pieces(path, 15)
        found = path_derivatives(path, at, arm)
        first, second = quotients(path, at)
        assert found.first == pytest.approx(first, abs=1e-7)
        assert found.second == pytest.approx(second, abs=1e-5)
        first, second = quotients(lambda s, path=path: arm.tool_position(path(s)), at)
        assert found.tool_first == pytest.approx(first, abs=1e-6)
        assert found.tool_second == pytest.approx(second, abs=1e-4)
        curved += sum(path.curved)
    # On blends the second derivative is more than the bending of the tool's way along a straight piece.
    assert curved >= 5


def test_a_joint_alone_moves_the_tool_on_a_circle(anything, arm):
    points = np.array([[0.0, -1.0, 1.2, 0.3, 0.7, 0.1], [1.0, -1.0, 1.2, 0.3, 0.7, 0.1]])
    path = blend(JointPath(points), anything, resolution_rad=0.02).path
    found = path_derivatives(path, np.array([0.2, 0.7]), arm)
    from_axis = arm.tool_position(points[:1])[0] - arm.robot.base.position_m
    radius = np.hypot(*from_axis[:2])

    assert np.linalg.norm(found.tool_first, axis=1) == pytest.approx([radius, radius])
    assert np.linalg.norm(found.tool_second, axis=1) == pytest.approx([radius, radius])
    assert np.sum(found.tool_first * found.tool_second, axis=1) == pytest.approx([0.0, 0.0], abs=1e-12)


def test_every_so_many_points(anything, arm, polylines):
    path = blend(JointPath(polylines(1, seed=21)[0]), anything, resolution_rad=0.02).path
    at = np.linspace(0.0, path.breaks[-1], 13)
    whole, thinned = path_derivatives(path, at, arm).every(4), path_derivatives(path, at[::4], arm)

    for name in ("first", "second", "tool_first", "tool_second"):
        assert getattr(whole, name) == pytest.approx(getattr(thinned, name), abs=1e-12)
