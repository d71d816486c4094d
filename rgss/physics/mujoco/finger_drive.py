"""Motors of sliding fingers in MuJoCo: a velocity with a limited force."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from rgss.scenes import Gripper

# A finger's motor gives all its force once the finger lags by this share of its speed.
SATURATING_SHARE = 0.5

# Of the speed by which a finger lags, what one step of the effort removes.
_REMOVED_SHARE = 0.5


def is_servo_stable(gripper: Gripper, step_s: float) -> bool:
    """True if a velocity servo moves a finger without jumping over its speed in a step.

    The servo's gain is the force over half of the speed; in a step dt it changes the speed of a mass M by at most
    F dt/M, which must not exceed the band on both sides of the target: F dt/(2 M v) below 0.5.

    Args:
        gripper: A gripper with sliding fingers.
        step_s: Length of a step.
    """
    mass_kg = gripper.finger_mass_kg + gripper.drive.inertia_kg
    return gripper.finger_force_n * step_s / (2.0 * mass_kg * gripper.finger_velocity_m_s) < SATURATING_SHARE


class MujocoFingerDrive:
    """Motors of the fingers: velocity servos of the engine, or efforts where these would be unstable.

    An effort changes in each step by what removes half of the lag in speed, less what the last change did, as a
    discrete integral controller with the acceleration fed back: a free finger approaches its speed without overshoot,
    and one that is held presses with its force after some steps.
    """

    def __init__(self, model: Any, data: Any, gripper: Gripper, names: Sequence[str], *, step_s: float) -> None:
        """Look up the motors.

        Args:
            model: The engine's model.
            data: Its state.
            gripper: The gripper.
            names: Names of the fingers' joints and motors; none of a suction cup or a linkage.
            step_s: Length of a step.
        """
        self._model, self._data = model, data
        self._motors = np.array([model.actuator(name).id for name in names], dtype=int)
        self._speeds = np.array([model.joint(name).dofadr[0] for name in names], dtype=int)
        self._is_servo = not names or is_servo_stable(gripper, step_s)
        self._gain = (gripper.finger_mass_kg + gripper.drive.inertia_kg) / step_s
        self._command = (0.0, 0.0)
        self._effort = self._speed_before = np.zeros(len(names))

    def reset(self) -> None:
        """Be at rest without effort."""
        self._effort = self._speed_before = np.zeros(len(self._motors))

    def drive(self, velocity_m_s: float, force_n: float) -> None:
        """Move every finger at a velocity (positive closes) with at most a force, from now on."""
        self._command = velocity_m_s, force_n
        self._model.actuator_forcerange[self._motors] = (-force_n, force_n)
        if self._is_servo:
            self._data.ctrl[self._motors] = velocity_m_s

    def before_step(self) -> None:
        """Set the efforts of a step, after the engine has computed its state."""
        if self._is_servo:
            return
        velocity_m_s, force_n = self._command
        speed = self._data.qvel[self._speeds].copy()
        change = _REMOVED_SHARE * (velocity_m_s - speed) - (speed - self._speed_before)
        self._effort = np.clip(self._effort + self._gain * change, -force_n, force_n)
        self._speed_before = speed
        self._data.ctrl[self._motors] = self._effort
