"""Grasps: what they need, their length, and their fingers."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest

from rgss.errors import DefinitionError
from rgss.grasping import ContactPoint, Grasp

AT_CENTRE = ContactPoint(position_m=(0.1, 0.0, 0.0), normal=(1.0, 0.0, 0.0))


def test_the_default_length_is_the_farthest_contact(ring):
    contacts = [*ring(3), ContactPoint(position_m=(0.0, 0.0, 0.05), normal=(0.0, 0.0, -1.0))]

    assert Grasp.of(contacts, (0.0, 0.0, 0.0)).characteristic_length_m == pytest.approx(0.05)
    assert Grasp.of(contacts, (0.0, 0.0, 0.0), 0.2).characteristic_length_m == 0.2


def test_contacts_belong_to_fingers(ring):
    contacts = [replace(contact, finger=finger) for contact, finger in zip(ring(5), [3, None, 0, 3, None], strict=True)]

    assert Grasp.of(contacts, (0.0, 0.0, 0.0)).fingers() == ((0, 3), (1,), (2,), (4,))


@pytest.mark.parametrize(
    ("contacts", "centre", "length", "message"),
    [
        ([], (0.0, 0.0, 0.0), None, "a grasp must have at least one contact, got none (give at least one contact)"),
        (
            [AT_CENTRE],
            (0.0, math.inf, 0.0),
            1.0,
            "(0.0, inf, 0.0) is not a centre of mass (give three finite numbers)",
        ),
        (
            [AT_CENTRE],
            (0.1, 0.0, 0.0),
            None,
            (
                "the characteristic length of a grasp must be positive, got 0 m "
                "(give a length above zero, such as the object's greatest radius)"
            ),
        ),
        (
            [AT_CENTRE],
            (0.0, 0.0, 0.0),
            -0.5,
            (
                "the characteristic length of a grasp must be positive, got -0.5 m "
                "(give a length above zero, such as the object's greatest radius)"
            ),
        ),
    ],
)
def test_what_is_no_grasp(contacts, centre, length, message):
    with pytest.raises(DefinitionError) as caught:
        Grasp.of(contacts, centre, length)

    assert str(caught.value) == message
