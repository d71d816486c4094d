"""Measures of quality against closed forms, brute force and independent linear algebra."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
import scipy.spatial

from rgss.errors import DefinitionError
from rgss.grasping import (
    ContactKind,
    grasp_matrix,
    primitive_wrenches,
    q_gii,
    q_msv,
    q_smw_n,
    q_voe,
)
from rgss.grasping.quality import ball_radius, singular_values

SOFT = {"kind": ContactKind.SOFT, "torsional_friction_m": 0.005}


def radius_by_facets(points):
    """Inradius by brute force: every hyperplane through as many points as dimensions that leaves all on one side."""
    space, best = points.shape[0], math.inf
    for chosen in itertools.combinations(range(points.shape[1]), space):
        corners = points[:, chosen]
        directions = corners[:, 1:] - corners[:, :1]
        normal = np.linalg.svd(directions.T)[2][-1]
        offset = normal @ corners[:, 0]
        heights = normal @ points
        if np.all(heights <= offset + 1e-9) or np.all(heights >= offset - 1e-9):
            best = min(best, abs(offset))
    return best


def test_two_opposed_soft_contacts_are_balanced(ring, grasp_of):
    # G Gᵀ is 2 I: each contact transmits three forces, one torque about the line and two across it.
    matrix = grasp_matrix(grasp_of(ring(2, **SOFT)))

    assert singular_values(matrix) == pytest.approx(np.full(6, math.sqrt(2)))
    assert (q_msv(matrix), q_voe(matrix), q_gii(matrix)) == pytest.approx((math.sqrt(2), 8.0, 1.0))


def test_the_length_scales_torques(ring, grasp_of):
    # With twice the radius as length, torques across the line count half; that about it is an intensity of its own.
    matrix = grasp_matrix(grasp_of(ring(2, **SOFT), 0.06))

    assert sorted(singular_values(matrix)) == pytest.approx(sorted([math.sqrt(2)] * 4 + [math.sqrt(0.5)] * 2))


def test_two_opposed_hard_contacts_are_singular(ring, grasp_of):
    matrix = grasp_matrix(grasp_of(ring(2)))

    assert (q_msv(matrix), q_voe(matrix), q_gii(matrix)) == (0.0, 0.0, 0.0)
    assert singular_values(matrix)[:5] == pytest.approx(np.full(5, math.sqrt(2)))


@pytest.mark.parametrize("count", range(3, 7))
def test_hard_contacts_round_a_circle(ring, grasp_of, count):
    # G Gᵀ = k diag(1, 1, 1, ½, ½, 1) in units of the radius.
    matrix = grasp_matrix(grasp_of(ring(count)))

    assert q_msv(matrix) == pytest.approx(math.sqrt(count / 2))
    assert q_voe(matrix) == pytest.approx(count**3 / 2)
    assert q_gii(matrix) == pytest.approx(math.sqrt(0.5))


@pytest.mark.parametrize("count", [1, 3])
def test_fewer_columns_than_rows_are_singular(ring, grasp_of, count):
    matrix = grasp_matrix(grasp_of(ring(count, kind=ContactKind.FRICTIONLESS)))

    assert singular_values(matrix).shape == (6,)
    assert (q_msv(matrix), q_voe(matrix), q_gii(matrix)) == (0.0, 0.0, 0.0)


def test_singular_values_against_eigenvalues_and_determinants(random_contacts, grasp_of):
    rng = np.random.default_rng(8)
    for _ in range(200):
        matrix = grasp_matrix(grasp_of(random_contacts(rng, int(rng.integers(3, 7)), kinds=(ContactKind.HARD,))))
        eigenvalues = np.linalg.eigvalsh(matrix @ matrix.T)
        assert q_msv(matrix) == pytest.approx(math.sqrt(eigenvalues[0]), rel=1e-6)
        assert q_voe(matrix) == pytest.approx(math.sqrt(np.linalg.det(matrix @ matrix.T)), rel=1e-6)
        assert q_gii(matrix) == pytest.approx(math.sqrt(eigenvalues[0] / eigenvalues[-1]), rel=1e-6)
        assert 0.0 <= q_gii(matrix) <= 1.0


@pytest.mark.parametrize("space", [2, 3, 6])
def test_radius_of_regular_bodies(space):
    axes = np.eye(space)
    corners = np.array(list(itertools.product((-1.0, 1.0), repeat=space))).T
    simplex = np.linalg.svd(np.ones((1, space + 1)))[2][1:]  # corners of a regular simplex about the origin

    assert ball_radius(np.hstack([axes, -axes])) == pytest.approx(1 / math.sqrt(space))
    assert ball_radius(corners) == pytest.approx(1.0)
    assert ball_radius(simplex) == pytest.approx(float(np.linalg.norm(simplex[:, 0])) / space)


@pytest.mark.parametrize("seed", range(6))
def test_radius_against_all_facets(seed):
    rng = np.random.default_rng(seed)
    points = rng.normal(size=(6, 11))
    points -= points.mean(axis=1, keepdims=True)

    # The hull is built of points that are moved a little.
    assert ball_radius(points) == pytest.approx(radius_by_facets(points), rel=1e-7)


def test_the_weakest_direction_in_a_plane_by_brute_force(ring, grasp_of):
    # Friction cones of two opposed fingers in the plane: on a fine grid of directions, none resists less.
    grasp = grasp_of(ring(2, friction=0.6))
    wrenches = primitive_wrenches(grasp, plane_normal=(0.0, 0.0, 1.0)).matrix
    turns, rises = np.meshgrid(np.linspace(0.0, 2 * math.pi, 721), np.linspace(-math.pi / 2, math.pi / 2, 361))
    directions = np.stack([np.cos(rises) * np.cos(turns), np.cos(rises) * np.sin(turns), np.sin(rises)], axis=-1)
    support = np.max(directions.reshape(-1, 3) @ wrenches, axis=1)

    # The hull is a tetrahedron with all faces alike.
    assert ball_radius(wrenches) == pytest.approx(0.6 / math.sqrt(2 + 0.6**2))
    assert ball_radius(wrenches) == pytest.approx(float(support.min()), abs=5e-3)
    assert ball_radius(wrenches) <= support.min() + 1e-12


def test_no_direction_resists_less_than_the_smallest_maximum_wrench(random_contacts, grasp_of):
    rng, closed = np.random.default_rng(9), 0
    directions = rng.normal(size=(20000, 6))
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    for _ in range(25):
        grasp = grasp_of(random_contacts(rng, 3, kinds=(ContactKind.HARD, ContactKind.SOFT)))
        weakest = q_smw_n(grasp, finger_force_limit_n=10.0, cone_edges=6)
        support = 10.0 * np.max(directions @ primitive_wrenches(grasp, cone_edges=6).matrix, axis=1)
        assert weakest <= max(float(support.min()), 0.0) + 1e-9
        closed += weakest > 0.0
    assert closed >= 5


def test_the_measure_is_proportional_to_the_force(ring, grasp_of):
    grasp = grasp_of(ring(3))
    one = q_smw_n(grasp, finger_force_limit_n=1.0)

    assert one > 0.0
    assert q_smw_n(grasp, finger_force_limit_n=20.0) == pytest.approx(20.0 * one)


def test_more_edges_come_nearer_to_round_cones_from_below(ring, grasp_of):
    grasp = grasp_of(ring(3))
    coarse, fine, finest = (q_smw_n(grasp, finger_force_limit_n=1.0, cone_edges=edges) for edges in (4, 8, 16))

    assert coarse <= fine <= finest
    assert finest == pytest.approx(fine, rel=0.1)


@pytest.mark.parametrize("details", [{}, {"kind": ContactKind.FRICTIONLESS}])
def test_without_force_closure_some_wrench_is_not_resisted(ring, grasp_of, details):
    assert q_smw_n(grasp_of(ring(2, **details)), finger_force_limit_n=10.0) == 0.0


def test_the_limit_must_be_positive(ring, grasp_of):
    with pytest.raises(DefinitionError) as caught:
        q_smw_n(grasp_of(ring(3)), finger_force_limit_n=-1.0)

    assert str(caught.value) == "a finger cannot have the force limit -1 N (give a force above zero)"


def refuse(times):
    """A hull builder that fails a number of times."""
    build, asked = scipy.spatial.ConvexHull, []

    def hull(points, qhull_options):
        asked.append(qhull_options)
        if len(asked) <= times:
            raise scipy.spatial.QhullError("QH6271 wide merge\nand a long story")
        return build(points, qhull_options=qhull_options)

    return hull, asked


def test_where_moving_the_points_does_not_help_facets_are_merged(monkeypatch):
    hull, asked = refuse(1)
    monkeypatch.setattr(scipy.spatial, "ConvexHull", hull)

    assert ball_radius(np.hstack([np.eye(6), -np.eye(6)])) == pytest.approx(1 / math.sqrt(6), abs=1e-8)
    assert asked == ["QJ", "Qt Qx"]


def test_no_hull(monkeypatch):
    monkeypatch.setattr(scipy.spatial, "ConvexHull", refuse(2)[0])

    with pytest.raises(DefinitionError) as caught:
        ball_radius(np.hstack([np.eye(6), -np.eye(6)]))

    assert str(caught.value) == (
        "the convex hull of a grasp's wrenches cannot be computed: QH6271 wide merge "
        "(check that contacts do not nearly coincide)"
    )
