"""Reader of calibration files."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Annotated

from pydantic import Field, StringConstraints

from rgss.documents import (
    Document,
    DocumentModel,
    Hertz,
    Identifier,
    JointAcceleration,
    JointSpeed,
    QuantityText,
    Seconds,
    Text,
    load_document,
)
from rgss.errors import DefinitionError, DocumentError, QuantityError, RgssError
from rgss.findings import Finding
from rgss.quantities import parse_quantity
from rgss.scenes.servos.calibration import Calibration
from rgss.scenes.servos.servo import JointServo, ServoControl

_GAIN_UNIT = "s**-2"


class CalibratedOnEntry(DocumentModel):
    """The recording of a calibration."""

    recording: Text
    sha256: Annotated[str, StringConstraints(pattern=r"^[0-9a-f]{64}$")]
    recorded: Text
    control: ServoControl
    poses: Annotated[tuple[Text, ...], Field(min_length=1)]


class ServoEntry(DocumentModel):
    """A calibrated servo; missing parameters were not identified and are zero."""

    velocity_gain: Hertz
    position_gain: QuantityText | None = None
    delay: Seconds = 0.0
    viscous_friction: Hertz = 0.0
    coulomb_friction: JointAcceleration | None = None
    residual: JointSpeed | None = None
    adequate: bool = True


class CalibrationDocument(DocumentModel):
    """A calibration file."""

    calibration: Identifier
    calibrated_on: CalibratedOnEntry | None = None
    servos: Annotated[dict[Identifier, ServoEntry], Field(min_length=1)]


def load_calibration(path: Path, *, label: str | None = None) -> Calibration:
    """Read a calibration file.

    Args:
        path: The file.
        label: The file's name in messages; the path by default.

    Raises:
        DocumentError: The file is invalid; with every problem in it.
    """
    loaded = load_document(path, CalibrationDocument, label=label)
    entry = loaded.value
    found = {joint: _servo(servo) for joint, servo in entry.servos.items()}
    servos = {joint: each for joint, each in found.items() if isinstance(each, JointServo)}
    on = entry.calibrated_on
    gains = [servo.position_gain_hz2 > 0.0 for servo in servos.values()]
    control = (ServoControl.POSITION if any(gains) else ServoControl.VELOCITY) if on is None else on.control
    findings = [*_range_findings(found, loaded.document), *_gain_findings(servos, control, loaded.document)]
    if findings:
        raise DocumentError(sorted(findings))
    return Calibration(
        robot=entry.calibration,
        control=control,
        servos=tuple(servos.items()),
        recording="" if on is None else on.recording,
        sha256="" if on is None else on.sha256,
        recorded="" if on is None else on.recorded,
        misfits=tuple(joint for joint, servo in entry.servos.items() if not servo.adequate),
    )


def _range_findings(found: Mapping[str, JointServo | RgssError], document: Document) -> Iterator[Finding]:
    for joint, each in found.items():
        if isinstance(each, RgssError):
            yield document.finding("calibration.range", each.message, ("servos", joint), hint=each.hint)


def _gain_findings(servos: Mapping[str, JointServo], control: ServoControl, document: Document) -> Iterator[Finding]:
    """Findings for servos under position control without a position gain."""
    if control is ServoControl.VELOCITY:
        return
    for joint, servo in servos.items():
        if servo.position_gain_hz2 == 0.0:
            message = f"servo {joint!r} has no position gain, and was fitted under position control"
            hint = "record larger positions, or record under velocity control"
            yield document.finding("calibration.no-position-gain", message, ("servos", joint), hint=hint)


def _servo(entry: ServoEntry) -> JointServo | RgssError:
    """Servo of an entry, or the error of its parameters."""
    try:
        gain = 0.0 if entry.position_gain is None else parse_quantity(entry.position_gain, _GAIN_UNIT)
        return JointServo(
            velocity_gain_hz=entry.velocity_gain,
            position_gain_hz2=gain,
            delay_s=entry.delay,
            viscous_hz=entry.viscous_friction,
            coulomb_rad_s2=0.0 if entry.coulomb_friction is None else entry.coulomb_friction.value,
        )
    except (QuantityError, DefinitionError) as error:
        return error
