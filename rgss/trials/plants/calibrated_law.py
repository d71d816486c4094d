"""Control law of calibrated servos: gains, friction and delayed commands."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from rgss.physics import VelocityLoop
from rgss.scenes import JointServo, ServoControl

Array = NDArray[np.float64]

_STABLE = 1.0 + 1.0e-9


class CalibratedLaw:
    """Joint accelerations of calibrated servos over a step, including friction.

    Under position control the servos are commanded the target and its speed. Under velocity control they are commanded
    v_c = v_target + k (q_target - q), clipped to the speeds of the joints, and k acts on the delayed command too. A
    command arrives after the servo's delay, which need not be a multiple of the step: its speed is constant over a
    step, its position linear, as in `rgss.identification`.
    """

    def __init__(
        self,
        servos: Sequence[JointServo],
        fastest_rad_s: Array,
        *,
        control: ServoControl,
        position_gain_1_s: Array,
        step_s: float,
    ) -> None:
        """Start at rest.

        Args:
            servos: The servo of each joint.
            fastest_rad_s: Speed limit of each joint's command, shape (joints,).
            control: The command interface of the fit.
            position_gain_1_s: k of each joint, under velocity control; shape (joints,).
            step_s: Time between two commands.
        """
        self._fastest = fastest_rad_s
        self._by_speed = control is ServoControl.VELOCITY
        self._position_gain = position_gain_1_s
        self._step_s = step_s
        under = [replace(servo, position_gain_hz2=0.0) for servo in servos] if self._by_speed else servos
        self._loop = VelocityLoop(under, step_s)
        delays = np.array([servo.delay_s for servo in servos]) / step_s
        self._late = _DelayedCommands(delays, step_s)

    def __call__(self, target: Array, speed: Array, acceleration: Array, q: Array, dq: Array) -> Array:
        """Acceleration over the coming step, each of shape (joints,).

        Args:
            target: Present target positions.
            speed: Target speeds of the previous step.
            acceleration: Change of the target speeds to the coming step, divided by its length.
            q: Present positions.
            dq: Present speeds.
        """
        command = speed + self._step_s * acceleration
        if self._by_speed:
            command = np.clip(command + self._position_gain * (target - q), -self._fastest, self._fastest)
        position, velocity = self._late.after(target, command)
        _, reached = self._loop.after(q, dq, position, velocity)
        wanted: Array = (reached - dq) / self._step_s
        return wanted


class _DelayedCommands:
    """Delay line of commands, with the delay of each joint."""

    def __init__(self, delays: Array, step_s: float) -> None:
        """Start without commands.

        Args:
            delays: Delays in steps, shape (joints,).
            step_s: Length of a step.
        """
        self._step_s = step_s
        whole = np.floor(delays)
        self._whole, self._part = whole.astype(int), delays - whole
        self._behind = delays - 0.5
        steps = np.maximum(np.ceil(self._behind), 0.0)
        self._steps, self._ahead = steps.astype(int), np.where(self._behind > 0.0, steps - self._behind, 0.0)
        self._kept = int(max(self._whole.max(), self._steps.max())) + 2
        self._positions: list[Array] = []
        self._speeds: list[Array] = []
        self._joints = np.arange(len(delays))

    def after(self, target: Array, speed: Array) -> tuple[Array, Array]:
        """Delayed position at the middle of the coming step, and delayed mean speed over it.

        Args:
            target: Present commanded positions, shape (joints,).
            speed: Commanded speeds from now on, shape (joints,).
        """
        if not self._positions:
            self._positions, self._speeds = [target] * self._kept, [np.zeros_like(speed)] * self._kept
        self._positions = [np.array(target), *self._positions[: self._kept - 1]]
        self._speeds = [np.array(speed), *self._speeds[: self._kept - 1]]
        positions, speeds, joint = np.array(self._positions), np.array(self._speeds), self._joints
        velocity = (1.0 - self._part) * speeds[self._whole, joint] + self._part * speeds[self._whole + 1, joint]
        older, newer = positions[self._steps, joint], positions[np.maximum(self._steps - 1, 0), joint]
        coming = target - self._behind * self._step_s * speed
        position = np.where(self._behind > 0.0, older + self._ahead * (newer - older), coming)
        return position, velocity


def is_stable(servo: JointServo, *, control: ServoControl, position_gain_1_s: float, step_s: float) -> bool:
    """True if the closed loop of a joint is stable, without Coulomb friction and limits.

    By the spectral radius of the transition over a step, whose states are position, speed and the delayed commands.

    Args:
        servo: The servo.
        control: The command interface of the fit.
        position_gain_1_s: Gain of the position error under velocity control.
        step_s: Length of a step.
    """
    by_speed = control is ServoControl.VELOCITY
    stiffness = 0.0 if by_speed else servo.position_gain_hz2
    gain_1_s = position_gain_1_s if by_speed else 0.0
    loop = VelocityLoop([replace(servo, position_gain_hz2=stiffness, coulomb_rad_s2=0.0)], step_s)
    whole = math.floor(servo.delay_s / step_s)
    part = servo.delay_s / step_s - whole
    images = []
    for q, v, *under_way in np.eye(3 + whole):
        commands = [-gain_1_s * q, *under_way]
        arriving = (1.0 - part) * commands[whole] + part * commands[whole + 1]
        position, speed = loop.after(np.array([q]), np.array([v]), np.zeros(1), np.array([arriving]))
        images.append([position[0], speed[0], *commands[:-1]])
    return bool(np.abs(np.linalg.eigvals(np.array(images).T)).max() <= _STABLE)
