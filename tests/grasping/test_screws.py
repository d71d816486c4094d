"""Twists and wrenches: power does not depend on the point that they are about."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rgss.grasping import Twist, Wrench, reciprocal_product

VECTOR = st.tuples(*[st.floats(-10.0, 10.0)] * 3)


def test_power_of_a_force_and_of_a_torque():
    twist = Twist(angular_rad_s=(0.0, 0.0, 2.0), linear_m_s=(1.0, 0.0, 0.0))

    assert reciprocal_product(twist, Wrench(force_n=(3.0, 5.0, 7.0))) == 3.0
    assert reciprocal_product(twist, Wrench(torque_n_m=(3.0, 5.0, 7.0))) == 14.0


def test_a_turning_body_moves_about_its_axis():
    turning = Twist(angular_rad_s=(0.0, 0.0, 2.0))

    assert turning.moved((0.5, 0.0, 0.0)).linear_m_s == (0.0, 1.0, 0.0)
    assert Wrench(force_n=(0.0, 4.0, 0.0)).moved((-0.5, 0.0, 0.0)).torque_n_m == (0.0, 0.0, 2.0)


@given(VECTOR, VECTOR, VECTOR, VECTOR, VECTOR)
def test_power_is_the_same_about_every_point(spin, velocity, torque, force, offset):
    twist, wrench = Twist(angular_rad_s=spin, linear_m_s=velocity), Wrench(torque_n_m=torque, force_n=force)
    moved = reciprocal_product(twist.moved(offset), wrench.moved(offset))

    assert moved == pytest.approx(reciprocal_product(twist, wrench), abs=1e-9)


def test_a_screw_is_reciprocal_to_a_force_through_its_axis():
    turning = Twist(angular_rad_s=(1.0, 2.0, 3.0))

    assert reciprocal_product(turning, Wrench(force_n=(4.0, -1.0, 9.0))) == 0.0
