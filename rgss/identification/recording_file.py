"""Recordings as CSV: three lines of comment, a header with units, and one line for each sample."""

from __future__ import annotations

import csv
import hashlib
import io
import math
import re
from collections.abc import Sequence
from itertools import groupby, pairwise
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from rgss.documents import chunks_of, write_output
from rgss.errors import DocumentError
from rgss.findings import Finding, Severity, shown
from rgss.identification.recording import CommandedPositions, JointSeries, Recording, Segment
from rgss.scenes import ServoControl

LARGEST_RECORDING_BYTES = 128 * 1024 * 1024
"""Size of the largest recording that is read: about an hour of six joints at 125 Hz."""

LEAST_SAMPLES = 8
LARGEST_GAP = 1.5
"""Time between samples of a segment, over the usual one, from which samples are missing."""

MOST_VELOCITY_RATIO = 2.0
"""Ratio of the change of a position to the integral of its velocity, or its inverse, from which the two disagree."""

LONGEST_SAMPLING_S = 0.2
"""Usual time between samples from which the response of a servo is not seen; times in ms are longer."""

Array = NDArray[np.float64]

_LEAST_CORRELATION = 0.9

_COMMENTS = ("robot", "recorded", "control")
_COMMANDS = "# commands:"
_LABELS = ("time [s]", "pose", "joint", "signal")
_QUANTITIES = (
    ("commanded position", ""),
    ("commanded velocity", "/s"),
    ("measured position", ""),
    ("measured velocity", "/s"),
)
_FACTORS = {"rad": 1.0, "deg": math.pi / 180.0, "m": 1.0}
_COLUMN = re.compile(r"^(?P<joint>\S+) commanded position \[(?P<unit>rad|deg|m)\]$")


def write_recording(path: Path, recording: Recording) -> None:
    """Write a recording as CSV, in seconds, radians and metres.

    Raises:
        OSError: The file cannot be written.
    """
    text = io.StringIO()
    for key, value in zip(_COMMENTS, (recording.robot, recording.recorded, recording.control.value), strict=True):
        text.write(f"# {key}: {value}\n")
    if recording.commands is not CommandedPositions.HELD:
        text.write(f"{_COMMANDS} {recording.commands.value}\n")
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(
        [*_LABELS, *(name for joint in recording.joints for name in _columns(joint, recording.unit_of(joint)))]
    )
    for segment in recording.segments:
        columns = [
            values
            for joint in recording.joints
            for values in (
                segment.series[joint].commanded_rad,
                segment.series[joint].commanded_rad_s,
                segment.series[joint].measured_rad,
                segment.series[joint].measured_rad_s,
            )
        ]
        labels = (segment.pose, segment.joint, segment.signal)
        for time_s, row in zip(segment.times_s.tolist(), np.column_stack(columns).tolist(), strict=True):
            writer.writerow([f"{time_s:.9g}", *labels, *(f"{value:.9g}" for value in row)])
    write_output(path, text.getvalue().encode())


