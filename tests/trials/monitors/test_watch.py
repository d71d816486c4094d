"""What a phase's watch makes of contacts and poses, in a world that says what the test wants."""

from __future__ import annotations

import math
import re
from dataclasses import replace

import numpy as np
import pytest

from rgss.evidence import Failure
from rgss.physics import Contacts, HandView, PhysicsSettings
from rgss.scenes import Pose
from rgss.trials.monitors.force_sensor import ForceSensor
from rgss.trials.monitors.phase_monitor import PhaseMonitor
from rgss.trials.plants.control import ControlSettings

CONTROL = ControlSettings()
QUIET = Contacts(
    finger_forces_n=(0.0, 0.0, 0.0),
    other_force_n=0.0,
    pressed=(),
    robot_bodies=(),
    workpiece_bodies=(),
    pressing_links=(),
)
TOOL = Pose(position_m=(0.1, 0.2, 0.3), quaternion_xyzw=(1.0, 0.0, 0.0, 0.0))
# The tool points down, and the object stands upright in it.
HELD = Pose(position_m=(0.0, 0.0, 0.01), quaternion_xyzw=(1.0, 0.0, 0.0, 0.0))


class ScriptedWorld:
    """Stands in for the physics: every answer is an attribute that the test sets."""

    def __init__(self, spec):
        self.scene = spec.scene
        self.gripper = spec.gripper
        self.settings = PhysicsSettings()
        self.now = QUIET
        self.tool = TOOL
        self.workpiece = TOOL @ HELD
        self.torques = (0.0,) * 6
        self.velocity = (0.0, 0.0, 0.0)
        self.reach_m = 1.0
        self.grip_fault = ""

    def contacts(self, standing=None):
        return self.now

    def finger_contacts(self):
        return ()

    def finger_travel_m(self):
        return (0.0,) * self.gripper.geometry.fingers

    def hand_view(self):
        workpiece, tool = self.workpiece_pose(), self.tool
        return HandView(
            workpiece.position_m,
            workpiece.quaternion_xyzw,
            tool.position_m,
            tool.quaternion_xyzw,
            (0.0, 0.0, 0.0),
            self.finger_travel_m(),
        )

    def workpiece_pose(self):
        return self.workpiece

    def arm_state(self):
        """The joints of a robot that slides along three axes, so that they are the tool's coordinates."""
        return (*self.tool.position_m, 0.0, 0.0, 0.0), (*self.velocity, 0.0, 0.0, 0.0), self.torques

    def tool_motion(self, qs, dqs):
        return np.array(qs)[:, :3], np.array(dqs)[:, :3]


@pytest.fixture
def world(spec_of):
    return ScriptedWorld(spec_of())


def watch_of(world, *, carried=False, resting_on="", sensor=None):
    world.path_m = [TOOL.position_m]
    held = HELD if carried else None
    return PhaseMonitor(
        world, world, CONTROL, carried_at=held, resting_on=resting_on, path_m=world.path_m, sensor=sensor
    )


def contacts(*forces, other=0.0, robot=(), workpiece=()):
    return Contacts(
        finger_forces_n=forces or (0.0, 0.0),
        other_force_n=other,
        pressed=(),
        robot_bodies=robot,
        workpiece_bodies=workpiece,
        pressing_links=("forearm_link", "gripper_base") if other > 0.0 else (),
    )


def seen(world, watch, what, steps=1, load=9.81):
    world.now = what
    for _ in range(steps):
        watch.after_step(load, None)
    return watch.failure, watch.detail


def test_nothing_happens(world):
    watch = watch_of(world)

    assert seen(world, watch, QUIET, steps=100) == (None, "")
    metrics = watch.metrics()
    assert metrics["arm_scene_contacts"] == 0
    assert metrics["slip_m"] is None
    assert metrics["grip_margin_min"] is None


