"""Equilibrium, closure and resistance: hand-worked grasps, and a second formulation over random ones."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial import ConvexHull, QhullError

from rgss.errors import DefinitionError
from rgss.grasping import (
    ContactKind,
    ContactPoint,
    Wrench,
    equilibrium,
    force_closure,
    form_closure,
    primitive_wrenches,
    wrench_resistance,
)

Z = (0.0, 0.0, 1.0)
SOFT = {"kind": ContactKind.SOFT, "torsional_friction_m": 0.005}
# Four pairs of a point on the unit square and its inward normal, each half an edge off the middle: a pinwheel.
PINWHEEL = [
    ((1.0, 0.5, 0.0), (-1.0, 0.0, 0.0)),
    ((-1.0, -0.5, 0.0), (1.0, 0.0, 0.0)),
    ((0.5, 1.0, 0.0), (0.0, -1.0, 0.0)),
    ((-0.5, -1.0, 0.0), (0.0, 1.0, 0.0)),
]


def frictionless(pairs):
    return [ContactPoint(position_m=point, normal=normal, kind=ContactKind.FRICTIONLESS) for point, normal in pairs]


def hull_holds_origin(wrenches):
    """Whether the origin is inside the wrenches' convex hull: the second formulation of positive spanning."""
    try:
        hull = ConvexHull(wrenches.T)
    except QhullError:
        return False
    return bool(np.max(hull.equations[:, -1]) < -1e-9)


def test_two_opposed_hard_contacts_balance_but_cannot_resist_a_torque_about_their_line(ring, grasp_of):
    grasp = grasp_of(ring(2))

    assert equilibrium(grasp).holds
    assert equilibrium(grasp).margin == pytest.approx(1.0)
    assert not force_closure(grasp).holds
    assert force_closure(grasp).margin == 0.0
    about_line = wrench_resistance(grasp, Wrench(torque_n_m=(0.01, 0.0, 0.0)), finger_force_limit_n=10.0)
    assert (about_line.holds, about_line.margin) == (False, pytest.approx(-1.0))


def test_two_opposed_soft_contacts_are_force_closed(ring, grasp_of):
    grasp = grasp_of(ring(2, **SOFT))

    assert force_closure(grasp).holds
    assert force_closure(grasp).margin == pytest.approx(1.0)
    # Both fingers twist with up to 5 mm times 10 N.
    about_line = wrench_resistance(grasp, Wrench(torque_n_m=(0.05, 0.0, 0.0)), finger_force_limit_n=10.0)
    assert about_line.margin == pytest.approx(1.0)


def test_soft_contacts_without_torsional_friction_are_hard_ones(ring, grasp_of):
    assert not force_closure(grasp_of(ring(2, kind=ContactKind.SOFT))).holds


def test_two_hard_contacts_that_face_away_from_one_another(ring, grasp_of):
    contacts = [replace(contact, normal=(0.0, 0.0, 1.0)) for contact in ring(2)]
    verdict = equilibrium(grasp_of(contacts))

    assert not verdict.holds
    # Nothing presses down: the smallest net wrench of 1 N of normal force is that force.
    assert verdict.margin == pytest.approx(-1.0)
    assert not force_closure(grasp_of(contacts)).holds


def test_three_hard_contacts_round_a_cylinder(ring, grasp_of):
    grasp = grasp_of(ring(3))

    assert equilibrium(grasp).margin == pytest.approx(1.0)
    assert force_closure(grasp).holds
    assert not form_closure(grasp).holds


def test_three_frictionless_contacts_round_a_cylinder_cannot_hold_it_up(ring, grasp_of):
    grasp = grasp_of(ring(3, kind=ContactKind.FRICTIONLESS))

    assert equilibrium(grasp).holds
    assert not force_closure(grasp).holds
    assert wrench_resistance(grasp, Wrench(force_n=(0.0, 0.0, -1.0)), finger_force_limit_n=10.0).margin == -1.0


def test_a_contact_that_cannot_take_part_is_not_essential(ring, grasp_of):
    idle = ContactPoint(position_m=(0.0, 0.0, 0.05), normal=(0.0, 0.0, -1.0), kind=ContactKind.FRICTIONLESS)
    contacts = [*ring(2, kind=ContactKind.FRICTIONLESS), idle]

    assert equilibrium(grasp_of(contacts)).holds
    assert equilibrium(grasp_of(contacts)).margin == 0.0


@pytest.mark.parametrize(("count", "margin"), [(4, 1.0), (3, 0.0)])
def test_four_frictionless_contacts_close_a_plane_and_three_do_not(grasp_of, count, margin):
    grasp = grasp_of(frictionless(PINWHEEL[:count]))
    verdict = form_closure(grasp, plane_normal=Z)

    assert (verdict.holds, verdict.margin) == (count == 4, pytest.approx(margin))
    assert equilibrium(grasp, plane_normal=Z).holds == (count == 4)
    assert not form_closure(grasp).holds  # out of the plane the object is free


def test_four_frictionless_contacts_through_one_point_leave_a_rotation(grasp_of, ring):
    assert not form_closure(grasp_of(ring(4)), plane_normal=Z).holds


def test_two_contacts_with_friction_close_a_plane(ring, grasp_of):
    # Nguyen's theorem: the line between the two lies in both friction cones.
    tilted = [replace(contact, normal=(contact.normal[0] * 0.8, 0.6, 0.0)) for contact in ring(2, friction=0.5)]

    assert force_closure(grasp_of(ring(2)), plane_normal=Z).holds
    assert not force_closure(grasp_of(tilted), plane_normal=Z).holds
    steep = [replace(contact, friction=0.8) for contact in tilted]  # tan⁻¹ 0.8 is above the tilt of 36.9°
    assert force_closure(grasp_of(steep), plane_normal=Z).holds


