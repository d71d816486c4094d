"""What moves in the hand, against motions that are known."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rgss.physics import HandView, PhysicsSettings
from rgss.scenes import Pose
from rgss.trials.monitors.in_hand_motion import HandMotion, InHandMotionTracker

SPAN_S = 0.02
HELD = Pose.from_roll_pitch_yaw((0.01, -0.02, 0.03), (math.pi, 0.1, 0.4))


def motion(before, held, closing=(0.0, 0.0)):
    return HandMotion(before, held, closing, SPAN_S)


def shifted(pose, dx, dy, dz):
    x, y, z = pose.position_m
    return Pose(position_m=(x + dx, y + dy, z + dz), quaternion_xyzw=pose.quaternion_xyzw)


def test_nothing_moves():
    still = motion(HELD, HELD)

    assert still.velocity_at((0.03, 0.0, 0.01)) == pytest.approx((0.0, 0.0, 0.0), abs=1e-15)
    assert still.twist()[0] + still.twist()[1] == pytest.approx((0.0,) * 6, abs=1e-12)


def test_an_object_that_slides_has_one_velocity_everywhere():
    sliding = motion(HELD, shifted(HELD, 0.001, 0.0, -0.002))
    inside = Pose(quaternion_xyzw=HELD.inverse().quaternion_xyzw)
    expected = inside.rotate((0.05, 0.0, -0.1))

    for point in ((0.0, 0.0, 0.0), (0.03, -0.01, 0.04)):
        assert sliding.velocity_at(point) == pytest.approx(expected)
    assert sliding.twist() == (pytest.approx((0.05, 0.0, -0.1)), pytest.approx((0.0, 0.0, 0.0), abs=1e-12))


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_an_object_that_turns_has_an_angular_velocity(sign):
    # By a hundredth of a radian about the hand's z, whichever of the two quaternions stands for it.
    turn = Pose.from_roll_pitch_yaw((0.0, 0.0, 0.0), (0.0, 0.0, 0.01))
    turned = (turn @ Pose(quaternion_xyzw=HELD.quaternion_xyzw)).quaternion_xyzw
    turning = motion(HELD, Pose(position_m=HELD.position_m, quaternion_xyzw=tuple(sign * q for q in turned)))
    linear, angular = turning.twist()

    assert linear == (0.0, 0.0, 0.0)
    assert angular == pytest.approx((0.0, 0.0, 0.5), rel=1e-4)
    # A point of the wall moves with the radius times that.
    assert math.hypot(*turning.velocity_at((0.0, 0.0, 0.05))) < math.hypot(*turning.velocity_at((0.035, 0.0, 0.0)))
    assert math.hypot(*turning.velocity_at((0.0, 0.035, 0.0))) == pytest.approx(0.035 * 0.5, rel=0.02)


class Hand:
    """A world with nothing but a tool, an object and two fingers."""

    settings = PhysicsSettings(rate_hz=100.0)

    def __init__(self):
        self.tool = Pose(position_m=(1.0, 2.0, 3.0))
        self.workpiece = self.tool @ HELD
        self.travel = (0.0, 0.0)

    def hand_view(self):
        return HandView(
            self.workpiece.position_m,
            self.workpiece.quaternion_xyzw,
            self.tool.position_m,
            self.tool.quaternion_xyzw,
            (0.0, 0.0, 0.0),
            self.travel,
        )


def test_the_last_two_looks_make_a_motion():
    hand = Hand()
    watch = InHandMotionTracker(hand)
    assert watch.look(0).held.position_m == pytest.approx(HELD.position_m)
    assert watch.motion.closing_m_s == (0.0, 0.0)
    assert watch.motion.before == watch.motion.held

    hand.travel = (0.001, 0.002)
    hand.workpiece = hand.tool @ shifted(HELD, 0.0, 0.0, 0.003)
    held = watch.look(10).held
    assert watch.motion.span_s == pytest.approx(0.1)
    assert watch.motion.closing_m_s == pytest.approx((0.01, 0.02))
    assert watch.motion.twist()[0] == pytest.approx((0.0, 0.0, 0.03))
    assert held == watch.motion.held

    # The arm takes the object with it: nothing moves in the hand.
    hand.tool = Pose.from_roll_pitch_yaw((0.0, 1.0, 2.0), (0.3, 0.2, 0.1))
    hand.workpiece = hand.tool @ held
    watch.look(12)
    assert watch.motion.span_s == pytest.approx(0.02)
    assert watch.motion.twist()[0] == pytest.approx((0.0, 0.0, 0.0), abs=1e-12)


def test_looking_twice_at_the_same_time_changes_nothing():
    hand = Hand()
    watch = InHandMotionTracker(hand)
    hand.travel = (0.001, 0.001)
    watch.look(5)
    before = watch.motion
    watch.look(5)

    assert watch.motion is before


@given(angles=st.tuples(*[st.floats(-3.0, 3.0)] * 6), places=st.tuples(*[st.floats(-2.0, 2.0)] * 9))
def test_where_the_object_is_held_is_told_to_the_bit_as_by_the_transform(angles, places):
    flange, workpiece = (
        Pose.from_roll_pitch_yaw(places[:3], angles[:3]),
        Pose.from_roll_pitch_yaw(places[3:6], angles[3:]),
    )
    centre = Pose(position_m=places[6:])
    view = HandView(
        workpiece.position_m,
        workpiece.quaternion_xyzw,
        flange.position_m,
        flange.quaternion_xyzw,
        centre.position_m,
        (),
    )
    assert view.held_at_m == view.held.position_m
    assert view.tool.position_m == pytest.approx((flange @ centre).position_m)
    assert view.held_at_m == pytest.approx(((flange @ centre).inverse() @ workpiece).position_m, abs=1e-9)
