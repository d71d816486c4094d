"""Recording of a stream as CSV: three lines of comment, a header with units, and one line for each period."""

from __future__ import annotations

import csv
import io
from collections.abc import Collection, Sequence
from itertools import groupby

import numpy as np

from rgss.drivers.streaming import Sample

_LABELS = ("time [s]", "pose", "joint", "signal")
_QUANTITIES = (
    "commanded position [{unit}]",
    "commanded velocity [{unit}/s]",
    "measured position [{unit}]",
    "measured velocity [{unit}/s]",
)
_SIGNAL = "planned motion"
_FEWEST_SAMPLES = 8
"""Of a segment that `rgss identify` reads."""


def recording_csv(
    samples: Sequence[Sample],
    joints: Sequence[str],
    *,
    robot: str,
    recorded: str,
    slides: Collection[str] = (),
) -> bytes:
    """Measured against commanded motion as CSV in UTF-8, which `rgss identify` reads.

    The column ``pose`` has the phase, ``joint`` the joint that moves most in it. A phase of fewer samples than a fit
    takes, such as a move that begins where the arm is, belongs to the next one, or at the end to the one before.

    Args:
        samples: The samples of a stream.
        joints: Names of the joints from base to flange.
        robot: Name of the robot.
        recorded: How it was recorded, in one line.
        slides: Names of the prismatic joints, whose positions are in m.
    """
    text = io.StringIO()
    text.write(f"# robot: {robot}\n# recorded: {recorded}\n# control: position\n")
    writer = csv.writer(text, lineterminator="\n")
    units = {joint: "m" if joint in slides else "rad" for joint in joints}
    columns = (f"{joint} {quantity.format(unit=units[joint])}" for joint in joints for quantity in _QUANTITIES)
    writer.writerow([*_LABELS, *columns])
    for phase, part in _parts(samples):
        travel = np.ptp(np.array([sample.commanded.positions_rad for sample in part]), axis=0)
        labels = (phase, joints[int(np.argmax(travel))], _SIGNAL)
        for sample in part:
            wanted, got = sample.commanded, sample.measured
            # A robot that reports another number of joints is a fault; its last sample is left out.
            if len(got.positions_rad) != len(joints) or len(got.velocities_rad_s) != len(joints):
                continue
            rows = zip(
                wanted.positions_rad, wanted.velocities_rad_s, got.positions_rad, got.velocities_rad_s, strict=True
            )
            writer.writerow([f"{sample.time_s:.9g}", *labels, *(f"{value:.9g}" for row in rows for value in row)])
    return text.getvalue().encode()


def _parts(samples: Sequence[Sample]) -> list[tuple[str, list[Sample]]]:
    """Samples by phase, without short parts."""
    found: list[tuple[str, list[Sample]]] = []
    short: list[Sample] = []
    for phase, group in groupby(samples, key=lambda sample: sample.phase):
        part = [*short, *group]
        short = part if len(part) < _FEWEST_SAMPLES else []
        if not short:
            found.append((phase, part))
    if short and found:
        found[-1][1].extend(short)
    return found or ([(short[-1].phase, short)] if short else [])
