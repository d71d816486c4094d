"""Model of a joint's servo: position and velocity gain, pure delay, viscous and Coulomb friction.

With T the delay, q and v the joint's position and speed, and q_c, v_c the commands,

    dv/dt = k_p (q_c(t - T) - q) + k_v (v_c(t - T) - v) - b v - c sgn(v).

The servo's own model compensates weight and inertia, so gains and friction are those of a joint of unit inertia:
a friction torque is b or c times the inertia that the joint drives. Under velocity control k_p is zero.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rgss.errors import DefinitionError

Array = NDArray[np.float64]

_LEAST_DAMPING_HZ = 1.0e-9


@dataclass(frozen=True, slots=True, kw_only=True)
class JointServo:
    """Parameters of a joint's servo.

    Attributes:
        velocity_gain_hz: k_v in 1/s.
        position_gain_hz2: k_p in 1/s²; without effect under velocity control.
        delay_s: T.
        viscous_hz: b in 1/s: viscous friction per inertia.
        coulomb_rad_s2: c: Coulomb friction per inertia.
    """

    velocity_gain_hz: float
    position_gain_hz2: float = 0.0
    delay_s: float = 0.0
    viscous_hz: float = 0.0
    coulomb_rad_s2: float = 0.0

    def __post_init__(self) -> None:
        """Refuse a gain that is not positive and what is negative.

        Raises:
            DefinitionError: A parameter is out of range.
        """
        if self.velocity_gain_hz <= 0.0:
            raise DefinitionError(f"the velocity gain must be positive, got {self.velocity_gain_hz:g} 1/s")
        for name in ("position_gain_hz2", "delay_s", "viscous_hz", "coulomb_rad_s2"):
            if getattr(self, name) < 0.0:
                raise DefinitionError(f"{name} must not be negative, got {getattr(self, name):g}")


@dataclass(frozen=True, slots=True, kw_only=True)
class ServoMotion:
    """Motion of servos.

    Attributes:
        positions_rad: Positions at the sample times, shape (servos, times).
        velocities_rad_s: Speeds at the sample times, shape (servos, times).
    """

    positions_rad: Array
    velocities_rad_s: Array


def servo_motion(
    servos: Sequence[JointServo],
    times_s: Array,
    commanded_rad: Array,
    commanded_rad_s: Array,
    *,
    start: tuple[float, float] = (0.0, 0.0),
    longest_step_s: float = 1.0e-3,
) -> ServoMotion:
    """Motion of several servos under the same commands, from the same start.

    A commanded speed acts from its sample to the next one. Between steps the velocity loop is solved exactly,
    Coulomb friction stops a joint and holds it, and the position loop is taken at the middle of the step, so that the
    error is of second order in the step.

    Args:
        servos: The servos.
        times_s: Times of the samples, rising, shape (times,).
        commanded_rad: Commanded positions, shape (times,).
        commanded_rad_s: Commanded speeds, shape (times,).
        start: Position (rad) and speed (rad/s) at the first sample.
        longest_step_s: Bound of the step.
    """
    pieces = max(1, int(np.ceil(np.median(np.diff(times_s)) / longest_step_s - 1e-9)))
    steps = pieces * (len(times_s) - 1)
    step_s = float(times_s[-1] - times_s[0]) / steps
    edges = times_s[0] + step_s * np.arange(steps + 1)
    speeds = np.array([mean_commands(times_s, commanded_rad_s, edges - each.delay_s) for each in servos])
    middles = edges[:-1] + step_s / 2
    targets = np.array([np.interp(middles - each.delay_s, times_s, commanded_rad) for each in servos])
    loop = VelocityLoop(servos, step_s)
    q, v = np.full(len(servos), start[0]), np.full(len(servos), start[1])
    positions, velocities = np.empty((steps + 1, len(servos))), np.empty((steps + 1, len(servos)))
    positions[0], velocities[0] = q, v
    for index in range(steps):
        q, v = loop.after(q, v, targets[:, index], speeds[:, index])
        positions[index + 1], velocities[index + 1] = q, v
    return ServoMotion(
        positions_rad=np.array([np.interp(times_s, edges, each) for each in positions.T]),
        velocities_rad_s=np.array([np.interp(times_s, edges, each) for each in velocities.T]),
    )


def mean_commands(times_s: Array, commands: Array, edges_s: Array) -> Array:
    """Means over steps of a command that keeps each sample's value until the next one.

    Before the first sample the command has the first value. The means depend continuously on the edges, and so
    on a delay that is no multiple of the sampling time.

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
    """One step of several servos, with the coefficients of that step computed once."""

    def __init__(self, servos: Sequence[JointServo], step_s: float) -> None:
        """Compute the coefficients.

        Args:
            servos: The servos; their delays are not applied here.
            step_s: Length of a step.
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
