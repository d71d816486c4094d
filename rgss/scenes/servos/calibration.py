"""Calibration of a robot: fitted servo models of its joints, and the provenance of the fit."""

from __future__ import annotations

from dataclasses import dataclass

from rgss.scenes.servos.servo import JointServo, ServoControl


@dataclass(frozen=True, slots=True, kw_only=True)
class Calibration:
    """Fitted servo models of a robot.

    Attributes:
        robot: The recorded robot.
        control: The command interface of the fit. Without a recording, position control if a servo has a position gain.
        servos: Joint and its servo, in the order of the file.
        recording: Name of the recording; empty if the file names none.
        sha256: SHA-256 of the recording's content.
        recorded: Origin of the recording, as stated in it.
        misfits: The joints whose motion the model reproduces only in part.
    """

    robot: str
    control: ServoControl
    servos: tuple[tuple[str, JointServo], ...]
    recording: str = ""
    sha256: str = ""
    recorded: str = ""
    misfits: tuple[str, ...] = ()

    @property
    def origin(self) -> str:
        """Provenance of the calibration, as a phrase."""
        if not self.recording:
            return f"a file of {self.robot} that names no recording"
        return f"{self.recording} of {self.robot} ({self.recorded}; SHA-256 {self.sha256[:12]})"
