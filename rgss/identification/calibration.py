"""Text of a calibration file: identified parameters, and the recording of the identification."""

from __future__ import annotations

import json
import re
from collections.abc import Sequence

from rgss.documents import IDENTIFIER_PATTERN
from rgss.errors import DefinitionError
from rgss.findings import shown
from rgss.identification.fitting import FitStatus, ServoFit
from rgss.identification.recording import Recording
from rgss.identification.servo_parameters import parameter_key


def calibration_text(recording: Recording, fits: Sequence[ServoFit], *, file: str) -> str:
    """Text of a calibration file with the identified parameters; others are comments with the reason.

    Args:
        recording: The recording.
        fits: The fits of its joints.
        file: Name of the recording's file.

    Raises:
        DefinitionError: No joint's velocity gain is determined, or a name cannot be one of a robot's file.
    """
    _require_identifiers(recording, fits)
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
            lines.append(f"    adequate: false  # {MISFIT}")
        for each in fit.parameters:
            key, unit = parameter_key(each.name, recording.unit_of(fit.joint))
            if each.status is FitStatus.DETERMINED and each.interval is not None:
                low, high = each.interval
                lines.append(f"    {key}: {each.value:.6g} {unit}  # {low:.6g} to {high:.6g} {unit}")
            else:
                lines.append(f"    # {key}: {each.status.value}: {each.reason}")
        lines.append(f"    residual: {max(fit.rms_rad_s.values()):.6g} {recording.unit_of(fit.joint)}/s")
    lines.extend(f"# {fit.joint}: velocity gain not determined" for fit in fits if fit not in usable)
    return "\n".join(lines) + "\n"


MISFIT = "the model misses part of the motion (a torque limit?): the intervals do not hold"
_CONFIDENCE = "95 % confidence"


def _require_identifiers(recording: Recording, fits: Sequence[ServoFit]) -> None:
    names = [("robot", recording.robot, "line 1"), *(("joint", fit.joint, "the header") for fit in fits)]
    for what, name, where in names:
        if not re.fullmatch(IDENTIFIER_PATTERN, name):
            raise DefinitionError(
                f"a calibration names the {what} as the robot's file does, which {shown(name)} cannot be",
                hint=f"write that name in {where} of the recording: a letter, then letters, digits, '_', '.', '-'",
            )


def _quoted(text: str) -> str:
    return json.dumps(text)
