"""Work and speeds of joints, summed by hand, and against the energy that the arm gains."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from rgss.evidence import Fidelity
from rgss.kinematics.description import build_model, transform
from rgss.scenes import Joint
from rgss.trials.executing import execute
from rgss.trials.planning import plan_of
from rgss.trials.plants.arm_observations import governing_joint
from rgss.trials.plants.joint_motion import JointMotion
from rgss.trials.timing import timing_of
from rgss.trials.workcell import cell_of
from tests.fixtures.eight_states import Phase


def joint(name, torque, speed):
    return Joint(
        name=name, lower_rad=-1.0, upper_rad=1.0, speed_rad_s=speed, acceleration_rad_s2=1.0, torque_n_m=torque
    )


def motion_of(torques, speeds, step_s=0.5):
    motion = JointMotion([joint("shoulder", 100.0, 2.0), joint("wrist", 10.0, 8.0)])
    for torque, speed in zip(torques, speeds, strict=True):
        motion.note_all(np.array([torque]), np.array([speed]), step_s)
    return motion.metrics()


def test_braking_takes_energy_unless_it_is_recovered():
    found = motion_of([(20.0, 1.0), (-20.0, 2.0)], [(1.0, 0.5), (1.0, -4.0)])

    # 5 + 0.125 J to drive from rest, 10 + 1.75 J to brake, with the mean speeds of 0.5, 0.25, 1 and -1.75 rad/s.
    assert found["joint_work_j"] == pytest.approx(16.875)
    assert found["joint_net_work_j"] == pytest.approx(-6.625)


def test_the_net_work_of_free_joints_is_their_kinetic_energy():
    inertias, step_s = np.array([2.0, 0.3]), 1.0 / 240.0
    torques = np.random.default_rng(4).normal(0.0, 3.0, (500, 2))
    speeds = np.cumsum(torques * step_s / inertias, axis=0)

    found = motion_of(torques, speeds, step_s)

    assert found["joint_net_work_j"] == pytest.approx(float((inertias * speeds[-1] ** 2).sum()) / 2.0, rel=1e-9)


def test_what_a_controller_asks_for_beyond_the_limit_does_no_work():
    assert motion_of([(0.0, 40.0)], [(0.0, 1.0)])["joint_work_j"] == pytest.approx(2.5)


def test_the_fastest_joint_is_the_one_nearest_to_its_own_limit():
    found = motion_of([(0.0, 0.0)] * 2, [(-1.5, 1.0), (0.5, -4.0)])

    assert found["peak_joint_speed_ratio"] == pytest.approx(0.75)
    assert found["fastest_joint"] == 1


@pytest.mark.parametrize(("torque", "speed", "governs"), [(0.8, 0.3, 2), (0.3, 0.8, 5), (0.5, 0.5, 2)])
def test_the_joint_that_governs_is_nearest_to_any_limit(torque, speed, governs):
    load = {"peak_joint_torque_ratio": torque, "most_loaded_joint": 2}
    motion = {"peak_joint_speed_ratio": speed, "fastest_joint": 5}

    found = governing_joint(load, motion)

    assert found == {"peak_joint_utilisation": max(torque, speed), "governing_joint": governs}


class Recorder:
    """Torques and speeds of every step, read from the physics by itself."""

    def __init__(self, spec):
        self.limits = np.array([one.torque_n_m for one in spec.scene.robot.joints])
        self.speed_limits = np.array([one.speed_rad_s for one in spec.scene.robot.joints])
        self.states = {}

    def after_step(self, world, phase, contacts, grip_margin, commanded_force_n):
        self.states.setdefault(phase, []).append(world.arm_state())

    def power(self, phase):
        """Mechanical power (steps, joints) in W."""
        states = np.array(self.states[phase])
        before = np.vstack([np.zeros(len(self.limits)), states[:-1, 1]])
        return np.clip(states[:, 2], -self.limits, self.limits) * (before + states[:, 1]) / 2.0


@pytest.mark.engine
def test_the_work_of_a_contact_trial_is_that_of_its_recorded_torques(spec_of):
    spec = spec_of(28)
    recorder = Recorder(spec)
    timing = timing_of(spec, plan_of(spec))

    results = execute(spec, cell_of(spec), timing, observer=recorder)

    step_s = spec.settings.physics.step_s
    assert [result.phase for result in results] == list(Phase)
    for result in results:
        power = recorder.power(result.phase)
        assert result.metrics["joint_work_j"] == pytest.approx(np.abs(power).sum() * step_s, rel=1e-9)
        assert result.metrics["joint_net_work_j"] == pytest.approx(power.sum() * step_s, rel=1e-9)
        speeds = np.abs(np.array(recorder.states[result.phase])[:, 1]).max(axis=0) / recorder.speed_limits
        assert result.metrics["peak_joint_speed_ratio"] == pytest.approx(speeds.max())
        assert result.metrics["fastest_joint"] == 1 + int(speeds.argmax())
    moving = next(one for one in results if one.phase == Phase.MOVE_TO_PLACE_APPROACH)
    assert moving.metrics["joint_work_j"] > 10.0 * abs(moving.metrics["joint_net_work_j"]) > 0.0


def potential_energy_j(spec, q):
    """Potential energy of arm, gripper and object, from masses and heights alone."""
    import pinocchio

    model = build_model(spec.scene.robot)
    data = model.createData()
    pinocchio.forwardKinematics(model, data, q)
    energy = sum(
        inertia.mass * (placement * inertia.lever)[2]
        for inertia, placement in zip(model.inertias, data.oMi, strict=True)
    )
    flange = model.frames[model.getFrameId(spec.scene.robot.flange)]
    to_world = data.oMi[flange.parentJoint] * flange.placement
    gripper, geometry = spec.gripper, spec.gripper.geometry
    held = [
        (gripper.base_mass_kg, geometry.base_pose.position_m),
        (spec.scene.workpiece.mass_kg, transform(geometry.grasp_centre).translation),
    ]
    held += [
        (gripper.finger_mass_kg, geometry.finger_pose(finger, spec.scene.workpiece.shape.radius_m).position_m)
        for finger in range(geometry.fingers)
    ]
    energy += sum(mass * (to_world * np.array(position))[2] for mass, position in held)
    return spec.scene.gravity_m_s2 * energy


@pytest.mark.engine
def test_the_net_work_of_a_lift_from_rest_to_rest_is_the_potential_energy_gained(spec_of):
    spec = replace(spec_of(65), fidelity=Fidelity.DYNAMIC)
    timing = timing_of(spec, plan_of(spec))
    lift = timing.trajectories[Phase.LIFT]
    start, end = lift.positions([0.0, lift.duration_s])

    results = execute(spec, cell_of(spec), timing)

    found = next(one for one in results if one.phase == Phase.LIFT).metrics
    gained = potential_energy_j(spec, end) - potential_energy_j(spec, start)
    assert gained > 1.0
    assert found["joint_net_work_j"] == pytest.approx(gained, rel=0.01)
    assert found["joint_work_j"] > found["joint_net_work_j"]
    assert math.isfinite(found["joint_work_j"])
