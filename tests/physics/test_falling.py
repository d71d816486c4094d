"""A body that nothing holds, against the law of the fall."""

import math

import pytest

from rgss.scenes import Pose

from .speeds import workpiece_speed

pytestmark = pytest.mark.engine

HIGH = Pose.from_roll_pitch_yaw((1.6, 1.6, 2.0), (0.3, -0.2, 0.5))


@pytest.mark.parametrize("rate_hz", [240.0, 1000.0])
def test_the_cup_falls_by_the_integrators_sum_exactly(three_fingers, rate_hz):
    """Speed is advanced before position, so after n steps the fall is g h² n (n + 1) / 2 and not g t² / 2."""
    steps = round(0.5 * rate_hz)
    with three_fingers.world(rate_hz=rate_hz, **three_fingers.with_workpiece(pose=HIGH)) as world:
        for _ in range(steps):
            world.step()
        pose, (linear, angular) = world.workpiece_pose(), workpiece_speed(world)
    step_s, time_s = 1 / rate_hz, steps / rate_hz
    fall = HIGH.position_m[2] - pose.position_m[2]
    assert fall == pytest.approx(9.81 * step_s**2 * steps * (steps + 1) / 2, rel=1e-12)
    assert fall - 9.81 * time_s**2 / 2 == pytest.approx(9.81 * time_s * step_s / 2, rel=1e-9)
    assert linear == pytest.approx(9.81 * time_s, rel=1e-12)
    # Nothing pushes it aside and nothing turns it.
    assert pose.position_m[:2] == HIGH.position_m[:2]
    assert pose.quaternion_xyzw == pytest.approx(HIGH.quaternion_xyzw, abs=1e-12)
    assert angular == 0.0


def test_a_tossed_cup_keeps_its_sideways_speed_and_its_spin(three_fingers):
    with three_fingers.world(**three_fingers.with_workpiece(pose=Pose(position_m=(-1.6, 1.6, 2.0)))) as world:
        world._engine.resetBaseVelocity(
            world._workpiece, (0.4, -0.3, 0.0), (0.0, 0.0, 2.0), physicsClientId=world._client
        )
        for _ in range(120):
            world.step()
        x, y, _ = world.workpiece_pose().position_m
        linear, angular = workpiece_speed(world)
    assert (x, y) == pytest.approx((-1.6 + 0.2, 1.6 - 0.15), abs=1e-9)
    assert linear == pytest.approx(math.hypot(0.5, 9.81 * 0.5), rel=1e-9)
    assert angular == pytest.approx(2.0, rel=1e-9)


def test_speed_is_that_of_centre_and_turn(three_fingers):
    with three_fingers.world() as world:
        assert workpiece_speed(world) == (0.0, 0.0)
        world._engine.resetBaseVelocity(
            world._workpiece, (3.0, 0.0, 4.0), (2.0, 3.0, 6.0), physicsClientId=world._client
        )
        assert workpiece_speed(world) == pytest.approx((5.0, 7.0))


def test_the_cup_stands_where_the_scene_puts_it_and_stays(three_fingers):
    start = three_fingers.scene.workpiece.pose
    with three_fingers.world() as world:
        assert world.workpiece_pose() == start
        world.reset_arm(three_fingers.scene.robot.home_rad)
        for _ in range(240):
            world.step()
        moved = math.dist(world.workpiece_pose().position_m, start.position_m)
        tilt, (linear, _) = world.workpiece_pose().tilt_rad, workpiece_speed(world)
    assert moved < 1e-4
    assert tilt < 1e-4
    assert linear < 1e-4
