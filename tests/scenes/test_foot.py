"""Static stability of objects at rest."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.optimize import linprog

from rgss.scenes import Box, Cylinder, LyingCylinder, MeshShape, Pose, Workpiece, foot_of
from rgss.scenes.objects.foot import FootKind


def workpiece(shape, across_m=(0.0, 0.0), *, resistance_m=0.0):
    return Workpiece(
        id="part",
        shape=shape,
        mass_kg=0.2,
        friction=1.0,
        force_limit_n=40.0,
        centre_of_mass_across_m=across_m,
        rolling_resistance_m=resistance_m,
        pose=Pose(),
        colour=(0.0, 0.0, 0.0, 1.0),
    )


def prism(turn_rad):
    """A hexagonal prism with its axis level, turned about it."""
    turns = [turn_rad + math.tau * place / 6 for place in range(6)]
    return MeshShape(
        parts_m=(tuple((x, 0.03 * math.sin(t), 0.03 * math.cos(t)) for t in turns for x in (-0.05, 0.05)),), sha256=""
    )


@pytest.mark.parametrize(
    ("shape", "across_m", "outside_m"),
    [
        (Box(size_m=(0.1, 0.06, 0.2)), (0.0, 0.0), -0.03),
        (Box(size_m=(0.1, 0.06, 0.2)), (0.045, 0.0), -0.005),
        (Box(size_m=(0.1, 0.06, 0.2)), (0.053, 0.034), 0.005),
        (Cylinder(radius_m=0.04, height_m=0.1), (0.03, 0.0), -0.01),
        (Cylinder(radius_m=0.04, height_m=0.1), (0.0, 0.046), 0.006),
    ],
)
def test_an_object_on_a_face_stands_where_its_centre_of_mass_is_above_it(shape, across_m, outside_m):
    foot = foot_of(workpiece(shape, across_m))
    assert foot.kind is FootKind.FACE
    assert foot.outside_m == pytest.approx(outside_m, abs=1e-4)
    assert foot.is_stable is (outside_m < 0.0)


def test_a_prism_stands_on_a_face_and_topples_on_an_edge():
    on_edge, on_face = foot_of(workpiece(prism(0.0))), foot_of(workpiece(prism(math.pi / 6)))
    assert (on_edge.kind, on_edge.is_stable) == (FootKind.EDGE, False)
    assert (on_face.kind, on_face.is_stable) == (FootKind.FACE, True)
    assert on_face.outside_m == pytest.approx(-0.015)


def test_a_cone_on_its_apex_topples():
    rim = [(0.03 * math.cos(t), 0.03 * math.sin(t), 0.04) for t in np.linspace(0.0, math.tau, 24, endpoint=False)]
    foot = foot_of(workpiece(MeshShape(parts_m=((*rim, (0.0, 0.0, -0.05)),), sha256="")))
    assert (foot.kind, foot.is_stable) == (FootKind.POINT, False)


@pytest.mark.parametrize(("across_m", "is_stable"), [(0.0, True), (0.4e-3, True), (0.6e-3, False)])
def test_rolling_resistance_bears_a_centre_of_mass_beside_the_line_of_contact(across_m, is_stable):
    lying = LyingCylinder(radius_m=0.03, length_m=0.1)
    assert foot_of(workpiece(lying, (0.0, across_m), resistance_m=0.5e-3)).is_stable is is_stable


def test_the_foot_agrees_with_a_balance_of_forces():
    """Upward forces at the lowest corners balance the weight exactly where the object is stable."""
    random = np.random.default_rng(3)
    for _ in range(60):
        corners = np.round(random.uniform(-0.05, 0.05, (8, 2)), 4)
        across = random.uniform(-0.05, 0.05, 2)
        part = tuple((x, y, z) for x, y in corners.tolist() for z in (-0.02, 0.02))
        rows = np.vstack([corners.T, np.ones(len(corners))])
        balanced = linprog(np.zeros(len(corners)), A_eq=rows, b_eq=[*across, 1.0]).success
        assert foot_of(workpiece(MeshShape(parts_m=(part,), sha256=""), tuple(across))).is_stable is balanced