@pytest.mark.parametrize(
    ("what", "failure", "detail"),
    [
        (contacts(robot=(("forearm_link", "shelf"),)), Failure.ARM_COLLISION, "forearm_link touched shelf"),
        (
            contacts(other=1.234),
            Failure.OBJECT_COLLISION,
            "forearm_link and gripper_base pressed the object with 1.23 N",
        ),
        (contacts(workpiece=("menu_stand",)), Failure.OBJECT_COLLISION, "the object touched menu_stand"),
        (
            contacts(3.0, 2.4 * 40.5),  # in one of the 2.4 steps of 10 ms
            Failure.OBJECT_DAMAGED,
            "a finger pressed with 40.50 N over 10 ms, above its limit of 40 N",
        ),
    ],
)
def test_what_must_not_be_touched(world, what, failure, detail):
    watch = watch_of(world, resting_on="counter_pick")

    assert seen(world, watch, what) == (failure, detail)
    assert watch.metrics()["arm_scene_contacts"] == len(what.robot_bodies)


def test_the_object_may_touch_what_it_rests_on(world):
    assert seen(world, watch_of(world, resting_on="counter_pick"), contacts(workpiece=("counter_pick",)))[0] is None
    assert seen(world, watch_of(world), contacts(workpiece=("counter_pick",)))[0] is Failure.OBJECT_COLLISION


def test_the_object_bears_its_limit(world):
    assert seen(world, watch_of(world), contacts(40.0, 40.0), steps=10)[0] is None
    assert seen(world, watch_of(world), contacts(40.0, 40.1), steps=10)[0] is Failure.OBJECT_DAMAGED


def test_the_sensors_go_on_from_one_phase_to_the_next_and_forget_what_has_been_let_go(world):
    sensor = ForceSensor(0.01, world.settings.rate_hz)
    first = watch_of(world, sensor=sensor)
    seen(world, first, contacts(48.0, 0.0), steps=1)
    assert first.metrics()["sensed_finger_force_n"] == pytest.approx(20.0)
    second = watch_of(world, sensor=sensor)
    seen(world, second, contacts(48.0, 0.0), steps=1)
    assert second.metrics()["sensed_finger_force_n"] == pytest.approx(40.0)
    seen(world, second, contacts(0.0, 0.0), steps=1)
    world.now = contacts()
    second.after_step(9.81, (*TOOL.position_m, 0.0, 0.0, 0.0))
    third = watch_of(world, sensor=sensor)
    seen(world, third, contacts(2.4, 0.0))
    assert third.metrics()["sensed_finger_force_n"] == pytest.approx(1.0)


def test_the_first_failure_counts(world):
    watch = watch_of(world)
    seen(world, watch, contacts(other=2.0))

    assert seen(world, watch, contacts(robot=(("wrist", "lamp"),)))[0] is Failure.OBJECT_COLLISION


def test_the_peak_force_is_the_largest_of_one_finger(world):
    watch = watch_of(world)
    for forces in ((3.0, 4.0), (9.5, 1.0), (2.0, 8.0)):
        seen(world, watch, contacts(*forces))

    assert watch.metrics()["peak_finger_force_n"] == 9.5


def test_a_held_object_has_the_margin_of_coulombs_law(world):
    watch = watch_of(world, carried=True)
    seen(world, watch, contacts(10.0, 10.0), steps=48, load=11.0)

    friction = world.gripper.friction * world.scene.workpiece.friction
    margin = friction * 20.0 / (world.scene.workpiece.mass_kg * 11.0)
    assert watch.metrics()["grip_margin_min"] == pytest.approx(margin)
    assert watch.failure is None


def test_the_margin_is_the_smallest_while_carrying(world):
    watch = watch_of(world, carried=True)
    for force in (10.0, 4.0, 10.0):
        seen(world, watch, contacts(force, force), steps=48, load=9.81)

    friction = world.gripper.friction * world.scene.workpiece.friction
    assert watch.metrics()["grip_margin_min"] == pytest.approx(friction * 8.0 / (world.scene.workpiece.mass_kg * 9.81))


def test_an_object_that_one_finger_touches_for_long_is_dropped(world):
    watch = watch_of(world, carried=True)
    steps = math.ceil(CONTROL.lost_contact_s / world.settings.step_s)

    assert seen(world, watch, contacts(10.0, 0.0), steps=steps - 1)[0] is None
    failure, detail = seen(world, watch, contacts(10.0, 0.0), steps=2)
    assert failure is Failure.OBJECT_DROPPED
    assert re.fullmatch("1 fingers touched the object for 5[04] ms", detail)


