"""Calibrated control: from the robot's file to what a trial does, and everything that can be wrong on the way."""

from __future__ import annotations

import re

import pytest

from rgss.cli.main import main
from rgss.errors import DocumentError
from rgss.evidence import Fidelity
from rgss.scenes import ServoControl
from rgss.studies import load_project
from rgss.studies.expansion import trial_specs
from rgss.studies.input_names import named_inputs
from rgss.trials import ControlMode
from rgss.trials.code import versions
from rgss.trials.pieces import digests_of

STUDY, SPACE, ROBOT = "studies/pick_place.yaml", "designs/grasping_system.yaml", "scenes/robots/ur10.yaml"
SERVOS = "scenes/robots/ur10.servos.yaml"
JOINTS = ("shoulder_pan", "shoulder_lift", "elbow", "wrist_1", "wrist_2", "wrist_3")
HEAD = """\
calibration: ur10
calibrated_on:
  recording: cell_3.csv
  sha256: {digest}
  recorded: "2026-05-01, cell 3"
  control: {control}
  poses: [folded, stretched]
servos:
"""
SERVO = "  {joint}_joint: {{velocity_gain: 90 s^-1, position_gain: 2000 s^-2, delay: {delay}{more}}}\n"


@pytest.fixture
def calibrate(folder, edit):
    """Gives the robot a calibration, and the study the control that uses it."""

    def write(*, delay="2 ms", control="position", joints=JOINTS, more=(), mode="calibrated", extra=""):
        head = HEAD.format(digest="0123456789ab" + 52 * "0", control=control)
        lines = [SERVO.format(joint=name, delay=delay, more=dict(more).get(name, "")) for name in joints]
        (folder / SERVOS).write_text(head + "".join(lines) + extra)
        edit(ROBOT, "payload:", "calibration: ur10.servos.yaml\npayload:")
        edit(STUDY, "planning:\n", f"control: {{mode: {mode}, tracking_limit: 50 mm}}\nplanning:\n")
        edit(STUDY, "fidelity: contact", "fidelity: dynamic")

    return write


def specs_of(folder, variant=28):
    project = load_project(folder)
    return trial_specs(project, variants=[project.designs.variant(variant)], seeds=[1])


def test_a_trial_has_the_servos_of_the_robots_file(folder, calibrate):
    calibrate()

    (spec,) = specs_of(folder)

    controller = spec.settings.controller
    assert spec.fidelity is Fidelity.DYNAMIC
    assert controller.mode is ControlMode.CALIBRATED
    assert controller.calibration.control is ServoControl.POSITION
    assert [name for name, _ in controller.calibration.servos] == [f"{joint}_joint" for joint in JOINTS]
    assert controller.calibration.origin == "cell_3.csv of ur10 (2026-05-01, cell 3; SHA-256 0123456789ab)"
    assert "cell_3.csv" in str(named_inputs(spec).values["settings"]["controller"])


def test_a_calibration_is_an_input_of_trials_that_use_it_alone(folder, calibrate, shipped):
    (plain,) = trial_specs(shipped, variants=[shipped.designs.variant(28)], seeds=[1])
    calibrate(mode="computed_torque")
    (unused,) = specs_of(folder)
    text = (folder / STUDY).read_text()
    (folder / STUDY).write_text(text.replace("mode: computed_torque", "mode: calibrated"))
    (used,) = specs_of(folder)
    servos = (folder / SERVOS).read_text()
    (folder / SERVOS).write_text(servos.replace("2 ms", "3 ms", 1))
    (slower,) = specs_of(folder)

    of = [digests_of(spec, versions()) for spec in (plain, unused, used, slower)]

    assert len({digests.plan for digests in of}) == 1
    assert len({digests.timing for digests in of}) == 1
    assert len({digests.execution for digests in of[1:]}) == 3
    assert "calibration" not in named_inputs(unused).values["scene"]["robot"]


@pytest.mark.slow
def test_delay_and_gains_show_in_the_tracking_error(folder, calibrate, capsys):
    calibrate()
    errors = []
    for delay in ("2 ms", "12 ms"):
        (folder / SERVOS).write_text(re.sub(r"delay: \d+ ms", f"delay: {delay}", (folder / SERVOS).read_text()))
        status = main(["run", "28", "--json", "--project", str(folder)])
        shown = capsys.readouterr().out
        assert status == 0, shown
        errors.append(max(float(each) for each in re.findall(r'"tracking_error_m": ([\d.e-]+)', shown)))

    # The tool moves at up to 0.5 or 1 m/s: ten milliseconds more are 5 to 10 mm more.
    assert 4e-3 < errors[1] - errors[0] < 12e-3


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (
            {"joints": JOINTS[:5]},
            r"pick_place\.yaml:\d+:\d+: error: the control is calibrated, and the calibration has no",
        ),
        (
            {"extra": "  tail_joint: {velocity_gain: 9 s^-1, position_gain: 9 s^-2}\n"},
            r"ur10\.yaml:\d+:\d+: error: the calibration has a servo of 'tail_joint', which is not a joint of",
        ),
        ({"delay": "-1 ms"}, r"ur10\.servos\.yaml:9:\d+: error: delay_s must not be negative"),
        (
            {"control": "velocity", "delay": "200 ms"},
            r"the calibrated control of joint 'shoulder_pan_joint' is unstable",
        ),
    ],
)
def test_what_is_wrong_is_said_where_it_is(folder, calibrate, change, message):
    calibrate(**change)

    with pytest.raises(DocumentError) as caught:
        load_project(folder)

    assert any(re.search(message, str(finding)) for finding in caught.value.findings), caught.value


def test_a_servo_under_position_control_needs_a_position_gain(folder, calibrate):
    calibrate()
    (folder / SERVOS).write_text((folder / SERVOS).read_text().replace(" position_gain: 2000 s^-2,", "", 1))

    with pytest.raises(DocumentError, match="servo 'shoulder_pan_joint' has no position gain"):
        load_project(folder)


def test_a_study_or_a_design_without_a_calibration_is_told(folder, edit):
    edit(STUDY, "planning:\n", "control: {mode: calibrated}\nplanning:\n")

    with pytest.raises(DocumentError, match="the file of robot 'ur10' names no calibration") as caught:
        load_project(folder)

    assert caught.value.findings[0].file == STUDY


def test_a_calibration_of_another_robot_is_refused(folder, calibrate):
    """Robots of one maker have joints of the same names."""
    calibrate()
    servos = folder / SERVOS
    servos.write_text(servos.read_text().replace("calibration: ur10", "calibration: ur5"))

    with pytest.raises(DocumentError, match="the calibration is of robot 'ur5', not of 'ur10'") as caught:
        load_project(folder)

    assert caught.value.findings[0].file == ROBOT


def test_a_calibration_that_is_not_there_is_told(folder, edit):
    edit(ROBOT, "payload:", "calibration: none.yaml\npayload:")

    with pytest.raises(DocumentError, match=r"there is no file 'none\.yaml'"):
        load_project(folder)


def test_check_warns_of_a_servo_that_misses_part_of_the_motion(folder, calibrate, capsys):
    calibrate(more={"elbow": ", adequate: false"}.items())

    main(["check", "--project", str(folder)])

    shown = capsys.readouterr().out
    assert "warning: the servo of joint 'elbow_joint' misses part of the motion that it was calibrated on" in shown
    assert "nothing reads this file" not in shown
