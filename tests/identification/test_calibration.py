"""Calibration files are read back as the servos that were determined."""

from __future__ import annotations

from dataclasses import replace

import pytest

from rgss.errors import DefinitionError, DocumentError
from rgss.identification import FitStatus, calibration_text, fit_joint
from rgss.identification.fitting import FittedParameter, ServoFit
from rgss.scenes import JointServo, ServoControl, load_calibration
from tests.identification.recordings import motions_of, recording_of

SERVO = JointServo(velocity_gain_hz=30, delay_s=0.0137, viscous_hz=3, coulomb_rad_s2=1.5)


def test_what_is_written_is_read_as_the_fitted_servo(tmp_path):
    recording = recording_of(motions_of(SERVO))
    fit = fit_joint(recording, "j1")

    text = calibration_text(recording, [fit], file='a "b".csv')

    (tmp_path / "servos.yaml").write_text(text)
    found = load_calibration(tmp_path / "servos.yaml")
    ((joint, servo),) = found.servos
    assert (joint, found.recording, found.control, found.misfits) == ("j1", 'a "b".csv', ServoControl.VELOCITY, ())
    assert found.origin == f'a "b".csv of {recording.robot} ({recording.recorded}; SHA-256 {recording.digest[:12]})'
    for name, value in fit.determined().items():
        assert getattr(servo, name) == pytest.approx(value, rel=1e-5)
    assert servo.position_gain_hz2 == 0.0
    assert 'recording: "a \\"b\\".csv"' in text
    assert "# position_gain: not in the recording" in text


@pytest.mark.parametrize(
    ("robot", "joint", "message"),
    [
        ("cell 3, UR10e", "j1", "names the robot as the robot's file does, which 'cell 3, UR10e' cannot be"),
        ("ur10", "1", "names the joint as the robot's file does, which '1' cannot be"),
        ("ur10", "j1: {}\n#", "cannot be"),
    ],
)
def test_names_that_no_robot_file_has_are_not_written(robot, joint, message):
    recording = replace(recording_of(motions_of(SERVO), joint=joint), robot=robot)
    gain = FittedParameter(name="velocity_gain_hz", status=FitStatus.DETERMINED, value=30.0, interval=(29.0, 31.0))
    fit = ServoFit(
        joint=joint,
        servo=SERVO,
        parameters=(gain,),
        rms_rad_s={"p": 0.01},
        samples=9,
        autocorrelation=0.0,
        portmanteau=0.0,
    )
    with pytest.raises(DefinitionError) as caught:
        calibration_text(recording, [fit], file="r.csv")
    assert message in str(caught.value)


def test_a_recording_that_determines_no_gain_gives_no_calibration():
    recording = recording_of(motions_of(SERVO, (0.01,), hold_s=0.1), noise=(0.01, 1.0))

    with pytest.raises(DefinitionError, match="no joint's velocity gain is determined"):
        calibration_text(recording, [fit_joint(recording, "j1")], file="a.csv")


@pytest.mark.parametrize(
    ("entry", "message"),
    [
        ("{velocity_gain: 0 s^-1}", "the velocity gain must be positive"),
        ("{velocity_gain: 30 s^-1, delay: -1 ms}", "delay_s must not be negative"),
        ("{velocity_gain: 30 s^-1, position_gain: 9 kg}", "kg"),
        ("{velocity_gain: 30}", "has no unit"),
        ("{}", "velocity_gain"),
    ],
)
def test_impossible_servos_are_refused_at_their_place(tmp_path, entry, message):
    path = tmp_path / "servos.yaml"
    path.write_text(f"calibration: r\nservos:\n  j1: {entry}\n")

    with pytest.raises(DocumentError, match=message) as caught:
        load_calibration(path)

    assert caught.value.findings[0].line == 3
