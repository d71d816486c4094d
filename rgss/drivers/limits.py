"""Guard of every driver: a set point outside the limits is refused before it is sent."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from rgss.counted import counted
from rgss.errors import DefinitionError
from rgss.scenes import Joint, JointKind

_ROUNDING = 1.01
"""Limits of speed and acceleration are kept between the grid points of the timing within one per cent."""

_RANGE_ROUNDING_RAD = 1e-9


class ToolPositions(Protocol):
    """Forward kinematics of the tool position."""

    def tool_position(self, configurations_rad: NDArray[np.float64]) -> NDArray[np.float64]:
        """Positions in m, shape (n, 3), for configurations, shape (n, joints)."""


@dataclass(frozen=True, slots=True, kw_only=True)
class RobotLimits:
    """Limits of commands; those of a prismatic joint are in m, m/s and m/s².

    Attributes:
        names: Names of the joints from base to flange.
        lower_rad: Lower ends of their ranges.
        upper_rad: Upper ends.
        speed_rad_s: Greatest speeds.
        acceleration_rad_s2: Greatest accelerations.
        tool_speed_m_s: Greatest speed of the tool centre.
        start_tolerance_rad: Greatest distance of a revolute joint from the first set point.
        start_tolerance_m: Greatest distance of a prismatic joint from it.
        slides: Names of the prismatic joints.
    """

    names: tuple[str, ...]
    lower_rad: tuple[float, ...]
    upper_rad: tuple[float, ...]
    speed_rad_s: tuple[float, ...]
    acceleration_rad_s2: tuple[float, ...]
    tool_speed_m_s: float
    start_tolerance_rad: float = 0.01
    start_tolerance_m: float = 0.005
    slides: frozenset[str] = frozenset()

    def __post_init__(self) -> None:
        rows = (self.lower_rad, self.upper_rad, self.speed_rad_s, self.acceleration_rad_s2)
        if any(len(row) != len(self.names) for row in rows):
            raise DefinitionError(
                f"limits of {len(self.names)} joints must have {len(self.names)} values each",
                hint="give range, speed and acceleration of every joint",
            )
        tolerances = (self.start_tolerance_rad, self.start_tolerance_m)
        positive = (*self.speed_rad_s, *self.acceleration_rad_s2, self.tool_speed_m_s, *tolerances)
        if not all(value > 0.0 for value in positive):
            raise DefinitionError("limits of a driver must be positive", hint=f"the least is {min(positive):g}")

    def unit_of(self, name: str) -> str:
        """Unit of the positions of a joint."""
        return "m" if name in self.slides else "rad"

    def position_text(self, name: str, value: float, *, unit: bool = True) -> str:
        """Position of a joint in degrees or millimetres.

        Args:
            name: The joint.
            value: Its position in rad or m.
            unit: False to leave the unit out.
        """
        text, of = (f"{1e3 * value:.2f}", "mm") if name in self.slides else (f"{math.degrees(value):.2f}", "deg")
        return f"{text} {of}" if unit else text


def limits_of(joints: Sequence[Joint], *, tool_speed_m_s: float) -> RobotLimits:
    """Limits of a robot file's joints.

    Args:
        joints: The joints from base to flange.
        tool_speed_m_s: Greatest speed of the tool centre.
    """
    return RobotLimits(
        names=tuple(joint.name for joint in joints),
        lower_rad=tuple(joint.lower_rad for joint in joints),
        upper_rad=tuple(joint.upper_rad for joint in joints),
        speed_rad_s=tuple(joint.speed_rad_s for joint in joints),
        acceleration_rad_s2=tuple(joint.acceleration_rad_s2 for joint in joints),
        tool_speed_m_s=tool_speed_m_s,
        slides=frozenset(joint.name for joint in joints if joint.kind is JointKind.PRISMATIC),
    )


class Guard:
    """Comparison of each set point with the limits and with the two set points before it."""

    def __init__(self, limits: RobotLimits, tool: ToolPositions, *, period_s: float) -> None:
        """Prepare the guard; no command is accepted before `begin`.

        Args:
            limits: The limits.
            tool: Kinematics of the tool.
            period_s: Period of the set points.
        """
        self._limits = limits
        self._tool = tool
        self._period_s = period_s
        self._last: NDArray[np.float64] | None = None
        self._velocity: NDArray[np.float64] = np.zeros(len(limits.names))
        self._tool_m: NDArray[np.float64] = np.zeros(3)

    @property
    def limits(self) -> RobotLimits:
        """The limits."""
        return self._limits

    def begin(self, measured_rad: Sequence[float], start_rad: Sequence[float]) -> str:
        """Admit the start of a task at rest; the reason against it, or an empty text."""
        names = self._limits.names
        if len(measured_rad) != len(names):
            return f"the robot reports {counted(len(measured_rad), 'joint')}, the task moves {len(names)}"
        reason = self._against_range(start_rad)
        if reason:
            return reason
        for name, measured, start in zip(names, measured_rad, start_rad, strict=True):
            # A joint that reports no number is nowhere.
            limits = self._limits
            allowed = limits.start_tolerance_m if name in limits.slides else limits.start_tolerance_rad
            if not abs(measured - start) <= allowed:
                return (
                    f"joint {name} is at {limits.position_text(name, measured)}, the task begins at "
                    f"{limits.position_text(name, start)}: bring the robot there first"
                )
        self._last = np.array(start_rad, dtype=float)
        self._velocity = np.zeros(len(names))
        self._tool_m = np.asarray(self._tool.tool_position(self._last[None]))[0]
        return ""

    def check(self, positions_rad: Sequence[float]) -> str:
        """The reason against a set point, or an empty text. Nothing is remembered."""
        if self._last is None:
            return "no set point may be sent before the start of the task is admitted"
        reason = self._against_range(positions_rad)
        if reason:
            return reason
        position = np.array(positions_rad, dtype=float)
        velocity = (position - self._last) / self._period_s
        acceleration = (velocity - self._velocity) / self._period_s
        limits = self._limits
        for kind, per, values, bounds in (
            ("speed", "/s", velocity, limits.speed_rad_s),
            ("acceleration", "/s^2", acceleration, limits.acceleration_rad_s2),
        ):
            for name, value, bound in zip(limits.names, values.tolist(), bounds, strict=True):
                if abs(value) > bound * _ROUNDING:
                    unit = limits.unit_of(name) + per
                    return f"{kind} of joint {name} would be {abs(value):.4g} {unit}, its limit is {bound:.4g} {unit}"
        tool_m = np.asarray(self._tool.tool_position(position[None]))[0]
        tool_speed = float(np.linalg.norm(tool_m - self._tool_m)) / self._period_s
        if tool_speed > limits.tool_speed_m_s * _ROUNDING:
            return f"speed of the tool would be {tool_speed:.4g} m/s, its limit is {limits.tool_speed_m_s:.4g} m/s"
        return ""

    def admit(self, positions_rad: Sequence[float]) -> tuple[float, ...]:
        """Remember a set point that was checked and is sent; returns its velocities in rad/s."""
        position = np.array(positions_rad, dtype=float)
        if self._last is not None:
            self._velocity = (position - self._last) / self._period_s
        self._last = position
        self._tool_m = np.asarray(self._tool.tool_position(position[None]))[0]
        return tuple(self._velocity.tolist())

    def _against_range(self, positions_rad: Sequence[float]) -> str:
        limits = self._limits
        if len(positions_rad) != len(limits.names):
            return f"a set point has {len(positions_rad)} joints, the limits have {len(limits.names)}"
        for name, value, lower, upper in zip(
            limits.names, positions_rad, limits.lower_rad, limits.upper_rad, strict=True
        ):
            if not lower - _RANGE_ROUNDING_RAD <= value <= upper + _RANGE_ROUNDING_RAD:
                return (
                    f"joint {name} would be at {limits.position_text(name, value)}, outside "
                    f"{limits.position_text(name, lower, unit=False)} to {limits.position_text(name, upper)}"
                )
        return ""
