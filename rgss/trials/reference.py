"""Reference of a move: targets of every physics step."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class SampledTrajectory(Protocol):
    """Interface of a joint trajectory."""

    @property
    def duration_s(self) -> float:
        """Duration of the trajectory in s."""

    def positions(self, times_s: Array) -> Array:
        """Joint positions (k, n) at times (k,)."""


class ToolPositions(Protocol):
    """Forward kinematics of the tool position."""

    def tool_position(self, configurations_rad: Array) -> Array:
        """Positions (k, 3) of the grasp centre in the world for configurations (k, n)."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Reference:
    """Targets for each step of a move, and the tool's motion along it.

    Attributes:
        positions_rad: Joint positions (k + 1, n), the first at the start.
        velocities_rad_s: Mean joint velocities (k, n) over each step.
        tool_m: Tool positions (n + 1, 3) in the world.
        load_m_s2: Magnitude (n,) of tool acceleration minus gravity over each step: the load of a grasp for each
        kilogram.
        arc_m: Displacement (n, 3) of the tool over each step minus that along its tangent at the start.
        peak_tool_speed_m_s: Greatest tool speed.
        peak_tool_acceleration_m_s2: Greatest tool acceleration.
    """

    positions_rad: Array
    velocities_rad_s: Array
    tool_m: Array
    load_m_s2: Array
    arc_m: Array
    peak_tool_speed_m_s: float
    peak_tool_acceleration_m_s2: float

    @property
    def steps(self) -> int:
        """Number of physics steps."""
        return len(self.velocities_rad_s)


def reference_of(
    trajectory: SampledTrajectory, tool: ToolPositions, *, step_s: float, gravity_m_s2: float
) -> Reference:
    """Sample a trajectory at the physics rate.

    Args:
        trajectory: The timed move.
        tool: Kinematics of the tool.
        step_s: Length of a physics step.
        gravity_m_s2: Magnitude of gravity.
    """
    steps = max(1, math.ceil(trajectory.duration_s / step_s - 1e-9))
    times = np.minimum(np.arange(steps + 1) * step_s, trajectory.duration_s)
    return reference_along(trajectory.positions(times), tool, step_s=step_s, gravity_m_s2=gravity_m_s2)


def reference_along(positions: Array, tool: ToolPositions, *, step_s: float, gravity_m_s2: float) -> Reference:
    """Targets of a move from its joint positions at each step.

    Args:
        positions: Joint positions (k + 1, n), the first at the start.
        tool: Kinematics of the tool.
        step_s: Length of a physics step.
        gravity_m_s2: Magnitude of gravity.
    """
    velocities = np.diff(positions, axis=0) / step_s
    tool_m = np.asarray(tool.tool_position(positions))
    tool_velocity = np.diff(tool_m, axis=0) / step_s
    ends = np.zeros((1, 3))
    acceleration = np.diff(np.vstack([ends, tool_velocity, ends]), axis=0)[:-1] / step_s
    load = np.linalg.norm(acceleration + np.array([0.0, 0.0, gravity_m_s2]), axis=1)
    return Reference(
        positions_rad=positions,
        velocities_rad_s=velocities,
        tool_m=tool_m,
        load_m_s2=load,
        arc_m=_arcs(tool, positions, tool_m),
        peak_tool_speed_m_s=float(np.linalg.norm(tool_velocity, axis=1).max()),
        peak_tool_acceleration_m_s2=float(np.linalg.norm(acceleration, axis=1).max()),
    )


def _arcs(tool: ToolPositions, positions_rad: Array, tool_m: Array) -> Array:
    """Displacement of the tool over each step minus that along its tangent, with an error of third order.

    At constant joint velocities, half the second difference of the tool's position about the start of the step.
    """
    behind = np.asarray(tool.tool_position(2.0 * positions_rad[:-1] - positions_rad[1:]))
    arcs: Array = 0.5 * (tool_m[1:] - 2.0 * tool_m[:-1] + behind)
    return arcs
