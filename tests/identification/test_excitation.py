"""An excitation is refused at its place before the arm leaves its limits."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

from rgss.errors import DocumentError
from rgss.identification import load_excitation
from rgss.identification.excitation import signals
from rgss.scenes import Joint, Pose, Robot

PAGE = Path(__file__).parents[2] / "docs" / "identification.md"

TWO_JOINTS = Robot(
    id="two",
    urdf="",
    flange="flange",
    joints=tuple(
        Joint(name=name, lower_rad=-1.0, upper_rad=1.0, speed_rad_s=2.0, acceleration_rad_s2=5.0, torque_n_m=10.0)
        for name in ("a", "b")
    ),
    base=Pose(position_m=(0.0, 0.0, 0.0), quaternion_xyzw=(0.0, 0.0, 0.0, 1.0)),
    payload_kg=1.0,
    tool_acceleration_m_s2=1.0,
    home_rad=(0.0, 0.0),
)
GOOD = """\
excitation: e
rate: 100 Hz
rest: 100 ms
steps: {speeds: [0.5 rad/s], hold: 0.2 s}
sines: {amplitudes: [0.3 rad/s], frequencies: [2 Hz], cycles: 1}
poses: {zero: [0 rad, 0 rad]}
"""


def loaded(tmp_path, text):
    path = tmp_path / "e.yaml"
    path.write_text(text)
    return load_excitation(path, TWO_JOINTS)


def test_signals_begin_and_end_at_rest_where_they_began(tmp_path):
    step, sine = signals(loaded(tmp_path, GOOD))

    assert (step.name, sine.name) == ("step 0.5 rad/s", "sine 0.3 rad/s 2 Hz")
    assert step.velocities_rad_s.tolist() == [0.0] * 10 + [0.5] * 20 + [-0.5] * 20 + [0.0] * 10
    for signal in (step, sine):
        assert np.allclose(np.gradient(signal.positions_rad)[1:-1] * 100, signal.velocities_rad_s[1:-1], atol=0.51)
        assert signal.positions_rad[-1] == pytest.approx(0.0, abs=1e-9)
    assert step.positions_rad.max() == pytest.approx(0.1)
    assert np.abs(sine.velocities_rad_s).max() == pytest.approx(0.3, rel=0.01)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("rate: 100 Hz", "rate: 0 Hz", "rate must be positive, got 0"),
        ("rate: 100 Hz", "rate: 20 kHz", "rate must be at most 10000 Hz"),
        ("[0.5 rad/s]", "[0.5 rad/s, -1 rad/s]", "speeds must be positive, got -1"),
        ("[2 Hz]", "[20 Hz]", "fewer than 20 samples a cycle"),
        ("rate:", "joints: [c]\nrate:", "unknown joint 'c'"),
        ("[0 rad, 0 rad]", "[0 rad]", "the pose has 1 position, the robot 2 joints"),
        ("[0 rad, 0 rad]", "[0 rad, 0.95 rad]", "beyond its range"),
        ("hold: 0.2 s", "hold: 3 s", "beyond its range"),
        ("[0.5 rad/s], hold: 0.2 s", "[2.5 rad/s], hold: 0.1 s", "exceeds the speed limit of joint 'a'"),
        ("rate:", "noise: {velocity: -1 rad/s}\nrate:", "velocity must not be negative"),
        ("rate:", "speed: 3\nrate:", "speed"),
    ],
)
def test_what_is_impossible_is_refused_at_its_place(tmp_path, old, new, message):
    assert old in GOOD

    with pytest.raises(DocumentError, match=re.escape(message)) as caught:
        loaded(tmp_path, GOOD.replace(old, new, 1))

    assert caught.value.findings[0].line >= 1


def test_an_excitation_without_signals_is_refused(tmp_path):
    text = "".join(line for line in GOOD.splitlines(keepends=True) if not line.startswith(("steps", "sines")))

    with pytest.raises(DocumentError, match="neither steps nor sines"):
        loaded(tmp_path, text)