def read_recording(path: Path) -> Recording:
    """Read a recording, strictly.

    Args:
        path: The CSV file.

    Raises:
        DocumentError: The file is not a recording; with its first problem.
    """
    try:
        content = b"".join(chunks_of(path, largest=LARGEST_RECORDING_BYTES))
        text = content.decode("utf-8-sig")
    except OSError as error:
        raise _wrong(path, 1, f"the file cannot be read: {error.strerror}") from error
    except UnicodeDecodeError as error:
        raise _wrong(path, 1, "the file is not UTF-8") from error
    lines = text.splitlines()
    comments, head = _comments(path, lines)
    reader = csv.reader(lines[head:], strict=True)
    try:
        rows = list(reader)
    except csv.Error as error:
        raise _wrong(path, head + reader.line_num, f"the file is not CSV: {error}") from error
    header = rows[0] if rows else []
    joints, units = _joints(path, header, head)
    values = _values(path, rows[1:], header, head)
    values[:, 1:] *= np.repeat([_FACTORS[unit] for unit in units], len(_QUANTITIES))
    labels = [(row[1], row[2], row[3]) for row in rows[1:]]
    _check_times(path, values[:, 0], labels, head)
    segments, start = [], 0
    for (pose, joint, signal), group in groupby(labels):
        end = start + len(list(group))
        line = head + 2 + start
        if joint not in joints:
            raise _wrong(path, line, f"unknown joint {shown(joint)}", f"the columns have {', '.join(joints)}", 3)
        if end - start < LEAST_SAMPLES:
            problem = f"the segment has {end - start} samples, at least {LEAST_SAMPLES} are needed"
            raise _wrong(path, line, problem)
        part = values[start:end]
        series = {
            name: JointSeries(
                commanded_rad=part[:, 1 + 4 * index],
                commanded_rad_s=part[:, 2 + 4 * index],
                measured_rad=part[:, 3 + 4 * index],
                measured_rad_s=part[:, 4 + 4 * index],
            )
            for index, name in enumerate(joints)
        }
        _check_velocities(path, line, joint, part[:, 0], series[joint])
        segments.append(Segment(pose=pose, joint=joint, signal=signal, times_s=part[:, 0], series=series))
        start = end
    return Recording(
        robot=comments["robot"],
        recorded=comments["recorded"],
        control=ServoControl(comments["control"]),
        joints=joints,
        segments=tuple(segments),
        digest=hashlib.sha256(content).hexdigest(),
        slides=frozenset(joint for joint, unit in zip(joints, units, strict=True) if unit == "m"),
        commands=CommandedPositions(comments["commands"]),
    )


def _columns(joint: str, unit: str) -> list[str]:
    return [f"{joint} {name} [{unit}{per}]" for name, per in _QUANTITIES]


def _comments(path: Path, lines: Sequence[str]) -> tuple[dict[str, str], int]:
    """Values of the comments, and their number of lines."""
    found = {}
    for index, key in enumerate(_COMMENTS):
        line = lines[index] if index < len(lines) else ""
        start = f"# {key}:"
        if not line.startswith(start) or not line[len(start) :].strip():
            raise _wrong(path, index + 1, f"line {index + 1} must be '{start} …', got {shown(line)}")
        found[key] = line[len(start) :].strip()
    kinds = [each.value for each in ServoControl]
    if found["control"] not in kinds:
        raise _wrong(path, 3, f"unknown control {shown(found['control'])}", f"write one of {', '.join(kinds)}")
    found["commands"] = CommandedPositions.HELD.value
    line = lines[len(_COMMENTS)] if len(lines) > len(_COMMENTS) else ""
    if not line.startswith("#"):
        return found, len(_COMMENTS)
    found["commands"] = line.removeprefix(_COMMANDS).strip()
    courses = [each.value for each in CommandedPositions]
    if found["commands"] not in courses:
        raise _wrong(path, len(_COMMENTS) + 1, f"line 4 may be '{_COMMANDS} {' or '.join(courses)}', got {shown(line)}")
    return found, len(_COMMENTS) + 1


