"""Trajectory: a smooth path with its timing."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rgss.motion.blending import SmoothPath

Vector = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Trajectory:
    """Timed motion from rest to rest, with constant acceleration of the path parameter s between its knots.

    Attributes:
        path: The path of the motion.
        parameters: The path's parameter s at the knots, shape (n,).
        rates: Its rate ds/dt at the knots in 1/s, shape (n,).
        times_s: Time at the knots, shape (n,), from 0.
        peak_tool_speed_m_s: Greatest speed of the tool centre.
        peak_tool_acceleration_m_s2: Greatest acceleration of the tool centre.
    """

    path: SmoothPath
    parameters: Vector
    rates: Vector
    times_s: Vector
    peak_tool_speed_m_s: float
    peak_tool_acceleration_m_s2: float

    @property
    def duration_s(self) -> float:
        """Time from start to end."""
        return float(self.times_s[-1])

    def positions(self, times: ArrayLike) -> Vector:
        """Joint angles in rad, shape (n, joints), at given times (s).

        Before the start and after the end the arm rests there.

        Args:
            times: Times in s, shape (n,).
        """
        time = np.clip(np.atleast_1d(np.asarray(times, dtype=float)), 0.0, self.duration_s)
        knot = np.clip(np.searchsorted(self.times_s, time, side="right") - 1, 0, len(self.times_s) - 2)
        span = self.times_s[knot + 1] - self.times_s[knot]
        safe = np.where(span > 0.0, span, 1.0)
        acceleration = np.where(span > 0.0, (self.rates[knot + 1] - self.rates[knot]) / safe, 0.0)
        since = time - self.times_s[knot]
        parameter = self.parameters[knot] + self.rates[knot] * since + 0.5 * acceleration * since**2
        return self.path(np.clip(parameter, self.parameters[knot], self.parameters[knot + 1]))
