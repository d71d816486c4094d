"""A contact point is what it says, and has a right-handed frame."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rgss.errors import DefinitionError
from rgss.grasping import ContactPoint

X = (1.0, 0.0, 0.0)
ORIGIN = (0.0, 0.0, 0.0)
COMPONENT = st.floats(-1.0, 1.0)


@given(st.tuples(COMPONENT, COMPONENT, COMPONENT).filter(lambda vector: math.hypot(*vector) > 1e-3))
def test_axes_are_orthonormal_and_right_handed(vector):
    normal = tuple(float(value) for value in np.array(vector) / math.hypot(*vector))
    axes = ContactPoint(position_m=ORIGIN, normal=normal).axes()

    assert axes[0] == pytest.approx(normal, abs=1e-12)
    assert axes @ axes.T == pytest.approx(np.eye(3), abs=1e-12)
    assert np.linalg.det(axes) == pytest.approx(1.0)


@pytest.mark.parametrize(
    ("normal", "tangent", "first"),
    [
        (X, None, (0.0, 0.0, 1.0)),
        ((0.0, -1.0, 0.0), None, (0.0, 0.0, 1.0)),
        ((0.0, 0.0, 1.0), None, X),
        (X, (5.0, 2.0, 0.0), (0.0, 1.0, 0.0)),
        ((0.0, 0.0, 1.0), (0.0, -3.0, 1.0), (0.0, -1.0, 0.0)),
    ],
)
def test_the_first_tangent(normal, tangent, first):
    assert ContactPoint(position_m=ORIGIN, normal=normal, tangent=tangent).axes()[1] == pytest.approx(first)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"normal": (1.0, 1.0, 0.0)}, "the normal of a contact has the length 1.41421356 (give it the length 1)"),
        ({"normal": ORIGIN}, "the normal of a contact has the length 0 (give it the length 1)"),
        (
            {"position_m": (0.0, math.nan, 0.0)},
            "a contact cannot have the position_m (0.0, nan, 0.0) (give three finite numbers)",
        ),
        ({"tangent": (0.0, 1.0)}, "a contact cannot have the tangent (0.0, 1.0) (give three finite numbers)"),
        (
            {"tangent": (-2.0, 0.0, 0.0)},
            (
                "the tangent (-2.0, 0.0, 0.0) of a contact has no direction in its tangent plane "
                "(give a vector that is not along the normal)"
            ),
        ),
        ({"friction": -0.1}, "a contact cannot have the friction -0.1 (give a number from 0)"),
        ({"friction": math.inf}, "a contact cannot have the friction inf (give a number from 0)"),
        ({"normal_force_n": -1.0}, "a contact cannot have the normal_force_n -1 (give a number from 0)"),
        (
            {"torsional_friction_m": math.nan},
            "a contact cannot have the torsional_friction_m nan (give a number from 0)",
        ),
        ({"gap_m": math.inf}, "a contact cannot have the gap_m inf (give a finite number)"),
    ],
)
def test_what_is_no_contact(change, message):
    with pytest.raises(DefinitionError) as caught:
        ContactPoint(**{"position_m": ORIGIN, "normal": X, **change})

    assert str(caught.value) == message
