"""Setting an object down: how it lands, and that the robot leaves it where it stands."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
import pytest

from rgss.evidence import Failure, Phase
from rgss.kinematics import Arm, InverseKinematics
from rgss.physics import Contacts, PhysicsSettings, World
from rgss.scenes import FORCE_WINDOW_S, Pose
from rgss.trials.control import ControlSettings
from rgss.trials.execution import Execution
from rgss.trials.plan import plan_task
from rgss.trials.reference import reference_of
from rgss.trials.release_monitor import PlacedObjectMonitor, lowest_point_m
from rgss.trials.timing import time_task
from rgss.trials.workcell import workcell_of

CONTROL = ControlSettings()


def test_the_lowest_point_is_that_of_the_lower_rim(spec_of):
    shape = spec_of().scene.workpiece.shape
    assert lowest_point_m(Pose(position_m=(0, 0, 1)), shape) == pytest.approx(0.95)
    for tilt in (0.3, -0.3, math.pi - 0.3, math.pi / 2):
        pose = Pose.from_roll_pitch_yaw((0.0, 0.0, 1.0), (tilt, 0.0, 0.7))
        rim = [
            1.0 + pose.rotate((0.035 * math.cos(angle), 0.035 * math.sin(angle), end))[2]
            for angle in np.linspace(0.0, math.tau, 721)
            for end in (-0.05, 0.05)
        ]
        assert lowest_point_m(pose, shape) == pytest.approx(min(rim), abs=1e-6)


@pytest.fixture
def landed(spec_of):
    """Opens the hand, far away, while the cup falls from a height onto its place."""
    spec = spec_of()

    def run(height_m, *, rate_hz=240.0, **workpiece):
        scene = spec.scene
        x, y, z = scene.place.centre_m
        above = Pose(position_m=(x, y, z + height_m + scene.workpiece.shape.half_height_m))
        place = replace(scene.place, largest_drop_m=1.0)
        scene = replace(scene, place=place, workpiece=replace(scene.workpiece, pose=above, **workpiece))
        with World(scene, spec.gripper, PhysicsSettings(rate_hz=rate_hz)) as world:
            execution = Execution(world, {}, CONTROL, Arm(scene.robot, spec.gripper.geometry.grasp_centre))
            execution.start(scene.robot.home_rad)
            return execution.place()

    return run


@pytest.mark.engine
@pytest.mark.parametrize("height_m", [0.003, 0.01, 0.03, 0.1])
def test_the_landing_force_is_the_momentum_over_the_window_and_the_weight_at_any_step_rate(landed, height_m):
    mass_kg, window_s = 0.25, FORCE_WINDOW_S
    blow_n = mass_kg * math.sqrt(2 * 9.81 * height_m) / window_s
    for rate_hz in (240.0, 500.0, 1000.0, 2000.0):
        result = landed(height_m, rate_hz=rate_hz, force_limit_n=1e6)
        assert result.failure is None
        assert result.metrics["release_height_m"] == pytest.approx(height_m, abs=1e-6)
        # The weight comes to it, a step's fall, and what the engine throws back of a body that went in.
        fall_n = mass_kg * 9.81 * (1 + 1 / (rate_hz * window_s))
        assert blow_n - fall_n <= result.metrics["landing_force_n"] <= 1.15 * blow_n + fall_n


@pytest.mark.engine
@pytest.mark.parametrize("rate_hz", [240.0, 1000.0])
def test_the_same_landing_damages_at_every_step_rate(landed, rate_hz):
    force_n = landed(0.05, rate_hz=1000.0, force_limit_n=1e6).metrics["landing_force_n"]
    assert landed(0.05, rate_hz=rate_hz, force_limit_n=1.15 * force_n).failure is None
    broken = landed(0.05, rate_hz=rate_hz, force_limit_n=0.85 * force_n)
    assert broken.failure is Failure.OBJECT_DAMAGED
    assert "after a drop of 50.0 mm" in broken.detail


@dataclass(frozen=True)
class Sideways:
    """From the place, go aside with the first finger leading, and back again; then go on as timed."""

    timed: object
    arm: Arm
    grasp: Pose
    way_m: float
    sideways_s: float = 4.0

    @property
    def duration_s(self):
        return self.sideways_s + self.timed.duration_s

    def positions(self, times_s):
        times = np.asarray(times_s)
        found = np.array(self.timed.positions(np.maximum(0.0, times - self.sideways_s)))
        inverse, nearest = InverseKinematics(self.arm), found[0]
        for row in np.flatnonzero(times < self.sideways_s):
            way_m = self.way_m * math.sin(math.pi * times[row] / self.sideways_s) ** 2
            nearest = inverse.nearest(self.grasp @ Pose(position_m=(way_m, 0.0, 0.0)), nearest)
            found[row] = nearest
        return found


@pytest.fixture(scope="module", params=[65, 57], ids=["two fingers", "three fingers"])
def run_with_return(request, spec_of):
    """Runs the whole task with another way of the hand at the beginning of its return."""
    spec = spec_of(request.param)
    planning = spec.settings.planning
    cell = workcell_of(spec.scene, spec.gripper.geometry, planning.clearance_m)
    plan = plan_task(cell, spec.planner, seed=spec.seed, settings=planning)
    timing = time_task(cell, plan, tool_speed_m_s=spec.tool_speed_m_s, settings=planning)
    step_s = spec.settings.physics.step_s

    def run(way_m, **place):
        scene = replace(spec.scene, place=replace(spec.scene.place, **place))
        trajectories = dict(timing.trajectories)
        last = Phase.MOVE_TO_GRASP_APPROACH
        trajectories[last] = Sideways(trajectories[last], cell.arm, scene.place_pose, way_m)
        references = {
            phase: reference_of(trajectories[phase], cell.arm, step_s=step_s, gravity_m_s2=scene.gravity_m_s2)
            for phase in Phase
            if phase in trajectories
        }
        with World(scene, spec.gripper, spec.settings.physics) as world:
            return Execution(world, references, CONTROL, cell.arm).run()[-1]

    return run


@pytest.mark.engine
def test_a_finger_that_drags_the_placed_object_ends_the_trial(run_with_return):
    for way_m in (0.055, -0.06):
        result = run_with_return(way_m)
        assert (result.phase, result.failure) == (Phase.MOVE_TO_GRASP_APPROACH, Failure.OBJECT_COLLISION)
        assert "moved the placed object by 1." in result.detail
        assert result.detail.startswith("finger_")
        assert result.metrics["workpiece_displacement_m"] > 1e-3
        assert result.metrics["touch_force_n"] > 0.0


@pytest.mark.engine
def test_what_may_be_dragged_is_the_scene_s(run_with_return):
    """And then the object is still in its place region: nothing else would have found it out."""
    result = run_with_return(-0.06, largest_drag_m=0.2)
    assert result.failure is None
    assert 0.005 < result.metrics["workpiece_displacement_m"] < 0.2
    assert result.metrics["place_error_m"] < 0.04


@pytest.mark.engine
def test_a_hand_that_does_not_touch_the_object_moves_nothing(run_with_return):
    result = run_with_return(0.02)
    assert result.failure is None
    assert result.metrics["workpiece_displacement_m"] == result.metrics["touch_force_n"] == 0.0


class ScriptedWorld:
    """Stands in for the physics: the object is where the test says."""

    def __init__(self, scene):
        self.scene = scene
        self.pose = Pose(position_m=(0.0, 0.0, 0.95))

    def workpiece_pose(self):
        return self.pose


def pressing(*forces_n):
    return Contacts(finger_forces_n=forces_n, other_force_n=0.0, pressed=(), robot_bodies=(), workpiece_bodies=())


def test_what_the_object_does_by_itself_is_not_the_robot_s(spec_of):
    world = ScriptedWorld(spec_of().scene)
    monitor = PlacedObjectMonitor(world)
    world.pose = Pose(position_m=(0.01, 0.0, 0.95))
    assert monitor.after_step(pressing(0.0, 0.0)) is None
    assert monitor.finish() is None
    assert monitor.metrics()["workpiece_displacement_m"] == 0.0


def test_what_a_touched_object_does_afterwards_is_the_robot_s(spec_of):
    world = ScriptedWorld(spec_of().scene)
    monitor = PlacedObjectMonitor(world)
    assert monitor.after_step(pressing(0.0, 2.5)) is None
    assert monitor.after_step(pressing(0.5, 0.0)) is None
    world.pose = Pose(position_m=(0.0, 0.004, 0.95))
    failure, detail = monitor.finish()
    assert failure is Failure.OBJECT_COLLISION
    assert detail == "finger_1 moved the placed object by 4.0 mm with 2.50 N, at most 1 mm"
    assert monitor.metrics() == {"workpiece_displacement_m": pytest.approx(0.004), "touch_force_n": 2.5}


def test_an_object_that_is_tipped_where_it_stands_was_moved(spec_of):
    world = ScriptedWorld(spec_of().scene)
    monitor = PlacedObjectMonitor(world)
    world.pose = Pose.from_roll_pitch_yaw((0.0, 0.0, 0.95), (0.05, 0.0, 0.0))
    assert monitor.after_step(pressing(1.0, 0.0))[0] is Failure.OBJECT_COLLISION
