"""Rigid-body measures: metric, norms, and their duality."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rgss.errors import DefinitionError
from rgss.grasping import (
    Twist,
    Wrench,
    configuration_distance_m,
    reciprocal_product,
    twist_inner_product,
    velocity_norm_m_s,
    wrench_inner_product,
    wrench_norm_n,
)
from rgss.scenes import Pose

COMPONENT = st.floats(-3.0, 3.0)
VECTOR = st.tuples(COMPONENT, COMPONENT, COMPONENT)
POSE = st.builds(Pose.from_roll_pitch_yaw, VECTOR, VECTOR)
LENGTH = st.floats(0.01, 10.0)


def test_moving_and_turning_add_in_squares():
    start = Pose(position_m=(1.0, 2.0, 3.0))
    turned = Pose.from_roll_pitch_yaw((1.0, 2.0, 3.3), (0.0, 0.0, math.pi / 2))

    assert configuration_distance_m(start, start, 0.1) == 0.0
    assert configuration_distance_m(start, start.raised(0.3), 0.1) == pytest.approx(0.3)
    assert configuration_distance_m(start, turned, 0.1) == pytest.approx(math.hypot(0.3, 0.05 * math.pi))


def test_a_turn_is_the_short_way_round():
    most = Pose.from_roll_pitch_yaw((0.0, 0.0, 0.0), (0.0, 0.0, 1.5 * math.pi))

    assert configuration_distance_m(Pose(), most, 1.0) == pytest.approx(math.pi / 2)


@given(POSE, POSE, POSE, LENGTH)
def test_the_distance_is_a_metric_and_the_same_in_every_frame(first, second, third, length):
    def distance(a, b):
        return configuration_distance_m(a, b, length)

    assert distance(first, second) == pytest.approx(distance(second, first), abs=1e-6)
    assert distance(first, third) <= distance(first, second) + distance(second, third) + 1e-6
    assert distance(third @ first, third @ second) == pytest.approx(distance(first, second), abs=1e-6)


@given(VECTOR, VECTOR, VECTOR, VECTOR, LENGTH)
def test_power_is_at_most_the_product_of_the_norms(spin, velocity, torque, force, length):
    twist, wrench = Twist(angular_rad_s=spin, linear_m_s=velocity), Wrench(torque_n_m=torque, force_n=force)
    bound = velocity_norm_m_s(twist, length) * wrench_norm_n(wrench, length)

    assert abs(reciprocal_product(twist, wrench)) <= bound * (1 + 1e-12) + 1e-12


@given(VECTOR, VECTOR, VECTOR, VECTOR, LENGTH)
def test_inner_products_are_symmetric_and_bounded(first, second, third, fourth, length):
    twists = [Twist(angular_rad_s=first, linear_m_s=second), Twist(angular_rad_s=third, linear_m_s=fourth)]
    wrenches = [Wrench(torque_n_m=first, force_n=second), Wrench(torque_n_m=third, force_n=fourth)]
    for (one, other), product, norm in (
        (twists, twist_inner_product, velocity_norm_m_s),
        (wrenches, wrench_inner_product, wrench_norm_n),
    ):
        value = product(one, other, length)
        assert value == product(other, one, length)
        assert abs(value) <= norm(one, length) * norm(other, length) * (1 + 1e-9) + 1e-12


def test_numbers():
    assert velocity_norm_m_s(Twist(angular_rad_s=(0.0, 0.0, 2.0), linear_m_s=(0.3, 0.0, 0.0)), 0.2) == pytest.approx(
        0.5
    )
    assert wrench_norm_n(Wrench(torque_n_m=(0.0, 0.0, 0.8), force_n=(3.0, 0.0, 0.0)), 0.2) == pytest.approx(5.0)


@pytest.mark.parametrize("length", [0.0, -1.0, math.inf, math.nan])
def test_a_length_is_positive(length):
    for measure in (
        lambda: configuration_distance_m(Pose(), Pose(), length),
        lambda: velocity_norm_m_s(Twist(), length),
        lambda: wrench_norm_n(Wrench(), length),
    ):
        with pytest.raises(DefinitionError) as caught:
            measure()
        assert (
            str(caught.value)
            == f"a characteristic length must be positive, got {length:g} m (give a length above zero)"
        )
