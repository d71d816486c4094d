"""Calibration of a robot: its joints' servos as they were fitted, and the recording that they were fitted to."""

from __future__ import annotations

from dataclasses import dataclass

from rgss.scenes.servos.servo import JointServo, ServoControl


@dataclass(frozen=True, slots=True, kw_only=True)
class Calibration:
    """The servos of a robot as they were fitted.

    Attributes:
        robot: The robot that was recorded.
        control: The command under which they were fitted. Of a file without a recording, positions if a servo has
            a position gain.
        servos: Joint and its servo, in the order of the file.
        recording: Name of the recording; empty if the file names none.
        sha256: SHA-256 of the recording's content.
        recorded: The recording's origin, in its own words.
        misfits: The joints of which the model misses part of the motion.
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
        """What the servos were calibrated on, in a phrase."""
        if not self.recording:
            return "a file that names no recording"
        return f"{self.recording} ({self.recorded}; SHA-256 {self.sha256[:12]})"
