"""Identification of joints that slide: signals, recordings and fits in metres."""

from __future__ import annotations

import json
import re
from dataclasses import replace

import pytest

from rgss.cli.main import main
from rgss.errors import DocumentError
from rgss.identification import (
    FitStatus,
    calibration_text,
    fit_joint,
    load_excitation,
    read_recording,
    responses,
    simulated_recording,
    write_recording,
)
from rgss.scenes import Gripper, JointServo, load_calibration, load_gripper
from tests.fixtures.serial_arms import Link, Z, serial_robot
from tests.fixtures.shipped_project import REPOSITORY

ARM = (
    Link("prismatic", (0.0, 0.0, 0.5), axis="1 0 0", range=(-0.4, 0.4)),
    Link("revolute", (0.0, 0.0, 0.2), axis=Z),
)
TEXT = """\
excitation: rail_and_wrist
rate: 500 Hz
rest: 100 ms
steps: {speeds: [50 mm/s, 120 mm/s, 0.4 rad/s, 0.8 rad/s], hold: 300 ms}
sines: {amplitudes: [80 mm/s, 0.5 rad/s], frequencies: [2 Hz]}
poses: {middle: [0 mm, 0 deg], aside: [200 mm, 40 deg]}
noise: {velocity: 0.5 deg/s, slide_position: 20 um, slide_velocity: 1 mm/s, seed: 3}
"""
SERVOS = {
    "joint_1": JointServo(velocity_gain_hz=40.0, delay_s=0.012, viscous_hz=1.5, coulomb_rad_s2=0.4),
    "joint_2": JointServo(velocity_gain_hz=30.0, delay_s=0.008, viscous_hz=2.0, coulomb_rad_s2=1.5),
}


@pytest.fixture(scope="module")
def robot():
    return serial_robot(ARM)


def excitation_of(tmp_path, robot, text):
    path = tmp_path / "excitation.yaml"
    path.write_text(text, encoding="utf-8")
    return load_excitation(path, robot)


@pytest.mark.engine
def test_the_servo_of_a_joint_that_slides_is_fitted(tmp_path, robot, capsys):
    gripper = Gripper(
        geometry=load_gripper(REPOSITORY / "scenes/grippers/kg-2.yaml"),
        base_mass_kg=0.4,
        finger_mass_kg=0.2,
        finger_velocity_m_s=0.04,
        finger_force_n=10.0,
        friction=0.7,
    )
    excitation = excitation_of(tmp_path, robot, TEXT)
    made = simulated_recording(excitation, robot, gripper, gravity_m_s2=9.81, servos=SERVOS)
    path = tmp_path / "recording.csv"
    write_recording(path, made)

    assert "joint_1 commanded position [m],joint_1 commanded velocity [m/s]" in path.read_text(encoding="utf-8")
    recording = read_recording(path)
    assert (recording.slides, recording.unit_of("joint_1"), recording.unit_of("joint_2")) == ({"joint_1"}, "m", "rad")
    signals = {name: {one.signal for one in recording.of_joint(name)} for name in SERVOS}
    assert signals["joint_1"] == {"step 0.05 m/s", "step 0.12 m/s", "sine 0.08 m/s 2 Hz"}
    assert signals["joint_2"] == {"step 0.4 rad/s", "step 0.8 rad/s", "sine 0.5 rad/s 2 Hz"}
    rises = [one.rise_s for one in responses(recording) if one.joint == "joint_1" and one.rise_s is not None]
    # The rise of a first-order loop from 10 % to 90 % takes ln 9 over its rate.
    assert rises == pytest.approx([2.197 / 41.5] * len(rises), rel=0.3)
    fits = [fit_joint(recording, name) for name in SERVOS]
    for fit, known in zip(fits, SERVOS.values(), strict=True):
        for each in fit.parameters:
            if each.status is FitStatus.DETERMINED:
                assert each.value == pytest.approx(getattr(known, each.name), rel=0.05)
        assert {"velocity_gain_hz", "delay_s", "coulomb_rad_s2"} <= set(fit.determined())

    text = calibration_text(recording, fits, file=path.name)
    slide, turn = text.split("  joint_2:")
    assert re.search(r"coulomb_friction: 0\.\d+ m/s\^2", slide)
    assert re.search(r"coulomb_friction: 1\.\d+ rad/s\^2", turn)
    assert main(["identify", str(path)]) == 0
    shown = capsys.readouterr().out
    assert re.search(r"joint_1 +coulomb_friction \[m/s\^2\] ", shown)
    assert re.search(r"joint_2 +coulomb_friction \[rad/s\^2\] ", shown)
    (tmp_path / "servos.yaml").write_text(text, encoding="utf-8")
    read = dict(load_calibration(tmp_path / "servos.yaml").servos)
    assert read["joint_1"].coulomb_rad_s2 == pytest.approx(0.4, rel=0.05)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("[0 mm, 0 deg]", "[0 deg, 0 deg]", "joint 'joint_1' is prismatic, so its position is in mm"),
        ("[0 mm, 0 deg]", "[0 mm, 0 mm]", "joint 'joint_2' is revolute, so its position is in deg"),
        ("[200 mm,", "[390 mm,", "step 0.05 m/s moves joint 'joint_1' from 390 to 405 mm, beyond its range"),
        ("slide_velocity: 1 mm/s", "slide_velocity: -1 mm/s", "slide_velocity must not be negative"),
    ],
)
def test_what_does_not_fit_the_joints_is_refused(tmp_path, robot, old, new, message):
    assert old in TEXT
    with pytest.raises(DocumentError, match=re.escape(message)):
        excitation_of(tmp_path, robot, TEXT.replace(old, new))


def test_a_joint_without_a_signal_is_named(tmp_path, robot):
    text = TEXT.replace("50 mm/s, 120 mm/s, ", "").replace("80 mm/s, ", "")

    with pytest.raises(DocumentError, match="there is no signal for joint 'joint_1', which is prismatic"):
        excitation_of(tmp_path, robot, text)
    # It may be left out.
    assert excitation_of(tmp_path, robot, text + "joints: [joint_2]\n").joints == ("joint_2",)
    wrist = replace(robot, joints=robot.joints[1:])
    with pytest.raises(DocumentError, match=r"the pose has 2 positions, the robot 1 joint \["):
        excitation_of(tmp_path, wrist, text)


def test_the_excitation_has_a_schema(capsys):
    assert main(["schema", "excitation"]) == 0
    schema = json.loads(capsys.readouterr().out)
    assert {"excitation", "rate", "rest", "poses"} <= set(schema["required"])
