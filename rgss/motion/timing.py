"""Time-optimal timing of a path within joint and tool limits."""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import Enum

import numpy as np
from numpy.typing import NDArray

from rgss.motion.blending import BlendedPath, SmoothPath, blend
from rgss.motion.derivatives import PathDerivatives, path_derivatives
from rgss.motion.limits import MotionLimits, require_joints
from rgss.motion.parametrization import RateConstraints, fastest_rates
from rgss.motion.paths import JointPath
from rgss.motion.runs import Run, joined, run_grid
from rgss.motion.trajectory import Trajectory
from rgss.motion.validity import StateValidity, ToolKinematics

Vector = NDArray[np.float64]

_POINTS_OF_CELL = 4
_REFINEMENTS = 2
_TOLERATED_EXCESS = 1.02
# Half-planes of the polygon inscribed in the circle of the tool's tangential and normal acceleration.
_POLYGON_ANGLES = np.linspace(0.0, math.pi, 9)
_POLYGON_INRADIUS = math.cos(math.pi / 16)


class TimingOutcome(str, Enum):
    """Outcome of the timing of a path."""

    TIMED = "timed"
    IN_COLLISION = "in_collision"
    INFEASIBLE = "infeasible"


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class TimedMove:
    """Result of the timing of one move.

    Attributes:
        outcome: The outcome.
        trajectory: The motion; None unless it could be timed.
        blended: Number of blended corners.
        stops: Number of corners at which the motion comes to rest.
    """

    outcome: TimingOutcome
    trajectory: Trajectory | None
    blended: int
    stops: int


def time_move(
    path: JointPath,
    validity: StateValidity,
    tool: ToolKinematics,
    limits: MotionLimits,
    *,
    resolution_rad: float,
    largest_deviation_rad: float = 0.1,
) -> TimedMove:
    """Blend the corners of a path, check the blended path and time it.

    Args:
        path: A valid polyline.
        validity: State-validity checker.
        tool: Kinematics of the tool centre.
        limits: Limits of the motion.
        resolution_rad: Greatest distance in joint space between two checked states.
        largest_deviation_rad: Greatest distance of a blend from its corner.
    """
    blended = blend(path, validity, resolution_rad=resolution_rad, largest_deviation_rad=largest_deviation_rad)
    return time_blended(blended, tool, limits)


def time_blended(blended: BlendedPath, tool: ToolKinematics, limits: MotionLimits) -> TimedMove:
    """Time a blended path; the same blended path can be timed under any limits."""
    trajectory = None
    outcome = TimingOutcome.IN_COLLISION
    if blended.is_valid:
        trajectory = fastest_trajectory(blended.path, tool, limits)
        outcome = TimingOutcome.INFEASIBLE if trajectory is None else TimingOutcome.TIMED
    return TimedMove(outcome=outcome, trajectory=trajectory, blended=blended.blended, stops=blended.stops)


def fastest_trajectory(path: SmoothPath, tool: ToolKinematics, limits: MotionLimits) -> Trajectory | None:
    """Time a smooth path from rest to rest, with a rest at each of its stops.

    The limits are constraints of the optimisation at the ends of each grid cell. Between them they are
    verified: if one is exceeded by more than 2 % the grid is refined, and the remaining excess is removed by slowing
    the motion uniformly, so that the limits hold at every verified point.

    Returns:
        The motion; None if the optimisation finds none.

    Raises:
        MotionError: The limits are not for the joints of the path.
    """
    require_joints(limits, path.coefficients.shape[2])
    runs = []
    for first, last in zip(path.stops, path.stops[1:], strict=False):
        if path.breaks[last] > path.breaks[first]:
            run = _timed_run(path, first, last, tool, limits)
            if run is None:
                return None
            runs.append(run)
    return joined(path, runs)


