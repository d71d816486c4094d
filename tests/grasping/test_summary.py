"""Everything about a grasp in one value, whatever the frame and the order of its contacts."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from rgss.errors import DefinitionError
from rgss.grasping import ContactKind, Wrench, analyse_grasp

CENTRE = (0.0, 0.0, 0.0)
Z = (0.0, 0.0, 1.0)
NAMES = [
    "contact_count",
    "finger_count",
    "characteristic_length_m",
    "equilibrium",
    "equilibrium_margin_1",
    "force_closure",
    "force_closure_margin_1",
    "form_closure",
    "form_closure_margin_1",
    "q_msv_1",
    "q_voe_1",
    "q_gii_1",
    "q_gpri_1",
    "q_diff_m",
    "q_smw_n",
    "net_wrench_n",
    "wrench_resistance",
    "load_factor_1",
]


def numbers(quality):
    return [np.nan if value is None else float(value) for value in quality.metrics().values()]


def test_three_fingers_that_hold_a_cup(ring):
    contacts = ring(3, friction=0.7, normal_force_n=10.0, friction_force_n=(0.0, 0.0, 1.5))
    quality = analyse_grasp(
        contacts,
        centre_of_mass_m=CENTRE,
        finger_force_limit_n=10.0,
        grasp_axis=Z,
        external_wrench=Wrench(force_n=(0.0, 0.0, -4.2)),
    )

    assert (quality.contact_count, quality.finger_count, quality.characteristic_length_m) == (3, 3, pytest.approx(0.03))
    assert (quality.equilibrium, quality.force_closure, quality.form_closure) == (True, True, False)
    assert (quality.q_msv_1, quality.q_voe_1, quality.q_gii_1) == pytest.approx((1.5**0.5, 13.5, 0.5**0.5))
    assert (quality.q_gpri_1, quality.q_diff_m) == pytest.approx((0.0, 0.0), abs=1e-12)
    assert quality.q_smw_n > 0.0
    assert quality.net_wrench_n == pytest.approx(4.5)
    assert (quality.wrench_resistance, quality.load_factor_1) == (True, pytest.approx(21.0 / 4.2))


def test_metrics_are_numbers_with_units_in_their_names(ring):
    quality = analyse_grasp(ring(2), centre_of_mass_m=CENTRE, finger_force_limit_n=10.0)
    metrics = quality.metrics()

    assert list(metrics) == NAMES
    assert (metrics["equilibrium"], metrics["force_closure"]) == (1, 0)
    assert not any(isinstance(value, bool) for value in metrics.values())
    assert [metrics[name] for name in ("q_gpri_1", "wrench_resistance", "load_factor_1")] == [None, None, None]


def test_no_load_has_no_factor(ring):
    quality = analyse_grasp(ring(2), centre_of_mass_m=CENTRE, finger_force_limit_n=1.0, external_wrench=Wrench())

    assert (quality.wrench_resistance, quality.load_factor_1) == (True, None)


def test_the_frame_does_not_matter(random_contacts, moved, random_rotation, triple):
    rng = np.random.default_rng(10)
    for _ in range(12):
        contacts = random_contacts(rng, int(rng.integers(2, 5)), kinds=(ContactKind.HARD, ContactKind.SOFT))
        rotation, shift, load = random_rotation(rng), rng.normal(size=3), rng.normal(size=(2, 3))
        load[1] *= 0.03
        here, there = (
            analyse_grasp(
                placed,
                centre_of_mass_m=triple(turn @ np.array([0.01, 0.0, 0.02]) + offset),
                finger_force_limit_n=10.0,
                grasp_axis=triple(turn @ np.array(Z)),
                external_wrench=Wrench(force_n=triple(turn @ load[0]), torque_n_m=triple(turn @ load[1])),
                cone_edges=5,
            )
            for placed, turn, offset in (
                (contacts, np.eye(3), np.zeros(3)),
                (moved(contacts, rotation, shift), rotation, shift),
            )
        )
        # The residual of a grasp without equilibrium is by components, which depend on the frame.
        here, there = (
            quality if quality.equilibrium else replace(quality, equilibrium_margin_1=0.0) for quality in (here, there)
        )
        assert numbers(there) == pytest.approx(numbers(here), rel=1e-6, abs=1e-7, nan_ok=True)


def test_the_order_of_contacts_does_not_matter(random_contacts):
    rng = np.random.default_rng(11)
    for _ in range(8):
        contacts = random_contacts(rng, 4)
        shuffled = [contacts[index] for index in rng.permutation(4)]
        one, other = (
            analyse_grasp(order, centre_of_mass_m=CENTRE, finger_force_limit_n=10.0, cone_edges=4)
            for order in (contacts, shuffled)
        )
        assert numbers(one) == pytest.approx(numbers(other), rel=1e-6, abs=1e-7, nan_ok=True)


def test_size_does_not_matter_to_pure_numbers(ring):
    small, large = (
        analyse_grasp(
            ring(4, radius_m=scale, kind=ContactKind.SOFT, torsional_friction_m=0.1 * scale, height_m=0.2 * scale),
            centre_of_mass_m=CENTRE,
            finger_force_limit_n=10.0,
            cone_edges=4,
        ).metrics()
        for scale in (0.01, 10.0)
    )
    for name in NAMES:
        if name.endswith(("_1", "_n")) and small[name] is not None:
            assert large[name] == pytest.approx(small[name], abs=1e-9), name


def test_the_same_contacts_give_the_same_bits(random_contacts):
    contacts = random_contacts(np.random.default_rng(12), 4)

    def analyse():
        return analyse_grasp(contacts, centre_of_mass_m=CENTRE, finger_force_limit_n=10.0)

    assert analyse() == analyse()


def test_turning_pyramids_changes_little(ring):
    # Tangents that are turned by half an edge: the round cones are the same, the pyramids are not.
    straight = ring(3, tangent=Z)
    turned = [
        replace(contact, tangent=(-0.3827 * contact.normal[1], 0.3827 * contact.normal[0], 0.9239))
        for contact in straight
    ]
    one, other = (
        analyse_grasp(contacts, centre_of_mass_m=CENTRE, finger_force_limit_n=10.0) for contacts in (straight, turned)
    )

    assert other.q_smw_n == pytest.approx(one.q_smw_n, rel=0.1)
    assert (other.q_msv_1, other.q_voe_1, other.q_gii_1) == pytest.approx((one.q_msv_1, one.q_voe_1, one.q_gii_1))
    assert other.force_closure == one.force_closure


def test_a_grasp_without_contacts():
    with pytest.raises(DefinitionError, match="a grasp must have at least one contact"):
        analyse_grasp([], centre_of_mass_m=CENTRE, finger_force_limit_n=10.0)