def test_a_touch_of_two_fingers_in_between_is_enough(world):
    watch = watch_of(world, carried=True)
    steps = math.ceil(CONTROL.lost_contact_s / world.settings.step_s) - 1
    for _ in range(5):
        seen(world, watch, contacts(0.0, 0.0), steps=steps)
        seen(world, watch, contacts(1.0, 1.0))

    assert watch.failure is None


def test_fingers_may_let_go_of_what_is_not_carried(world):
    assert seen(world, watch_of(world), contacts(0.0, 0.0), steps=100)[0] is None


def test_slip_is_the_displacement_in_the_gripper(world):
    watch = watch_of(world, carried=True)
    looked = 4  # steps from one look to the next
    # Arm and object moved together: no slip.
    moved = Pose(position_m=(0.5, -0.4, 0.9), quaternion_xyzw=(0.0, 1.0, 0.0, 0.0))
    world.tool, world.workpiece = moved, moved @ HELD
    seen(world, watch, contacts(9.0, 9.0), steps=looked)
    assert watch.metrics()["slip_m"] == pytest.approx(0.0, abs=1e-12)

    world.workpiece = moved @ replace(HELD, position_m=(0.0, 0.004, 0.013))
    seen(world, watch, contacts(9.0, 9.0), steps=looked)
    assert watch.metrics()["slip_m"] == pytest.approx(0.005)
    assert watch.failure is None

    world.workpiece = moved @ replace(HELD, position_m=(0.0, 0.0, 0.0305))
    assert seen(world, watch, contacts(9.0, 9.0), steps=looked) == (
        Failure.OBJECT_DROPPED,
        "the object slipped 20.5 mm in the gripper",
    )


@pytest.mark.parametrize(("tilt_deg", "is_dropped"), [(0.0, False), (46.9, False), (47.1, True), (91.0, True)])
def test_a_carried_object_is_tilted_by_no_more_than_the_task_allows(world, tilt_deg, is_dropped):
    """45 deg, and 2 deg more; by a turn in the hand or of the hand."""
    turned = Pose.from_roll_pitch_yaw((0.0, 0.0, 0.0), (0.0, math.radians(tilt_deg), 0.0))
    for watch in (watch_of(world, carried=True), watch_of(world, carried=False)):
        is_carried = watch.metrics()["slip_m"] is not None
        world.workpiece = TOOL @ HELD @ turned
        found, told = seen(world, watch, contacts(9.0, 9.0), steps=4)
        if is_carried and is_dropped:
            assert found is Failure.OBJECT_DROPPED
            assert told == f"the object tilted by {tilt_deg:.0f} deg in the gripper, more than the 45 deg of the task"
        else:
            assert told.count("tilted") == 0


def test_the_object_is_looked_at_when_the_phase_ends(world):
    watch = watch_of(world, carried=True)
    world.workpiece = TOOL @ replace(HELD, position_m=(0.0, 0.003, 0.01))
    seen(world, watch, contacts(9.0, 9.0))
    assert watch.metrics()["slip_m"] == 0.0

    watch.finish()
    assert watch.metrics()["slip_m"] == pytest.approx(0.003)


def test_the_grasp_is_sampled_twice_a_second_and_at_the_end(world):
    watch = watch_of(world, carried=True)
    seen(world, watch, contacts(9.0, 9.0), steps=250)
    assert watch.metrics()["grasp_samples"] == 2

    watch.finish()
    metrics = watch.metrics()
    assert metrics["grasp_samples"] == 3
    # The scripted world has no contacts to analyse: such a grasp holds nothing.
    assert (metrics["grasp_samples_closed"], metrics["grasp_force_closure"], metrics["grasp_q_smw_n"]) == (0, 0, 0.0)
    assert (metrics["held_distance_m"], metrics["held_speed_m_s"]) == pytest.approx((0.0, 0.0), abs=1e-12)
    assert "contact_gap_min_m" not in metrics


def test_a_sample_at_the_end_is_not_counted_twice(world):
    watch = watch_of(world, carried=True)
    seen(world, watch, contacts(9.0, 9.0), steps=240)
    watch.finish()

    assert watch.metrics()["grasp_samples"] == 2


def follow(world, watch, commanded, steps=1):
    for _ in range(steps):
        world.path_m.append(commanded)
        watch.after_step(9.81, (*commanded, 0.0, 0.0, 0.0))


