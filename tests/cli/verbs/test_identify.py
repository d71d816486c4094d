"""``rgss identify``: the example of docs/identification.md is recorded, and its servos are found again."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest

from rgss.cli.main import main

PROJECT = Path(__file__).parents[3]
PAGE = PROJECT / "docs" / "identification.md"
SERVOS = """\
calibration: ur10
servos:
  shoulder_pan_joint: {velocity_gain: 30 s^-1, delay: 13 ms, viscous_friction: 2 s^-1, coulomb_friction: 1.5 rad/s^2}
  elbow_joint: {velocity_gain: 60 s^-1, delay: 5 ms, viscous_friction: 4 s^-1, coulomb_friction: 0.5 rad/s^2}
"""
TRUE = {
    "shoulder_pan_joint": {"velocity_gain_hz": 30, "delay_s": 0.013, "viscous_hz": 2, "coulomb_rad_s2": 1.5},
    "elbow_joint": {"velocity_gain_hz": 60, "delay_s": 0.005, "viscous_hz": 4, "coulomb_rad_s2": 0.5},
}


@pytest.fixture(scope="module")
def recorded(tmp_path_factory):
    """The folder with the recording of the page's excitation."""
    folder = tmp_path_factory.mktemp("identify")
    (example, *_) = re.findall(r"^```yaml\n(excitation:.*?)^```", PAGE.read_text(), re.MULTILINE | re.DOTALL)
    (folder / "excitation.yaml").write_text(example)
    (folder / "servos.yaml").write_text(SERVOS)
    for name in ("recording.csv", "again.csv"):
        assert identify(folder, "excitation.yaml", "--record", name, "--servos", "servos.yaml") == 0
    return folder


def identify(folder, file, *options):
    paths = [str(folder / each) if "." in each or each == "plots" else each for each in options]
    return main(["identify", "--project", str(PROJECT), str(folder / file), *paths])


@pytest.mark.engine
@pytest.mark.slow
def test_the_simulated_arm_is_identified_within_five_percent(recorded, capsys):
    status = identify(recorded, "recording.csv", "--json", "--calibration", "fitted.yaml", "--plots", "plots")

    report = json.loads(capsys.readouterr().out)
    assert status == 0
    assert {fit["joint"] for fit in report["fits"]} == set(TRUE)
    assert len(report["responses"]) == 2 * 2 * 4
    for fit in report["fits"]:
        assert fit["adequate"]
        found = {each["name"]: each["value"] for each in fit["parameters"] if each["status"] == "determined"}
        assert found == pytest.approx(TRUE[fit["joint"]], rel=0.05)
    assert "sha256" in (recorded / "fitted.yaml").read_text()
    assert (recorded / "plots" / "elbow_joint.png").read_bytes().startswith(b"\x89PNG")
    assert identify(recorded, "excitation.yaml", "--record", "fitted.csv", "--servos", "fitted.yaml") == 0


@pytest.mark.engine
def test_recordings_are_the_same_bytes(recorded):
    assert (recorded / "recording.csv").read_bytes() == (recorded / "again.csv").read_bytes()


@pytest.mark.engine
def test_a_servo_of_an_unknown_joint_is_refused(recorded, capsys):
    (recorded / "other.yaml").write_text(SERVOS.replace("elbow_joint", "elbow"))

    assert identify(recorded, "excitation.yaml", "--record", "no.csv", "--servos", "other.yaml") == 2
    assert "unknown joint 'elbow'" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--servos", "a.yaml"], "--servos goes with --record"),
        (["--variant", "1"], "--variant goes with --record"),
        (["--svg"], "--svg goes with --plots"),
        (["--record", "a.csv", "--plots", "plots"], "--record only records"),
    ],
)
def test_options_that_do_not_go_together(tmp_path, capsys, options, message):
    assert identify(tmp_path, "recording.csv", *options) == 2
    assert message in capsys.readouterr().err


def test_a_recording_that_is_not_there_gets_one_line(tmp_path, capsys):
    assert identify(tmp_path, "recording.csv") == 2
    assert len(capsys.readouterr().err.splitlines()) == 1
