"""Recording of a stream as CSV: one row for each joint and time."""

from __future__ import annotations

import csv
import io
from collections.abc import Sequence

from rgss.drivers.streaming import Sample

COLUMNS = (
    "time_s",
    "joint",
    "phase",
    "gripper",
    "commanded_position_rad",
    "measured_position_rad",
    "commanded_velocity_rad_s",
    "measured_velocity_rad_s",
)


def recording_csv(samples: Sequence[Sample], joints: Sequence[str]) -> bytes:
    """Measured against commanded motion as CSV in UTF-8; numbers are written so that they read back exactly.

    Args:
        samples: The samples of a stream.
        joints: Names of the joints from base to flange.
    """
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(COLUMNS)
    for sample in samples:
        commanded, measured = sample.commanded, sample.measured
        for joint, *values in zip(
            joints,
            commanded.positions_rad,
            measured.positions_rad,
            commanded.velocities_rad_s,
            measured.velocities_rad_s,
            strict=False,
        ):
            writer.writerow([repr(sample.time_s), joint, sample.phase, commanded.gripper.value, *map(repr, values)])
    return text.getvalue().encode()