def _joints(path: Path, header: Sequence[str], head: int) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Names of the joints, and the unit of the positions of each."""
    line = head + 1
    for index, name in enumerate(_LABELS):
        got = header[index] if index < len(header) else ""
        if got != name:
            raise _wrong(path, line, f"column {index + 1} must be {name!r}, got {shown(got)}", "", index + 1)
    joints: list[str] = []
    units: list[str] = []
    for first in range(len(_LABELS), max(len(header), len(_LABELS) + 1), 4):
        begin = _COLUMN.match(header[first]) if first < len(header) else None
        if begin is None:
            got = header[first] if first < len(header) else ""
            problem = f"column {first + 1} must be 'JOINT commanded position [rad]', got {shown(got)}"
            raise _wrong(
                path, line, problem, "angles are in rad or in deg, positions of a joint that slides in m", first + 1
            )
        joint, unit = begin["joint"], begin["unit"]
        for index, name in enumerate(_columns(joint, unit), start=first):
            got = header[index] if index < len(header) else ""
            if got != name:
                raise _wrong(path, line, f"column {index + 1} must be {name!r}, got {shown(got)}", "", index + 1)
        if joint in joints:
            raise _wrong(path, line, f"joint {shown(joint)} has columns twice", "", first + 1)
        joints.append(joint)
        units.append(unit)
    return tuple(joints), tuple(units)


def _values(path: Path, rows: Sequence[Sequence[str]], header: Sequence[str], head: int) -> Array:
    """Time and motion of each line, in the units of the file."""
    if not rows:
        raise _wrong(path, head + 2, "the recording has no samples")
    found = []
    for line, row in enumerate(rows, start=head + 2):
        if len(row) != len(header):
            raise _wrong(path, line, f"the line has {len(row)} fields, the header has {len(header)}")
        numbers = []
        for index in (0, *range(len(_LABELS), len(row))):
            try:
                number = float(row[index])
            except ValueError:
                number = math.nan
            if not math.isfinite(number):
                problem = f"{header[index]} must be a finite number, got {shown(row[index])}"
                raise _wrong(path, line, problem, "", index + 1)
            numbers.append(number)
        found.append(numbers)
    return np.array(found)


def _check_times(path: Path, times_s: Array, labels: Sequence[tuple[str, str, str]], head: int) -> None:
    differences = np.diff(times_s)
    inside = np.array([one == other for one, other in pairwise(labels)], dtype=bool)
    usual_s = float(np.median(differences[inside])) if inside.any() else math.inf
    if inside.any() and usual_s > LONGEST_SAMPLING_S:
        problem = f"samples are {usual_s:g} s apart, at most {LONGEST_SAMPLING_S:g} s are allowed"
        raise _wrong(path, head + 3, problem, "times are in s, not in ms; record faster if they are")
    for index, difference_s in enumerate(differences.tolist()):
        line = head + 3 + index
        if difference_s <= 0.0:
            raise _wrong(path, line, f"times must rise: {times_s[index + 1]:g} s follows {times_s[index]:g} s")
        if inside[index] and difference_s > LARGEST_GAP * usual_s:
            problem = f"samples are missing: {difference_s:g} s to this one, {usual_s:g} s usually"
            raise _wrong(path, line, problem, "record the segment again")


def _check_velocities(path: Path, line: int, joint: str, times_s: Array, series: JointSeries) -> None:
    """Refuse a segment whose measured velocities are not those of its measured positions, such as others in degrees.

    Motion that noise hides is not compared.
    """
    speeds = series.measured_rad_s
    steps = 0.5 * (speeds[1:] + speeds[:-1]) * np.diff(times_s)
    travel = np.concatenate([[0.0], np.cumsum(steps)])
    moved, travel = series.measured_rad - np.mean(series.measured_rad), travel - np.mean(travel)
    both = float(np.linalg.norm(moved) * np.linalg.norm(travel))
    if both == 0.0 or abs(float(moved @ travel)) < _LEAST_CORRELATION * both:
        return
    ratio = float(moved @ travel) / float(travel @ travel)
    if 1.0 / MOST_VELOCITY_RATIO <= ratio <= MOST_VELOCITY_RATIO:
        return
    problem = f"measured positions of {joint} change by {ratio:.2g} times the integral of its measured velocities"
    raise _wrong(path, line, problem, "give both in the unit of their columns and in one direction")


def _wrong(path: Path, line: int, message: str, hint: str = "", column: int = 1) -> DocumentError:
    """An error at a line; the column is counted in fields."""
    found = Finding(
        file=str(path),
        line=line,
        column=column,
        rule="recording.format",
        severity=Severity.ERROR,
        message=message,
        hint=hint,
    )
    return DocumentError([found])
