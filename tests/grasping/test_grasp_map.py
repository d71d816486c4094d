"""The grasp matrix against an independent construction, and the map against sums of forces."""

from __future__ import annotations

import math

import numpy as np
import pytest

from rgss.errors import DefinitionError
from rgss.grasping import (
    ContactKind,
    ContactPoint,
    Wrench,
    grasp_map,
    grasp_matrix,
    in_friction_cone,
    net_wrench,
    partial_wrench_basis,
    primitive_wrenches,
)

ORIGIN = (0.0, 0.0, 0.0)
X, Z = (1.0, 0.0, 0.0), (0.0, 0.0, 1.0)
BASES = {
    # Wrench bases in the contact's frame, z along the normal: Murray, Li, Sastry 1994, chapter 5.
    ContactKind.FRICTIONLESS: np.eye(6)[:, [2]],
    ContactKind.HARD: np.eye(6)[:, [2, 0, 1]],
    ContactKind.SOFT: np.eye(6)[:, [2, 0, 1, 5]],
}


def skew(vector):
    x, y, z = vector
    return np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])


def test_columns_are_the_transposed_adjoints_times_the_wrench_bases(random_contacts, grasp_of):
    rng = np.random.default_rng(0)
    for _ in range(30):
        contacts = random_contacts(rng, int(rng.integers(1, 6)))
        grasp = grasp_of(contacts, 0.05)
        columns = []
        for contact in contacts:
            normal, first, second = contact.axes()
            rotation, position = np.column_stack([first, second, normal]), np.array(contact.position_m)
            adjoint = np.block([[rotation, np.zeros((3, 3))], [skew(position) @ rotation, rotation]])
            basis = adjoint @ BASES[contact.kind]
            basis[3:] /= 0.05
            if contact.kind is ContactKind.SOFT:
                basis[:, 3] *= 0.05  # the intensity is a torque over the length, too
            columns.append(basis)
        assert grasp_matrix(grasp) == pytest.approx(np.hstack(columns), abs=1e-12)


@pytest.mark.parametrize(("kind", "width"), [("frictionless", 1), ("hard", 3), ("soft", 4)])
def test_intensities_of_each_kind(ring, grasp_of, kind, width):
    assert partial_wrench_basis(grasp_of(ring(2, kind=ContactKind(kind))), 1).shape == (6, width)


def test_the_grasp_map_sums_forces_and_torques(random_contacts, grasp_of):
    rng = np.random.default_rng(1)
    contacts = random_contacts(rng, 4, kinds=(ContactKind.SOFT,))
    intensities = rng.normal(size=(4, 4))
    force, torque = np.zeros(3), np.zeros(3)
    for contact, row in zip(contacts, intensities, strict=True):
        pushed = contact.axes().T @ row[:3]
        force += pushed
        torque += np.cross(contact.position_m, pushed) + row[3] * np.array(contact.normal)
    for length in (0.01, 1.0):
        wrench = grasp_map(grasp_of(contacts, length), intensities.tolist())
        assert wrench.force_n == pytest.approx(force)
        assert wrench.torque_n_m == pytest.approx(torque)


def test_two_fingers_that_hold_a_weight_leave_no_net_wrench_but_it(ring, grasp_of):
    lift = {"normal_force_n": 8.0, "friction_force_n": (0.0, 0.0, 2.5)}

    assert net_wrench(grasp_of(ring(2, **lift))) == Wrench(
        torque_n_m=pytest.approx(ORIGIN), force_n=pytest.approx((0.0, 0.0, 5.0))
    )


def test_the_net_wrench_has_the_torque_of_an_eccentric_force(grasp_of):
    contact = ContactPoint(position_m=(0.0, 0.1, 0.0), normal=X, normal_force_n=3.0)

    assert net_wrench(grasp_of([contact])).torque_n_m == pytest.approx((0.0, 0.0, -0.3))


def test_intensities_must_fit_the_contacts(ring, grasp_of):
    with pytest.raises(DefinitionError) as caught:
        grasp_map(grasp_of(ring(2)), [[1.0, 0.0, 0.0], [1.0]])

    assert str(caught.value) == (
        "the numbers of intensities of the contacts must be [3, 3], got [3, 1] "
        "(give 1 for a frictionless contact, 3 for a hard one, 4 for a soft one)"
    )


