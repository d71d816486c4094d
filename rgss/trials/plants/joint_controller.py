"""Joint control: modes, gains and commanded acceleration."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from enum import Enum
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rgss.errors import DefinitionError
from rgss.scenes import Calibration, Joint
from rgss.tasks import StepControl
from rgss.trials.plants.calibrated_law import CalibratedLaw
from rgss.trials.plants.tool_tracking_law import ToolFrames, ToolTrackingLaw

Array = NDArray[np.float64]


class ControlMode(str, Enum):
    """Mode of joint control."""

    POSITION = "position"
    VELOCITY = "velocity"
    COMPUTED_TORQUE = "computed_torque"
    CALIBRATED = "calibrated"
    TOOL_TRACKING = "tool_tracking"


@dataclass(frozen=True, slots=True, kw_only=True)
class JointGains:
    """Gains of one joint; None for the common gains.

    Attributes:
        joint: Its name.
        natural_frequency_rad_s: ω.
        damping_ratio: ζ.
        position_gain_1_s: k.
        velocity_gain_1_s: g.
    """

    joint: str
    natural_frequency_rad_s: float | None = None
    damping_ratio: float | None = None
    position_gain_1_s: float | None = None
    velocity_gain_1_s: float | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class JointController:
    """Controller of the joints.

    With the target q_d and the error e = q_d - q, the commanded acceleration is

        computed torque:  q̈_d + 2 ζ ω ė + ω² e
        position:               2 ζ ω ė + ω² e
        velocity:         g (q̇_c - q̇)  with the commanded velocity  q̇_c = q̇_d + k e

        tool tracking:    g (q̇_c - q̇)  with the q̇_c that gives the tool the target's velocity plus k times its error
        calibrated:       that of the servos of the robot's calibration, with their delay and friction

    and inverse dynamics turns it into torques. ω² and 2 ζ ω are the gains k_p and k_d of a servo. The commanded
    velocity is clipped to the speeds of the joints. Sources: J. J. Craig, "Introduction to Robotics", 3rd ed., 2005,
    section 10.4 (computed torque, ζ = 1 for critical damping).

    Attributes:
        mode: The mode.
        natural_frequency_rad_s: ω.
        damping_ratio: ζ.
        position_gain_1_s: k, of the velocity mode, of tool tracking, and of a calibration under velocity control.
        velocity_gain_1_s: g, of the velocity mode and of tool tracking.
        joints: Gains of single joints, which override the common ones.
        reached_rad: Greatest joint error at which the end of a move counts as reached.
        settling_limit_s: Timeout of settling after a move.
        in_contact: True if contact physics drives the joints along their motion under this control, False if along
        their targets.
        calibration: The robot's servos, in the calibrated mode.
    """

    mode: ControlMode = ControlMode.COMPUTED_TORQUE
    natural_frequency_rad_s: float = 40.0
    damping_ratio: float = 1.0
    position_gain_1_s: float = 20.0
    velocity_gain_1_s: float = 80.0
    joints: tuple[JointGains, ...] = ()
    reached_rad: float = 1.0e-3
    settling_limit_s: float = 0.5
    in_contact: bool = False
    calibration: Calibration | None = None

    @property
    def origin(self) -> str:
        """Mode and provenance of the calibration, as a phrase."""
        mode = self.mode.value.replace("_", " ")
        return mode if self.calibration is None else f"{mode} on {self.calibration.origin}"


def stated_in_step(controller: JointController, stated: StepControl) -> JointController:
    """Controller of a step, with the settings that it states; stated gains apply to all joints."""
    gains: dict[str, Any] = {
        name: value
        for name in ("natural_frequency_rad_s", "damping_ratio", "position_gain_1_s", "velocity_gain_1_s")
        if (value := getattr(stated, name)) is not None
    }
    cleared: dict[str, Any] = dict.fromkeys(gains)
    own = tuple(replace(one, **cleared) for one in controller.joints)
    mode = controller.mode if stated.mode is None else ControlMode(stated.mode)
    return replace(controller, mode=mode, joints=own, **gains)


ControlLaw = Callable[[Array, Array, Array, Array, Array], Array]
"""Commanded acceleration from target position, velocity, acceleration, and present position and velocity."""


def control_law(
    controller: JointController, joints: Sequence[Joint], *, step_s: float, tool: ToolFrames | None = None
) -> ControlLaw:
    """Control law of a controller for the joints of an arm.

    Args:
        controller: Mode and gains.
        joints: The arm's joints, in order.
        step_s: Time between two commands.
        tool: Kinematics of the tool, which tool tracking needs.

    Raises:
        DefinitionError: A joint has no servo in the calibrated mode, or tool tracking has no kinematics.
    """
    names = [joint.name for joint in joints]
    if controller.mode is ControlMode.TOOL_TRACKING:
        if tool is None:
            raise DefinitionError("tool tracking needs the kinematics of the tool, got none")
        return ToolTrackingLaw(
            tool,
            joints,
            position_gain_1_s=_gains(controller, names, "position_gain_1_s"),
            velocity_gain_1_s=_gains(controller, names, "velocity_gain_1_s"),
            step_s=step_s,
        )
    if controller.mode is ControlMode.CALIBRATED:
        return _calibrated_law(controller, joints, step_s)
    if controller.mode is ControlMode.VELOCITY:
        return _velocity_law(
            _gains(controller, names, "velocity_gain_1_s"),
            _gains(controller, names, "position_gain_1_s"),
            np.array([joint.speed_rad_s for joint in joints]),
        )
    stiffness, damping = servo_gains(controller, names)
    feeds_forward = controller.mode is ControlMode.COMPUTED_TORQUE

    def servo(target: Array, speed: Array, acceleration: Array, q: Array, dq: Array) -> Array:
        ahead = acceleration if feeds_forward else np.zeros_like(acceleration)
        wanted: Array = ahead + damping * (speed - dq) + stiffness * (target - q)
        return wanted

    return servo


def servo_gains(controller: JointController, joints: Sequence[str]) -> tuple[Array, Array]:
    """Gains k_p in 1/s² and k_d in 1/s of the error's equation ë + k_d ė + k_p e = …, of each joint."""
    if controller.mode in (ControlMode.VELOCITY, ControlMode.TOOL_TRACKING):
        gain = _gains(controller, joints, "velocity_gain_1_s")
        return gain * _gains(controller, joints, "position_gain_1_s"), gain
    omega, zeta = (_gains(controller, joints, name) for name in ("natural_frequency_rad_s", "damping_ratio"))
    return omega**2, 2 * zeta * omega


