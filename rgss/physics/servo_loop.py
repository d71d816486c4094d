"""Exact discretisation of joint servos' velocity loops, and step means of delayed commands."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from rgss.scenes import JointServo

Array = NDArray[np.float64]

_LEAST_DAMPING_HZ = 1.0e-9


def mean_commands(times_s: Array, commands: Array, edges_s: Array) -> Array:
    """Means over steps of a zero-order-hold command.

    Before the first sample the command has the first value. The means depend continuously on the edges, and so
    on a delay that is not a multiple of the sampling time.

    Args:
        times_s: Times of the samples, shape (times,).
        commands: Their values, shape (times,).
        edges_s: Edges of the steps, rising, shape (steps + 1,).

    Returns:
        Shape (steps,).
    """
    sums = np.concatenate(([0.0], np.cumsum(commands[:-1] * np.diff(times_s))))
    found = np.interp(edges_s, times_s, sums)
    found = np.where(edges_s < times_s[0], (edges_s - times_s[0]) * commands[0], found)
    found = np.where(edges_s > times_s[-1], sums[-1] + (edges_s - times_s[-1]) * commands[-1], found)
    means: Array = np.diff(found) / np.diff(edges_s)
    return means


class VelocityLoop:
    """One step of several servos, with precomputed coefficients."""

    def __init__(self, servos: Sequence[JointServo], step_s: float | Array) -> None:
        """Compute the coefficients.

        Args:
            servos: The servos; their delays are not applied here.
            step_s: Length of a step, one for all or of shape (servos,).
        """
        self._kp = np.array([each.position_gain_hz2 for each in servos])
        self._kv = np.array([each.velocity_gain_hz for each in servos])
        damping = np.maximum(self._kv + [each.viscous_hz for each in servos], _LEAST_DAMPING_HZ)
        self._decay = np.exp(-damping * step_s)
        self._gain = -np.expm1(-damping * step_s) / damping
        self._coulomb = self._gain * [each.coulomb_rad_s2 for each in servos]
        self._half_s = step_s / 2

    def after(self, q: Array, v: Array, target_rad: Array, target_rad_s: Array) -> tuple[Array, Array]:
        """Positions and speeds after the step, each of shape (servos,)."""
        middle = q + self._half_s * v
        free = self._decay * v + self._gain * (self._kp * (target_rad - middle) + self._kv * target_rad_s)
        after = np.sign(free) * np.maximum(np.abs(free) - self._coulomb, 0.0)
        return middle + self._half_s * after, after
