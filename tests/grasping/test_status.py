"""Contacts in words."""

from __future__ import annotations

import pytest

from rgss.grasping import (
    BodyMotion,
    ContactMotion,
    ContactPoint,
    ContactState,
    ContactTolerances,
    Curvature,
    Sliding,
    Tendency,
    Twist,
    contact_normal_wrench,
    contact_status,
    relative_motion,
    twist_tendency,
)

ORIGIN = (0.0, 0.0, 0.0)
X, Z = (1.0, 0.0, 0.0), (0.0, 0.0, 1.0)


def motion_of(gap=0.0, rate=0.0, acceleration=0.0, slip=0.0, slip_rate=0.0):
    return ContactMotion(
        gap_m=gap,
        gap_rate_m_s=rate,
        gap_acceleration_m_s2=acceleration,
        tangential_velocity_m_s=(0.0, slip, 0.0),
        tangential_acceleration_m_s2=None if slip_rate is None else (0.0, 0.0, slip_rate),
    )


@pytest.mark.parametrize(
    ("gap", "state"),
    [
        (1e-3, ContactState.SEPARATED),
        (1e-7, ContactState.TOUCHING),
        (-1e-7, ContactState.TOUCHING),
        (-1e-3, ContactState.PENETRATING),
    ],
)
def test_the_gap_says_the_state(gap, state):
    status = contact_status(motion_of(gap=gap))

    assert status.state is state
    assert (status.sliding is None) == (state is ContactState.SEPARATED)


@pytest.mark.parametrize(
    ("rate", "acceleration", "tendency"),
    [
        (0.1, -5.0, Tendency.SEPARATING),
        (-0.1, 5.0, Tendency.PENETRATING),
        (0.0, 5.0, Tendency.SEPARATING),
        (0.0, -5.0, Tendency.PENETRATING),
        (0.0, 0.0, Tendency.STAYING),
        (0.0, None, Tendency.STAYING),
    ],
)
def test_the_first_derivative_that_is_not_zero_says_the_tendency(rate, acceleration, tendency):
    assert contact_status(motion_of(rate=rate, acceleration=acceleration)).tendency is tendency


@pytest.mark.parametrize(
    ("slip", "slip_rate", "sliding"),
    [
        (0.0, 0.0, Sliding.ROLLING),
        (0.0, None, Sliding.ROLLING),
        (0.0, 1.0, Sliding.SLIP_EMERGING),
        (0.1, 0.0, Sliding.SLIPPING),
        (0.1, 1.0, Sliding.SLIPPING),
    ],
)
def test_rolling_and_slipping(slip, slip_rate, sliding):
    assert contact_status(motion_of(slip=slip, slip_rate=slip_rate)).sliding is sliding


def test_tolerances_say_what_counts_as_zero():
    motion = motion_of(gap=-1e-4, rate=1e-4, acceleration=1e-2, slip=1e-4, slip_rate=1e-2)
    wide = ContactTolerances(gap_m=1e-3, speed_m_s=1e-3, acceleration_m_s2=0.1)
    status = contact_status(motion, wide)

    assert (status.state, status.tendency, status.sliding) == (
        ContactState.TOUCHING,
        Tendency.STAYING,
        Sliding.ROLLING,
    )


@pytest.mark.parametrize(
    ("spin_share", "acceleration", "sliding"),
    [(1.0, 0.0, Sliding.ROLLING), (0.5, 0.0, Sliding.SLIPPING), (1.0, 3.0, Sliding.SLIP_EMERGING)],
)
def test_a_ball_on_a_floor(spin_share, acceleration, sliding):
    radius, speed = 0.5, 2.0
    ball = BodyMotion(
        reference_m=(0.0, 0.0, radius),
        twist=Twist(angular_rad_s=(0.0, spin_share * speed / radius, 0.0), linear_m_s=(speed, 0.0, 0.0)),
        linear_acceleration_m_s2=(acceleration, 0.0, 0.0),
    )
    motion = relative_motion(
        ContactPoint(position_m=ORIGIN, normal=Z),
        BodyMotion(reference_m=ORIGIN, twist=Twist()),
        ball,
        finger_curvature=Curvature(along_per_m=0.0, across_per_m=0.0, direction=X),
        object_curvature=Curvature(along_per_m=1 / radius, across_per_m=1 / radius, direction=X),
    )
    status = contact_status(motion)

    assert (status.state, status.tendency) == (ContactState.TOUCHING, Tendency.STAYING)
    assert status.sliding is sliding


def test_the_wrench_of_a_unit_normal_force():
    wrench = contact_normal_wrench(ContactPoint(position_m=(0.0, 0.2, 0.0), normal=X), (0.0, 0.0, 0.1))

    assert wrench.force_n == X
    assert wrench.torque_n_m == pytest.approx((0.0, -0.1, -0.2))


@pytest.mark.parametrize(
    ("twist", "finger_velocity", "tendency"),
    [
        (Twist(linear_m_s=(0.1, 5.0, 0.0)), ORIGIN, Tendency.SEPARATING),
        (Twist(linear_m_s=(-0.1, 0.0, 0.0)), ORIGIN, Tendency.PENETRATING),
        (Twist(linear_m_s=(0.0, 1.0, 1.0)), ORIGIN, Tendency.STAYING),
        (Twist(angular_rad_s=Z), ORIGIN, Tendency.PENETRATING),
        (Twist(angular_rad_s=(0.0, 0.0, -1.0)), ORIGIN, Tendency.SEPARATING),
        (Twist(linear_m_s=(0.1, 0.0, 0.0)), (0.3, 0.0, 0.0), Tendency.PENETRATING),
        (Twist(linear_m_s=(-0.1, 0.0, 0.0)), (-0.1, 9.0, 0.0), Tendency.STAYING),
    ],
)
def test_what_a_twist_does_to_a_contact(twist, finger_velocity, tendency):
    contact = ContactPoint(position_m=(-0.03, 0.01, 0.0), normal=X)

    assert twist_tendency(twist, contact, ORIGIN, finger_velocity_m_s=finger_velocity) is tendency
