"""Recordings as CSV are read back as written, and every mistake in one gets one line."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from rgss.errors import DocumentError
from rgss.identification import CommandedPositions, read_recording, recording_file, write_recording
from rgss.scenes import JointServo
from tests.identification.recordings import motions_of, recording_of


@pytest.fixture
def path(tmp_path):
    file = tmp_path / "recording.csv"
    write_recording(file, recording_of(motions_of(JointServo(velocity_gain_hz=30), (0.5,), rate_hz=50)))
    return file


def complaint(path):
    with pytest.raises(DocumentError) as caught:
        read_recording(path)
    (finding,) = caught.value.findings
    return finding


def edit(path, line, old, new):
    lines = path.read_text().splitlines()
    assert old in lines[line - 1]
    lines[line - 1] = lines[line - 1].replace(old, new, 1)
    path.write_text("\n".join(lines) + "\n")


def test_a_recording_is_read_back(path):
    written = recording_of(motions_of(JointServo(velocity_gain_hz=30), (0.5,), rate_hz=50))

    found = read_recording(path)

    assert (found.robot, found.recorded, found.control, found.joints) == ("r", "simulated", written.control, ("j1",))
    (segment,), (expected,) = found.segments, written.segments
    assert np.allclose(segment.times_s, expected.times_s, atol=1e-9)
    assert np.allclose(segment.excited.measured_rad_s, expected.excited.measured_rad_s, atol=1e-8)
    assert len(found.digest) == 64


@pytest.mark.parametrize("commands", list(CommandedPositions))
def test_the_course_of_commanded_positions_is_read_back(tmp_path, commands):
    file = tmp_path / "recording.csv"
    write_recording(file, recording_of(motions_of(JointServo(velocity_gain_hz=30), (0.5,)), commands=commands))

    assert read_recording(file).commands is commands


def test_commanded_positions_are_held_unless_the_file_states_otherwise(path):
    assert "# commands" not in path.read_text()
    assert read_recording(path).commands is CommandedPositions.HELD


def test_a_byte_order_mark_is_no_part_of_it(path):
    """Spreadsheets write one."""
    path.write_bytes(b"\xef\xbb\xbf" + path.read_bytes())
    assert read_recording(path).robot == "r"


def test_times_in_milliseconds_are_refused(path):
    head, lines = path.read_text().splitlines()[:4], path.read_text().splitlines()[4:]
    rows = [line.split(",") for line in lines]
    slow = [",".join((f"{1e3 * float(time):g}", *rest)) for time, *rest in rows]
    path.write_text("\n".join([*head, *slow]) + "\n")

    found = complaint(path)

    assert found.line == 6
    assert found.message == "samples are 20 s apart, at most 0.2 s are allowed"
    assert found.hint == "times are in s, not in ms; record faster if they are"


def test_degrees_are_converted(path):
    before = read_recording(path).segments[0].excited
    text = path.read_text().replace("[rad", "[deg")
    path.write_text(text)

    after = read_recording(path).segments[0].excited

    assert np.allclose(after.commanded_rad_s, np.radians(before.commanded_rad_s))


@pytest.mark.parametrize(
    ("line", "old", "new", "message"),
    [
        (1, "# robot: r", "# robot:", "line 1 must be '# robot: …'"),
        (3, "velocity", "torque", "unknown control 'torque'"),
        (4, "time [s]", "# commands: late", "line 4 may be '# commands: held or interpolated', got"),
        (4, "time [s]", "time [ms]", "column 1 must be 'time [s]'"),
        (4, "j1 commanded position [rad]", "j1 position", "column 5 must be 'JOINT commanded position [rad]'"),
        (4, "measured velocity [rad/s]", "measured velocity [deg/s]", "column 8 must be"),
        (6, "0.02", "nan", "time [s] must be a finite number, got 'nan'"),
        (7, ",0,", ",x,", "must be a finite number, got 'x'"),
        (8, ",s0,", ",s0", "the line has 7 fields, the header has 8"),
        (9, "0.08", "0.01", "times must rise"),
        (9, "p,j1", "q,j1", "the segment has"),
        (5, "p,j1", "p,j9", "unknown joint 'j9'"),
        (6, "p,j1", 'p,"j1', "the file is not CSV"),
    ],
)
def test_a_mistake_has_one_line_at_its_place(path, line, old, new, message):
    edit(path, line, old, new)

    found = complaint(path)

    assert message in found.message
    assert "\n" not in str(found)
    if "segment" not in message and "CSV" not in message:
        assert found.line == line


def test_a_gap_is_missing_samples(path):
    lines = path.read_text().splitlines()
    path.write_text("\n".join(lines[:10] + lines[13:]) + "\n")

    found = complaint(path)

    assert "samples are missing: 0.08 s to this one, 0.02 s usually" in found.message
    assert found.line == 11


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"", "line 1 must be"),
        (b"\xff\xfe", "not UTF-8"),
        (b"# robot: r\n# recorded: x\n# control: velocity\n", "column 1 must be 'time [s]'"),
    ],
)
def test_what_is_no_recording_is_refused(tmp_path, content, message):
    (tmp_path / "a.csv").write_bytes(content)

    assert message in complaint(tmp_path / "a.csv").message


def test_a_recording_without_samples_is_refused(path):
    path.write_text("\n".join(path.read_text().splitlines()[:4]) + "\n")

    assert "no samples" in complaint(path).message


def test_joints_are_named_once(path):
    edit(
        path,
        4,
        "j1 measured velocity [rad/s]",
        "j1 measured velocity [rad/s],"
        + ",".join(
            f"j1 {name} [rad{per}]"
            for name, per in (
                ("commanded position", ""),
                ("commanded velocity", "/s"),
                ("measured position", ""),
                ("measured velocity", "/s"),
            )
        ),
    )

    assert "has columns twice" in complaint(path).message


def test_what_has_no_end_or_is_too_large_is_not_read(tmp_path, monkeypatch):
    large = tmp_path / "large.csv"
    with large.open("wb") as file:
        file.truncate(2 * 1024 * 1024)
    monkeypatch.setattr(recording_file, "LARGEST_RECORDING_BYTES", 1024 * 1024)

    assert "cannot be read: larger than the 1 MiB" in complaint(large).message
    assert "cannot be read: not a regular file" in complaint(Path("/dev/zero")).message


def test_a_file_that_is_not_there(tmp_path):
    assert "cannot be read" in complaint(tmp_path / "none.csv").message


def scaled(path, column, factor):
    """The values of a column times a factor."""
    head, rows = path.read_text().splitlines()[:4], [line.split(",") for line in path.read_text().splitlines()[4:]]
    for row in rows:
        row[column] = f"{float(row[column]) * factor:.9g}"
    path.write_text("\n".join([*head, *map(",".join, rows)]) + "\n")


@pytest.mark.parametrize(("column", "factor", "ratio"), [(7, 57.3, "0.017"), (6, 57.3, "57"), (7, -1.0, "-1")])
def test_positions_and_velocities_in_different_units_are_refused(path, column, factor, ratio):
    """The fit would take velocities in degrees for radians, with a Coulomb friction that is 57 times too large."""
    scaled(path, column, factor)

    found = complaint(path)

    assert found.line == 5
    change = f"change by {ratio} times the integral of its measured velocities"
    assert found.message == f"measured positions of j1 {change}"
    assert found.hint == "give both in the unit of their columns and in one direction"


def test_a_gyroscope_with_a_wrong_scale_is_read(path):
    scaled(path, 7, 1.3)
    assert read_recording(path).joints == ("j1",)


def test_motion_that_noise_hides_is_not_compared(path):
    noise = np.random.default_rng(1).normal(0.0, 1e-3, 10_000)
    head, rows = path.read_text().splitlines()[:4], [line.split(",") for line in path.read_text().splitlines()[4:]]
    for row, one in zip(rows, noise, strict=False):
        row[6] = f"{one:.9g}"
    path.write_text("\n".join([*head, *map(",".join, rows)]) + "\n")
    assert read_recording(path).joints == ("j1",)
