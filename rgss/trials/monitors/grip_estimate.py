"""Estimate of the grip margin from sensed forces and assumed object properties."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass

from rgss.scenes.uncertainty import white_noise

_BLOCK = 4096
_NOISE = "gripper.force_sensor.noise.finger"


@dataclass(frozen=True, slots=True, kw_only=True)
class ForceSensorErrors:
    """Errors of the sensors of the fingers' normal forces.

    Attributes:
        noise_n: Standard deviation of white noise, drawn in each step for each finger.
        offset_n: Offset of each reading.
        delay_s: Age of a reading, in whole steps.
    """

    noise_n: float = 0.0
    offset_n: float = 0.0
    delay_s: float = 0.0


class GripEstimate:
    """Estimate of the grip margin, friction available over friction needed, from sensed forces and assumed properties.

    Attributes:
        mass_kg: Mass of the object assumed by the robot.
        friction: Coefficient of a finger on the object assumed by the robot.
    """

    def __init__(
        self,
        errors: ForceSensorErrors,
        *,
        mass_kg: float,
        friction: float,
        fingers: int,
        window_s: float,
        rate_hz: float,
        seed: int,
        noise_of: str = "",
    ) -> None:
        """Start without a reading.

        Args:
            errors: Errors of the sensors.
            mass_kg: The assumed mass.
            friction: The assumed coefficient of a finger on the object.
            fingers: Number of fingers.
            window_s: Averaging window of the forces.
            rate_hz: Steps a second.
            seed: The trial's seed; a finger has the same noise in every design.
            noise_of: Id of a further object, which has its own noise; empty for the first.
        """
        self.mass_kg = mass_kg
        self.friction = friction
        self._errors = errors
        self._seed = seed
        self._noise_name = f"{_NOISE}.{noise_of}" if noise_of else _NOISE
        self._fingers = fingers
        self._late: deque[tuple[float, ...]] = deque(maxlen=1 + round(errors.delay_s * rate_hz))
        self._window = max(1, round(window_s * rate_hz))
        self._sums_n: deque[float] = deque(maxlen=self._window)
        self._steps = 0
        self._noise_n: list[list[float]] = []

    def begin_phase(self) -> None:
        """Reset the average."""
        self._sums_n.clear()

    def read(self, forces_n: Sequence[float]) -> tuple[float, ...]:
        """Readings of a step; those of unloaded sensors during the initial delay.

        Args:
            forces_n: The true normal force of each finger.
        """
        late, errors = self._late, self._errors
        late.append(tuple(forces_n))
        seen = late[0] if len(late) == late.maxlen else (0.0,) * self._fingers
        noise_n = self._noise()
        # A pressure sensor does not report tension.
        return tuple([max(0.0, force + errors.offset_n + noise) for force, noise in zip(seen, noise_n, strict=True)])

    def after_step(self, forces_n: Sequence[float], load_m_s2: float) -> float | None:
        """Add the forces of a step in which the object is carried.

        Args:
            forces_n: The true normal force of each finger.
            load_m_s2: Tool acceleration minus gravity, in magnitude.

        Returns:
            The estimated margin; None before the window is full.
        """
        window = self._sums_n
        window.append(math.fsum(self.read(forces_n)))
        if len(window) < self._window:
            return None
        return self.friction * math.fsum(window) / self._window / (self.mass_kg * load_m_s2)

    def _noise(self) -> Sequence[float]:
        step, sd = self._steps, self._errors.noise_n
        self._steps += 1
        if sd == 0.0:
            return (0.0,) * self._fingers
        if step >= len(self._noise_n):
            count = len(self._noise_n) + _BLOCK
            columns = [
                white_noise(self._seed, f"{self._noise_name}.{finger}", count) for finger in range(self._fingers)
            ]
            self._noise_n = [[sd * value for value in row] for row in zip(*(c.tolist() for c in columns), strict=True)]
        return self._noise_n[step]
