"""Calibration of a robot's servos as a file: what was determined, and the recording that it was determined on."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path
from typing import Annotated

from pydantic import Field, StringConstraints

from rgss.documents import (
    DocumentModel,
    Hertz,
    Identifier,
    QuantityText,
    RadiansPerSecond,
    RadiansPerSecondSquared,
    Seconds,
    Text,
    load_document,
)
from rgss.errors import DefinitionError, DocumentError, QuantityError, RgssError
from rgss.identification.fitting import FitStatus, ServoFit
from rgss.identification.recording import Control, Recording
from rgss.identification.servo import JointServo
from rgss.quantities import parse_quantity

_GAIN_UNIT = "s**-2"


class CalibratedOnEntry(DocumentModel):
    """The recording of a calibration."""

    recording: Text
    sha256: Annotated[str, StringConstraints(pattern=r"^[0-9a-f]{64}$")]
    recorded: Text
    control: Control
    poses: Annotated[tuple[Text, ...], Field(min_length=1)]


class ServoEntry(DocumentModel):
    """A calibrated servo; what is missing was not determined and is zero."""

    velocity_gain: Hertz
    position_gain: QuantityText | None = None
    delay: Seconds = 0.0
    viscous_friction: Hertz = 0.0
    coulomb_friction: RadiansPerSecondSquared = 0.0
    residual: RadiansPerSecond | None = None


class CalibrationDocument(DocumentModel):
    """A calibration file."""

    calibration: Identifier
    calibrated_on: CalibratedOnEntry | None = None
    servos: Annotated[dict[Identifier, ServoEntry], Field(min_length=1)]


def load_calibration(path: Path) -> dict[str, JointServo]:
    """Read the servos of a calibration file by joint.

    Args:
        path: The file.

    Raises:
        DocumentError: The file is wrong; with every problem in it.
    """
    loaded = load_document(path, CalibrationDocument)
    found = {joint: _servo(entry) for joint, entry in loaded.value.servos.items()}
    findings = [
        loaded.document.finding("calibration.range", each.message, ("servos", joint), hint=each.hint)
        for joint, each in found.items()
        if isinstance(each, RgssError)
    ]
    if findings:
        raise DocumentError(sorted(findings))
    return {joint: each for joint, each in found.items() if isinstance(each, JointServo)}


def calibration_text(recording: Recording, fits: Sequence[ServoFit], *, file: str) -> str:
    """A calibration file with the determined parameters; what is not determined is a comment with the reason.

    Args:
        recording: The recording.
        fits: The fits of its joints.
        file: Name of the recording's file.

    Raises:
        DefinitionError: No joint's velocity gain is determined.
    """
    usable = [fit for fit in fits if "velocity_gain_hz" in fit.determined()]
    if not usable:
        raise DefinitionError(
            "no joint's velocity gain is determined, so there is no calibration",
            hint="record faster steps, more of them, or at a higher rate",
        )
    poses = dict.fromkeys(segment.pose for segment in recording.segments)
    lines = [
        f"# Servos fitted to a recording by 'rgss identify'; intervals have {_CONFIDENCE}.",
        f"calibration: {_quoted(recording.robot)}",
        "calibrated_on:",
        f"  recording: {_quoted(file)}",
        f"  sha256: {_quoted(recording.digest)}",
        f"  recorded: {_quoted(recording.recorded)}",
        f"  control: {recording.control.value}",
        f"  poses: [{', '.join(_quoted(pose) for pose in poses)}]",
        "servos:",
    ]
    for fit in usable:
        lines.append(f"  {fit.joint}:")
        if not fit.adequate:
            lines.append(f"    # {MISFIT}")
        for each in fit.parameters:
            key, unit = _KEYS[each.name]
            if each.status is FitStatus.DETERMINED and each.interval is not None:
                low, high = each.interval
                lines.append(f"    {key}: {each.value:.6g} {unit}  # {low:.6g} to {high:.6g} {unit}")
            else:
                lines.append(f"    # {key}: {each.status.value}: {each.reason}")
        lines.append(f"    residual: {max(fit.rms_rad_s.values()):.6g} rad/s")
    lines.extend(f"# {fit.joint}: velocity gain not determined" for fit in fits if fit not in usable)
    return "\n".join(lines) + "\n"


MISFIT = "the model misses part of the motion (a torque limit?): the intervals do not hold"
_CONFIDENCE = "95 % confidence"
_KEYS = {
    "velocity_gain_hz": ("velocity_gain", "s^-1"),
    "position_gain_hz2": ("position_gain", "s^-2"),
    "delay_s": ("delay", "s"),
    "viscous_hz": ("viscous_friction", "s^-1"),
    "coulomb_rad_s2": ("coulomb_friction", "rad/s^2"),
}
"""Key of a calibration file and unit of each parameter."""


def _servo(entry: ServoEntry) -> JointServo | RgssError:
    """The servo of an entry, or what is wrong with it."""
    try:
        gain = 0.0 if entry.position_gain is None else parse_quantity(entry.position_gain, _GAIN_UNIT)
        return JointServo(
            velocity_gain_hz=entry.velocity_gain,
            position_gain_hz2=gain,
            delay_s=entry.delay,
            viscous_hz=entry.viscous_friction,
            coulomb_rad_s2=entry.coulomb_friction,
        )
    except (QuantityError, DefinitionError) as error:
        return error


def _quoted(text: str) -> str:
    return json.dumps(text)