def least_stable_rate_hz(controller: JointController, joints: Sequence[str]) -> float:
    """Least rate in Hz at which the error decays, with the command held over a step.

    With k_p and k_d of `servo_gains`, a step h gives z² - (2 - k_d h - k_p h²) z + 1 - k_d h, as the speed of a step is
    added to the position; its roots are within the unit circle if 2 k_d h + k_p h² < 4 (Jury's criterion).
    """
    stiffness, damping = servo_gains(controller, joints)
    return float(np.max((damping + np.sqrt(damping**2 + 4.0 * stiffness)) / 4.0))


def _calibrated_law(controller: JointController, joints: Sequence[Joint], step_s: float) -> ControlLaw:
    calibration, names = controller.calibration, [joint.name for joint in joints]
    if calibration is None or not {*names} <= {name for name, _ in calibration.servos}:
        raise DefinitionError(
            "the calibrated mode needs a servo of every joint",
            hint="name a calibration with all joints in the robot's file, or use another control.mode",
        )
    servos = dict(calibration.servos)
    return CalibratedLaw(
        [servos[name] for name in names],
        np.array([joint.speed_rad_s for joint in joints]),
        control=calibration.control,
        position_gain_1_s=_gains(controller, names, "position_gain_1_s"),
        step_s=step_s,
    )


def _velocity_law(gain: Array, position_gain: Array, fastest: Array) -> ControlLaw:
    def velocity(target: Array, speed: Array, _acceleration: Array, q: Array, dq: Array) -> Array:
        commanded = np.clip(speed + position_gain * (target - q), -fastest, fastest)
        wanted: Array = gain * (commanded - dq)
        return wanted

    return velocity


def _gains(controller: JointController, joints: Sequence[str], name: str) -> Array:
    own = {gains.joint: getattr(gains, name) for gains in controller.joints}
    common = getattr(controller, name)
    return np.array([common if (value := own.get(joint)) is None else value for joint in joints], dtype=float)
