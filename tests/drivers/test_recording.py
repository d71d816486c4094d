"""The recording of a stream."""

import csv
from dataclasses import replace

from rgss.drivers import StreamSettings, recording_csv, stream
from rgss.identification import read_recording
from tests.drivers.conftest import guard, pick_task


def test_a_recording_has_units_and_the_joint_that_moves_most(robot):
    task = pick_task()
    result = stream(robot, task, guard(), robot, StreamSettings(speed=1.0))
    text = recording_csv(result.samples, ("j0", "j1", "j2"), robot="arm", recorded="by a test").decode()
    lines = text.splitlines()
    assert lines[:3] == ["# robot: arm", "# recorded: by a test", "# control: position"]
    rows = list(csv.reader(lines[3:]))
    assert rows[0][:8] == [
        *("time [s]", "pose", "joint", "signal"),
        *("j0 commanded position [rad]", "j0 commanded velocity [rad/s]"),
        *("j0 measured position [rad]", "j0 measured velocity [rad/s]"),
    ]
    assert {len(row) for row in rows} == {4 + 4 * 3}
    assert len(rows) == 1 + len(result.samples)
    assert list(dict.fromkeys(row[1] for row in rows[1:])) == ["go", "close", "back"]
    last, sample = rows[-1], result.samples[-1]
    assert float(last[0]) == round(sample.time_s, 9)
    assert abs(float(last[4]) - sample.commanded.positions_rad[0]) < 1e-9
    assert abs(float(last[6]) - sample.measured.positions_rad[0]) < 1e-9


def test_a_report_with_other_joints_is_left_out(robot):
    result = stream(robot, pick_task(), guard(), robot, StreamSettings(speed=1.0))
    text = recording_csv(result.samples[:2], ("j0", "j1"), robot="arm", recorded="by a test").decode()
    assert len(text.splitlines()) == 4


def test_positions_of_a_joint_that_slides_are_in_metres(robot, tmp_path):
    result = stream(robot, pick_task(), guard(), robot, StreamSettings(speed=1.0))
    content = recording_csv(
        result.samples, ("j0", "j1", "j2"), robot="arm", recorded="by a test", slides=frozenset({"j1"})
    )
    (tmp_path / "recording.csv").write_bytes(content)
    found = read_recording(tmp_path / "recording.csv")
    assert [found.unit_of(joint) for joint in found.joints] == ["rad", "m", "rad"]


def test_a_phase_too_short_for_a_fit_belongs_to_the_next_and_at_the_end_to_the_one_before(robot, tmp_path):
    samples = stream(robot, pick_task(), guard(), robot, StreamSettings(speed=1.0)).samples
    named = [*("start",) * 3, *("go",) * 40, *("blink",) * 7, *("back",) * 20, *("end",) * 2]
    cut = [replace(sample, phase=phase) for sample, phase in zip(samples, named, strict=False)]
    for count, phases in ((72, ["go", "back"]), (5, ["go"]), (3, ["start"])):
        (tmp_path / "recording.csv").write_bytes(
            recording_csv(cut[:count], ("j0", "j1", "j2"), robot="arm", recorded="by a test")
        )
        rows = list(csv.reader((tmp_path / "recording.csv").read_text(encoding="utf-8").splitlines()[4:]))
        assert list(dict.fromkeys(row[1] for row in rows)) == phases
        assert len(rows) == count
        if count == 72:
            assert [one.pose for one in read_recording(tmp_path / "recording.csv").segments] == phases