def _timed_run(path: SmoothPath, first: int, last: int, tool: ToolKinematics, limits: MotionLimits) -> Run | None:
    for refinement in range(_REFINEMENTS + 1):
        grid = run_grid(path, first, last, 2**refinement)
        fine = np.append(
            (grid[:-1, None] + np.diff(grid)[:, None] * np.arange(_POINTS_OF_CELL) / _POINTS_OF_CELL).ravel(), grid[-1]
        )
        derivatives = path_derivatives(path, fine, tool)
        at_grid = derivatives.every(_POINTS_OF_CELL)
        rates = fastest_rates(grid, _largest_squares(at_grid, limits), _constraints(at_grid, limits))
        if rates is None:
            continue
        excess, speed, acceleration = _verify(grid, rates, derivatives, limits)
        if excess <= _TOLERATED_EXCESS or refinement == _REFINEMENTS:
            slowdown = max(excess, 1.0)
            return Run(
                parameters=grid,
                rates=rates / slowdown,
                tool_speed_m_s=speed / slowdown,
                tool_acceleration_m_s2=acceleration / slowdown**2,
            )
    return None


def _largest_squares(at: PathDerivatives, limits: MotionLimits) -> Vector:
    """Greatest (ds/dt)² within the speed limits of joints and tool."""
    joints = np.max(np.abs(at.first) / np.array(limits.speed_rad_s), axis=1)
    tool = np.linalg.norm(at.tool_first, axis=1) / limits.tool_speed_m_s
    squares: Vector = np.maximum(joints, tool) ** -2
    return squares


def _constraints(at: PathDerivatives, limits: MotionLimits) -> list[RateConstraints]:
    joints = len(limits.acceleration_rad_s2)
    identity = np.eye(joints)
    result = [
        RateConstraints(
            first=at.first,
            second=at.second,
            rows=np.vstack([identity, -identity]),
            bounds=np.tile(limits.acceleration_rad_s2, 2),
        )
    ]
    if math.isfinite(limits.tool_acceleration_m_s2):
        tangential, normal = _along_and_across(at)
        speed = np.linalg.norm(at.tool_first, axis=1)
        result.append(
            RateConstraints(
                first=np.column_stack([speed, np.zeros(len(speed))]),
                second=np.column_stack([tangential, normal]),
                rows=np.column_stack([np.cos(_POLYGON_ANGLES), np.sin(_POLYGON_ANGLES)]),
                bounds=np.full(len(_POLYGON_ANGLES), limits.tool_acceleration_m_s2 * _POLYGON_INRADIUS),
            )
        )
    return result


def _along_and_across(at: PathDerivatives) -> tuple[Vector, Vector]:
    """The tool's second derivative along its direction, and its magnitude across it."""
    speed = np.linalg.norm(at.tool_first, axis=1)
    direction = at.tool_first / np.where(speed > 0.0, speed, 1.0)[:, None]
    along = np.sum(at.tool_second * direction, axis=1)
    across = np.linalg.norm(at.tool_second - along[:, None] * direction, axis=1)
    return along, across


def _verify(grid: Vector, rates: Vector, fine: PathDerivatives, limits: MotionLimits) -> tuple[float, float, float]:
    """Factor by which the motion must slow down, and the peak speed and acceleration of the tool."""
    squares = rates**2
    accelerations = np.diff(squares) / (2 * np.diff(grid))
    # Both ends of a cell belong to it, as the acceleration jumps from cell to cell.
    index = np.arange(len(accelerations))[:, None] * _POINTS_OF_CELL + np.arange(_POINTS_OF_CELL + 1)
    fractions = np.arange(_POINTS_OF_CELL + 1) / _POINTS_OF_CELL
    x = (squares[:-1, None] + np.diff(squares)[:, None] * fractions).ravel()
    u = np.repeat(accelerations, _POINTS_OF_CELL + 1)
    cells = index.ravel()
    rate = np.sqrt(np.maximum(x, 0.0))
    joint_speed = np.abs(fine.first[cells]) * rate[:, None] / np.array(limits.speed_rad_s)
    joint_acceleration = np.abs(fine.first[cells] * u[:, None] + fine.second[cells] * x[:, None])
    tool_speed = float(np.max(np.linalg.norm(fine.tool_first[cells], axis=1) * rate))
    tool_acceleration = float(
        np.max(np.linalg.norm(fine.tool_first[cells] * u[:, None] + fine.tool_second[cells] * x[:, None], axis=1))
    )
    excess = max(
        float(np.max(joint_speed)),
        math.sqrt(float(np.max(joint_acceleration / np.array(limits.acceleration_rad_s2)))),
        tool_speed / limits.tool_speed_m_s,
        math.sqrt(tool_acceleration / limits.tool_acceleration_m_s2),
    )
    return excess, tool_speed, tool_acceleration
