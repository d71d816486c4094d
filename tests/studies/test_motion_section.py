"""The sections ``timing`` and ``control`` of a study: keys, findings and their places, defaults as they were."""

from __future__ import annotations

import pytest

from rgss.errors import DocumentError
from rgss.studies.expansion import trial_settings, trial_specs
from rgss.studies.input_names import named_inputs
from rgss.studies.motion import MotionChoice
from rgss.studies.project import load_project
from rgss.trials import ControlMode, ControlSettings, JointController, JointGains, TimingProfile, TimingSettings

STUDY, SPACE = "studies/pick_place.yaml", "designs/grasping_system.yaml"
SECTIONS = """\
timing:
  profile: trapezoid
  peak_speed: 80 %
  peak_acceleration: 50 %
  joint_speeds: {elbow_joint: 90 deg/s}
  joint_accelerations: {wrist_1_joint: 2 rad/s**2}
control:
  mode: velocity
  natural_frequency: 30 rad/s
  damping_ratio: 0.7
  position_gain: 10 rad/s
  velocity_gain: 60 rad/s
  joints:
    elbow_joint: {position_gain: 5 rad/s, velocity_gain: 50 rad/s, damping_ratio: 0.8, natural_frequency: 9 rad/s}
  position_tolerance: 0.1 deg
  settling_limit: 1 s
  tracking_limit: 20 mm
"""


@pytest.fixture
def section(edit):
    """Puts sections before the planning."""
    return lambda text: edit(STUDY, "planning:\n", f"{text}planning:\n")


@pytest.fixture
def problems(folder):
    def find():
        with pytest.raises(DocumentError) as caught:
            load_project(folder)
        return [str(finding) for finding in caught.value.findings]

    return find


def test_what_it_says(folder, section):
    section(SECTIONS)
    settings = trial_settings(load_project(folder))
    assert settings.timing == TimingSettings(
        profile=TimingProfile.TRAPEZOID,
        peak_speed=0.8,
        peak_acceleration=0.5,
        joint_speeds_rad_s=(("elbow_joint", pytest.approx(1.5708, abs=1e-4)),),
        joint_accelerations_rad_s2=(("wrist_1_joint", 2.0),),
    )
    own = JointGains(
        joint="elbow_joint",
        natural_frequency_rad_s=9.0,
        damping_ratio=0.8,
        position_gain_1_s=5.0,
        velocity_gain_1_s=50.0,
    )
    assert settings.controller == JointController(
        mode=ControlMode.VELOCITY,
        natural_frequency_rad_s=30.0,
        damping_ratio=0.7,
        position_gain_1_s=10.0,
        velocity_gain_1_s=60.0,
        joints=(own,),
        reached_rad=pytest.approx(0.0017453, abs=1e-6),
        settling_limit_s=1.0,
    )
    assert settings.control == ControlSettings(largest_tracking_error_m=0.02)


def test_what_is_left_away_is_as_it_always_was(shipped):
    settings = trial_settings(shipped)
    assert shipped.study.motion == MotionChoice()
    assert (settings.timing, settings.control) == (TimingSettings(), ControlSettings())
    assert settings.controller == JointController()
    assert settings.controller.mode is ControlMode.COMPUTED_TORQUE
    inputs = named_inputs(trial_specs(shipped)[0]).values["settings"]
    assert inputs.keys() == {"planning", "physics", "control"}


def test_what_is_stated_is_a_named_input(folder, section):
    section(SECTIONS)
    inputs = named_inputs(trial_specs(load_project(folder))[0]).values["settings"]
    assert inputs["timing"]["profile"] == "trapezoid"
    assert inputs["controller"]["mode"] == "velocity"


