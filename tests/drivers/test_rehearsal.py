"""A rehearsal lists what would be sent, and what would be refused."""

import pytest

from rgss.drivers import GripperState, StreamSettings, rehearse
from tests.drivers.conftest import StraightTool, limits, pick_task


def test_what_would_be_sent():
    found = rehearse(pick_task(), limits(), StraightTool(), StreamSettings(speed=0.5), rate_hz=100.0)
    assert (found.refusal, found.start_rad) == ("", (0.0, 0.0, 0.0))
    assert [segment.name for segment in found.segments] == ["go", "close", "back"]
    go, close, back = found.segments
    assert (go.gripper, close.gripper, back.gripper) == (GripperState.OPEN, *[GripperState.CLOSED] * 2)
    # Half of pi / 4 rad/s against 1 rad/s; a quarter of pi**2 / 4 rad/s^2 against 4 rad/s^2; a lever of 2 m.
    assert back.peak_speed == pytest.approx(0.3927, rel=1e-2)
    assert back.peak_acceleration == pytest.approx(0.1542, rel=3e-2)
    assert back.peak_tool_speed_m_s == pytest.approx(0.7854, rel=1e-2)
    assert (close.duration_s, close.set_points, close.peak_speed) == (pytest.approx(0.3), 30, 0.0)
    assert found.duration_s == pytest.approx(2.25 + 0.3 + 2.0, abs=0.05)


def test_what_would_be_refused():
    found = rehearse(pick_task(), limits(upper_rad=(0.25,) * 3), StraightTool(), StreamSettings(), rate_hz=100.0)
    assert "outside -57.30 to 14.32 deg" in found.refusal
    assert [segment.name for segment in found.segments] == ["go"]