def test_seven_frictionless_contacts_close_space_and_no_six_of_them_do(cube, grasp_of):
    # The balanced pressing is 1, 1, 1, 1, 2, 1, 1: the smallest over the mean is 7/8.
    assert form_closure(grasp_of(cube)).holds
    assert form_closure(grasp_of(cube)).margin == pytest.approx(7 / 8)
    for left_out in range(7):
        assert not form_closure(grasp_of([*cube[:left_out], *cube[left_out + 1 :]])).holds


def test_seven_random_frictionless_contacts(random_contacts, grasp_of):
    # Seven wrenches of full rank have one way to balance: it must press at every contact.
    rng, closed = np.random.default_rng(3), 0
    for _ in range(300):
        grasp = grasp_of(random_contacts(rng, 7, kinds=(ContactKind.FRICTIONLESS,)))
        wrenches = primitive_wrenches(grasp).matrix
        balance = np.linalg.svd(wrenches)[2][6]
        expected = bool(np.all(balance > 0.0) or np.all(balance < 0.0))
        closed += expected
        assert form_closure(grasp).holds == expected
    assert closed >= 3


def test_force_closure_agrees_with_the_convex_hull_on_500_random_grasps(random_contacts, grasp_of):
    rng, verdicts = np.random.default_rng(4), []
    for _ in range(500):
        kinds = (ContactKind.HARD, ContactKind.SOFT) if rng.random() < 0.7 else tuple(ContactKind)
        grasp = grasp_of(random_contacts(rng, int(rng.integers(2, 6)), kinds=kinds))
        verdict = force_closure(grasp, cone_edges=5)
        expected = hull_holds_origin(primitive_wrenches(grasp, cone_edges=5).matrix)
        assert verdict.holds == expected
        assert (verdict.margin > 0.0) == verdict.holds
        if verdict.holds:
            assert equilibrium(grasp, cone_edges=5).holds
        verdicts.append(expected)
    assert 100 < sum(verdicts) < 400


@pytest.mark.parametrize("fingers", [2, 3])
@pytest.mark.parametrize("friction", [0.4, 0.9])
def test_the_weight_that_fingers_hold_is_friction_times_force(ring, grasp_of, fingers, friction):
    grasp = grasp_of(ring(fingers, friction=friction))
    bearable = friction * fingers * 10.0
    for share in (0.5, 1.0, 1.01):
        verdict = wrench_resistance(grasp, Wrench(force_n=(0.0, 0.0, -share * bearable)), finger_force_limit_n=10.0)
        assert verdict.margin == pytest.approx(1.0 / share - 1.0)
        assert verdict.holds == (share <= 1.0)


def test_the_points_of_a_finger_share_its_force(ring, grasp_of):
    points = [
        replace(contact, finger=finger)
        for height in (-0.01, 0.01)
        for finger, contact in enumerate(ring(2, height_m=height))
    ]
    apart = [replace(point, finger=None) for point in points]
    load = Wrench(force_n=(0.0, 0.0, -10.0))

    assert wrench_resistance(grasp_of(points), load, finger_force_limit_n=10.0).margin == pytest.approx(0.0, abs=1e-9)
    assert wrench_resistance(grasp_of(apart), load, finger_force_limit_n=10.0).margin == pytest.approx(1.0)


def test_resistance_in_a_plane(grasp_of, ring):
    # Two fingers at ±30 mm with a friction of 0.5 and 10 N each bear a torque of 2 · 0.5 · 10 N · 30 mm.
    verdict = wrench_resistance(
        grasp_of(ring(2)), Wrench(torque_n_m=(0.0, 0.0, 0.3)), finger_force_limit_n=10.0, plane_normal=Z
    )

    assert (verdict.holds, verdict.margin) == (True, pytest.approx(0.0, abs=1e-9))


def test_no_load_is_always_resisted(ring, grasp_of):
    verdict = wrench_resistance(grasp_of(ring(1)), Wrench(), finger_force_limit_n=1.0)

    assert (verdict.holds, verdict.margin) == (True, math.inf)


def test_a_force_closed_grasp_resists_every_direction(ring, grasp_of):
    rng, grasp = np.random.default_rng(5), grasp_of(ring(3))
    for _ in range(50):
        force, torque = rng.normal(size=(2, 3))
        load = Wrench(force_n=tuple(force.tolist()), torque_n_m=tuple((0.03 * torque).tolist()))
        assert wrench_resistance(grasp, load, finger_force_limit_n=1.0).margin > -1.0


@pytest.mark.parametrize(
    ("load", "limit", "message"),
    [
        (Wrench(), 0.0, "a finger cannot have the force limit 0 N (give a force above zero)"),
        (Wrench(), math.nan, "a finger cannot have the force limit nan N (give a force above zero)"),
        (
            Wrench(force_n=(math.inf, 0.0, 0.0)),
            1.0,
            "a load with the components (inf, 0.0, 0.0, 0.0, 0.0, 0.0) cannot be resisted (give finite numbers)",
        ),
    ],
)
def test_loads_and_limits_that_cannot_be(ring, grasp_of, load, limit, message):
    with pytest.raises(DefinitionError) as caught:
        wrench_resistance(grasp_of(ring(2)), load, finger_force_limit_n=limit)

    assert str(caught.value) == message