def test_limits_are_those_of_the_robot_or_less(shipped):
    joints = shipped.scene.robot.joints
    one, two = joints[0], joints[1]
    timing = TimingSettings(
        peak_speed=0.5,
        joint_speeds_rad_s=((one.name, 0.25 * one.speed_rad_s), (two.name, 9.0 * two.speed_rad_s)),
        joint_accelerations_rad_s2=((one.name, 0.5),),
    )
    limits = timing.limits(joints, tool_speed_m_s=1.0, tool_acceleration_m_s2=2.0)
    assert limits.speed_rad_s[:2] == (0.125 * one.speed_rad_s, 0.5 * two.speed_rad_s)
    assert limits.acceleration_rad_s2[:2] == (0.5, two.acceleration_rad_s2)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        (
            "timing: {peak_speed: 120 %}",
            "peak_speed must be a share of the joints' limits above 0 and at most 1, got 1.2",
        ),
        ("timing: {peak_acceleration: 0}", "peak_acceleration must be a share of the joints' limits above 0"),
        (
            "timing: {joint_speeds: {elbow_joint: 0 rad/s}}",
            "elbow_joint must be greater than zero [study.not-positive]",
        ),
        ("timing: {joint_speeds: {elbow: 1 rad/s}}", "the robot has no joint 'elbow' (joints: shoulder_pan_joint, "),
        ("timing: {joint_accelerations: {wrist: 1 rad/s**2}}", "the robot has no joint 'wrist'"),
        ("control: {joints: {wrist: {damping_ratio: 1}}}", "the robot has no joint 'wrist'"),
        ("control: {natural_frequency: 0 rad/s}", "natural_frequency must be greater than zero"),
        ("control: {position_gain: -1 rad/s}", "position_gain must not be negative [study.negative]"),
        ("control: {joints: {elbow_joint: {velocity_gain: 0 rad/s}}}", "velocity_gain must be greater than zero"),
        ("control: {joints: {elbow_joint: {position_gain: -1 rad/s}}}", "position_gain must not be negative"),
        (
            "control: {natural_frequency: 400 rad/s}",
            "the control is unstable at 240 Hz: its gains need more than 482.8 Hz",
        ),
        (
            "control: {mode: velocity, joints: {elbow_joint: {velocity_gain: 480 rad/s}}}",
            "the control is unstable at 240 Hz: its gains need more than 249.6 Hz",
        ),
        ("control: {mode: torque}", "'torque'"),
    ],
)
def test_what_is_wrong_with_it(section, problems, text, expected):
    section(f"{text}\n")
    (problem,) = problems()
    assert expected in problem
    assert problem.startswith(f"{STUDY}:")


def test_a_design_sets_profile_mode_and_gains(folder, edit):
    edit(
        SPACE,
        "parameters:\n",
        """parameters:
  - {id: profile, name: profile, symbol: p, kind: name, sets: timing.profile, description: X.}
  - {id: pace, name: pace, symbol: s, unit: "1", sets: timing.peak_speed, description: X.}
  - {id: mode, name: mode, symbol: m, kind: name, sets: control.mode, description: X.}
  - {id: gain, name: gain, symbol: k, unit: rad/s, sets: control.position_gain, description: X.}
""",
    )
    edit(
        SPACE,
        "factors:\n",
        """factors:
  - id: motion
    name: Motion
    levels:
      - {id: fast, sets: {profile: time_optimal, pace: 1, mode: computed_torque, gain: 20 rad/s}}
      - {id: calm, sets: {profile: trapezoid, pace: 0.6, mode: velocity, gain: 5 rad/s}}
""",
    )
    specs = trial_specs(load_project(folder))
    settings = {(one.settings.timing, one.settings.controller) for one in specs}
    assert settings == {
        (TimingSettings(), JointController()),
        (
            TimingSettings(profile=TimingProfile.TRAPEZOID, peak_speed=0.6),
            JointController(mode=ControlMode.VELOCITY, position_gain_1_s=5.0),
        ),
    }


@pytest.mark.parametrize(
    ("parameter", "value", "expected"),
    [
        (
            "kind: name, sets: timing.profile",
            "trapezium",
            "x must be time_optimal or trapezoid or joint_waypoints, got",
        ),
        (
            "kind: name, sets: control.mode",
            "torque",
            "x must be position or velocity or computed_torque or calibrated or tool_tracking, got 'torque'",
        ),
        (
            'unit: "1", sets: timing.peak_speed',
            "1.5",
            "x must be at most 1, got 1.5 (a share of the joint's limit)",
        ),
        ('unit: "1", sets: timing.peak_acceleration', "0", "x must be greater than zero"),
        ("unit: rad/s, sets: control.position_gain", "-1 rad/s", "x must be at least 0 rad/s"),
    ],
)
def test_what_a_design_may_not_set(edit, problems, parameter, value, expected):
    edit(SPACE, "parameters:\n", f"parameters:\n  - {{id: x, name: x, symbol: x, {parameter}, description: X.}}\n")
    edit(SPACE, "constants:\n", f"constants:\n  x: {value}\n")
    assert any(expected in problem for problem in problems())