@pytest.mark.parametrize(
    ("intensities", "inside"),
    [
        ([1.0], True),
        ([-0.1], False),
        ([1.0, 0.3, 0.4], True),
        ([1.0, 0.36, 0.36], False),
        ([2.0, 0.9, 0.0], True),
        ([0.5, 0.3, 0.0], False),
        ([1.0, 0.3, 0.4, -0.01], True),
        ([1.0, 0.3, 0.4, 0.011], False),
    ],
)
def test_friction_cones(intensities, inside):
    contact = ContactPoint(position_m=ORIGIN, normal=X, friction=0.5, torsional_friction_m=0.01)

    assert in_friction_cone(contact, intensities) is inside


@pytest.mark.parametrize("edges", [3, 4, 8, 13])
def test_edges_are_in_the_cone_and_on_its_surface(random_contacts, grasp_of, edges):
    contacts = random_contacts(np.random.default_rng(2), 6)
    grasp = grasp_of(contacts)
    wrenches = primitive_wrenches(grasp, cone_edges=edges)
    for column, index in zip(wrenches.matrix.T, wrenches.contacts, strict=True):
        contact = contacts[index]
        normal, first, second = contact.axes() @ column[:3]
        assert normal == pytest.approx(1.0)
        torque = column[3:] * grasp.characteristic_length_m - np.cross(contact.position_m, column[:3])
        twisting = float(np.dot(torque, contact.normal))
        assert torque == pytest.approx(twisting * np.array(contact.normal), abs=1e-12)
        assert math.hypot(first, second) == pytest.approx(
            0.0 if contact.kind is ContactKind.FRICTIONLESS else contact.friction, abs=1e-12
        )
        assert abs(twisting) == pytest.approx(
            contact.torsional_friction_m if contact.kind is ContactKind.SOFT else 0.0, abs=1e-12
        )
    per_kind = {ContactKind.FRICTIONLESS: 1, ContactKind.HARD: edges, ContactKind.SOFT: 2 * edges}
    counts = [int(np.sum(wrenches.contacts == index)) for index in range(len(contacts))]
    assert counts == [per_kind[contact.kind] for contact in contacts]


@pytest.mark.parametrize("edges", [3, 4, 8, 13])
def test_edges_are_evenly_spread_from_the_tangent_on(ring, grasp_of, edges):
    contact = ring(1, tangent=(0.0, 1.0, 2.0))[0]
    across = (contact.axes() @ primitive_wrenches(grasp_of([contact]), cone_edges=edges).matrix[:3])[1:]
    angles = 2 * math.pi / edges * np.arange(edges)

    assert across == pytest.approx(0.5 * np.array([np.cos(angles), np.sin(angles)]))


def test_without_friction_a_contact_has_one_edge(ring, grasp_of):
    assert primitive_wrenches(grasp_of(ring(3, friction=0.0))).matrix.shape == (6, 3)
    assert primitive_wrenches(grasp_of(ring(3, friction=0.5)), frictionless=True).matrix.shape == (6, 3)
    soft = ring(3, friction=0.0, kind=ContactKind.SOFT, torsional_friction_m=0.01)
    assert primitive_wrenches(grasp_of(soft)).matrix.shape == (6, 6)


def test_a_planar_cone_has_its_two_edges_in_the_plane(ring, grasp_of):
    # At x = r pressing along -x, in units of the radius: the torque of a force is its y component.
    wrenches = primitive_wrenches(grasp_of(ring(2)), plane_normal=Z).matrix.T

    assert wrenches.shape == (4, 3)
    assert np.linalg.norm(wrenches[:, :2], axis=1) == pytest.approx(np.full(4, math.hypot(1.0, 0.5)))
    assert sorted(wrenches[:, 2]) == pytest.approx([-0.5, -0.5, 0.5, 0.5])


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"cone_edges": 2}, "a friction pyramid must have at least 3 edges, got 2 (give at least 3)"),
        (
            {"plane_normal": X},
            (
                "the normal of contact 0 does not lie in the plane of the grasp "
                "(leave plane_normal out for a grasp in space)"
            ),
        ),
        (
            {"plane_normal": (0.0, 0.0, 2.0)},
            "the normal of a plane must have the length 1, got 2 (give it the length 1)",
        ),
    ],
)
def test_pyramids_that_cannot_be(ring, grasp_of, options, message):
    with pytest.raises(DefinitionError) as caught:
        primitive_wrenches(grasp_of(ring(2)), **options)

    assert str(caught.value) == message