def test_a_tool_that_strays_is_a_failure(world):
    watch = watch_of(world)
    follow(world, watch, (0.1, 0.2, 0.3015))
    assert watch.failure is None
    assert watch.metrics()["tracking_error_m"] == pytest.approx(0.0015)

    follow(world, watch, (0.1, 0.2, 0.3025))
    assert (watch.failure, watch.detail) == (
        Failure.TRACKING_ERROR,
        "the tool was 2.50 mm from its target",
    )


def test_a_tool_that_strays_because_joints_are_at_their_limit_names_them(world):
    watch = watch_of(world)
    limits = [joint.torque_n_m for joint in world.scene.robot.joints]
    names = [joint.name for joint in world.scene.robot.joints]
    for saturated in ((2,), (0, 2)):
        world.torques = tuple(-limit if index in saturated else 0.1 * limit for index, limit in enumerate(limits))
        follow(world, watch, TOOL.position_m, steps=3)
    follow(world, watch, (0.1, 0.2, 0.4))

    assert watch.failure is Failure.TRACKING_ERROR
    assert watch.detail == (f"the tool was 100.00 mm from its target; at its torque limit: {names[2]}, then {names[0]}")
    metrics = watch.metrics()
    step_s = world.settings.step_s
    assert metrics["joint_saturated_s"] == pytest.approx((4 * step_s, 0.0, 7 * step_s, 0.0, 0.0, 0.0))
    assert metrics["peak_joint_torque_ratio"] == 1.0
    assert metrics["most_loaded_joint"] == 1


def test_no_saturation_between_two_looks_is_missed(world):
    watch = watch_of(world, carried=True)
    limits = [joint.torque_n_m for joint in world.scene.robot.joints]
    for index in range(8):
        world.torques = tuple(limits) if index == 2 else (0.0,) * 6
        seen(world, watch, contacts(9.0, 9.0))

    assert watch.metrics()["joint_saturated_s"] == pytest.approx((world.settings.step_s,) * 6)


def test_the_torque_ratio_is_the_largest_share_of_a_joints_limit(world):
    watch = watch_of(world)
    limits = [joint.torque_n_m for joint in world.scene.robot.joints]
    for torques in ((-0.5 * limits[0], 0.0, 0.0, 0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 0.0, 0.25 * limits[4], 0.0)):
        world.torques = torques
        watch.after_step(9.81, None)

    metrics = watch.metrics()
    assert metrics["peak_joint_torque_ratio"] == pytest.approx(0.5)
    assert metrics["most_loaded_joint"] == 1
    assert metrics["peak_joint_torque_n_m"] == pytest.approx((0.5 * limits[0], 0, 0, 0, 0.25 * limits[4], 0))
    assert metrics["joint_saturated_s"] == (0.0,) * 6
    assert metrics["tracking_error_m"] == 0.0


def test_the_tool_is_measured_while_it_follows(world):
    watch = watch_of(world)
    follow(world, watch, TOOL.position_m)
    assert watch.metrics()["peak_tool_speed_m_s"] == 0.0

    world.velocity = (0.3, 0.0, -0.4)
    follow(world, watch, TOOL.position_m)
    world.velocity = (0.1, 0.0, 0.0)
    follow(world, watch, TOOL.position_m)
    assert watch.metrics()["peak_tool_speed_m_s"] == pytest.approx(0.5)


def test_the_acceleration_is_averaged_as_a_sensor_does(world):
    watch = watch_of(world)
    step_s = world.settings.step_s
    for index in range(1, 25):
        # 2 m/s² along x, with a ripple that from one step to the next is 96 m/s².
        world.velocity = (2.0 * index * step_s + (0.4 if index == 12 else 0.0), 0.0, 0.0)
        follow(world, watch, TOOL.position_m)
    window_s = round(CONTROL.acceleration_window_s / step_s) * step_s

    assert watch.metrics()["peak_tool_acceleration_m_s2"] == pytest.approx(2.0 + 0.4 / window_s)


def test_a_tool_that_is_not_followed_is_not_measured(world):
    watch = watch_of(world)
    world.velocity = (1.0, 0.0, 0.0)
    seen(world, watch, QUIET, steps=5)

    assert watch.metrics()["peak_tool_speed_m_s"] is None
    assert watch.metrics()["peak_tool_acceleration_m_s2"] is None
