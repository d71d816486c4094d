"""Trapezoidal velocity profiles along a path: constant acceleration, constant speed, constant deceleration.

All joints of a run share one profile of the path's parameter s, so they start and stop together. The profile is in
closed form. With the length L, the peak rate v and the acceleration a of a run,

    T = L/v + v/a  where L ≥ v²/a,  else  T = 2 √(L/a)  with the peak rate √(L a), a triangle

(B. Siciliano et al., "Robotics: Modelling, Planning and Control", 2009, section 4.2.1).
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from rgss.motion.blending import BlendedPath, SmoothPath, blend, unblended
from rgss.motion.derivatives import path_derivatives
from rgss.motion.limits import MotionLimits, require_joints
from rgss.motion.paths import JointPath
from rgss.motion.runs import Run, joined, run_grid
from rgss.motion.timing import TimedMove, TimingOutcome
from rgss.motion.trajectory import Trajectory
from rgss.motion.validity import StateValidity, ToolKinematics

Vector = NDArray[np.float64]

_REFINEMENT = 4
_ROUNDING = 1e-12


def time_move_by_trapezoids(
    path: JointPath,
    validity: StateValidity,
    tool: ToolKinematics,
    limits: MotionLimits,
    *,
    resolution_rad: float,
    is_curve: bool = False,
) -> TimedMove:
    """Check a path and time it by trapezoidal profiles, from rest to rest between its waypoints.

    Args:
        path: A valid polyline.
        validity: State-validity checker.
        tool: Kinematics of the tool centre.
        limits: Limits of the motion.
        resolution_rad: Greatest distance in joint space between two checked states.
        is_curve: True if the points sample a curve, such as a straight line of the tool: its corners are then blended,
            and only its ends and the corners that cannot be blended are waypoints.
    """
    prepare = blend if is_curve else unblended
    prepared: BlendedPath = prepare(path, validity, resolution_rad=resolution_rad)
    if not prepared.is_valid:
        return TimedMove(
            outcome=TimingOutcome.IN_COLLISION, trajectory=None, blended=prepared.blended, stops=prepared.stops
        )
    return TimedMove(
        outcome=TimingOutcome.TIMED,
        trajectory=trapezoidal_trajectory(prepared.path, tool, limits),
        blended=prepared.blended,
        stops=prepared.stops,
    )


def trapezoidal_trajectory(path: SmoothPath, tool: ToolKinematics, limits: MotionLimits) -> Trajectory:
    """Time a smooth path by one trapezoidal profile for each run between two of its stops.

    On a straight run in joint space the profile has the greatest speed and acceleration that the joints and the tool's
    speed allow. If the acceleration of the tool, or of the joints on a curve, would exceed its limit, the run is slowed
    uniformly, which keeps the profile a trapezoid.

    Raises:
        MotionError: The limits are not for the joints of the path.
    """
    require_joints(limits, path.coefficients.shape[2])
    runs = [
        _run(path, first, last, tool, limits)
        for first, last in zip(path.stops, path.stops[1:], strict=False)
        if path.breaks[last] > path.breaks[first]
    ]
    return joined(path, runs)


def _run(path: SmoothPath, first: int, last: int, tool: ToolKinematics, limits: MotionLimits) -> Run:
    start, end = float(path.breaks[first]), float(path.breaks[last])
    grid = run_grid(path, first, last, _REFINEMENT)
    # Exactly at a stop the path evaluates to the direction of the next run.
    grid[-1] = np.nextafter(end, start)
    at = path_derivatives(path, grid, tool)
    steepest, tool_steepest_m = (
        sampled_peaks(np.abs(at.first)),
        float(sampled_peaks(np.linalg.norm(at.tool_first, axis=1))),
    )
    joint_share = float(np.max(steepest / np.array(limits.speed_rad_s)))
    acceleration = 1.0 / float(np.max(steepest / np.array(limits.acceleration_rad_s2)))
    rate = min(1.0 / max(joint_share, tool_steepest_m / limits.tool_speed_m_s), math.sqrt((end - start) * acceleration))
    ramp = min(rate**2 / (2.0 * acceleration), (end - start) / 2.0)
    knots = np.array([start, start + ramp, end - ramp, end])
    rates = np.array([0.0, rate, rate, 0.0])
    if not knots[1] < knots[2]:
        knots, rates = knots[[0, 1, 3]], rates[[0, 1, 3]]
    excess, tool_acceleration = 0.0, 0.0
    for piece in range(len(knots) - 1):
        shares, of_tool = _accelerations(path, grid, knots[piece : piece + 2], rates[piece : piece + 2], tool, limits)
        excess, tool_acceleration = max(excess, shares), max(tool_acceleration, of_tool)
    excess = max(excess, tool_acceleration / limits.tool_acceleration_m_s2)
    slowdown = math.sqrt(excess) if excess > 1.0 + _ROUNDING else 1.0
    return Run(
        parameters=knots,
        rates=rates / slowdown,
        tool_speed_m_s=tool_steepest_m * rate / slowdown,
        tool_acceleration_m_s2=tool_acceleration / slowdown**2,
    )


def _accelerations(
    path: SmoothPath, grid: Vector, ends: Vector, rates: Vector, tool: ToolKinematics, limits: MotionLimits
) -> tuple[float, float]:
    """Greatest use of a joint acceleration limit over a piece of a profile (1 = limit), and of the tool in m/s²."""
    s = np.concatenate([ends[:1], grid[(grid > ends[0]) & (grid < ends[1])], [min(ends[1], grid[-1])]])
    at = path_derivatives(path, s, tool)
    # Under constant acceleration the square of the rate is linear in the parameter.
    squares = np.interp(s, ends, rates**2)[:, None]
    acceleration = float((rates[1] ** 2 - rates[0] ** 2) / (2.0 * (ends[1] - ends[0])))
    joints = np.abs(at.first * acceleration + at.second * squares)
    of_tool = np.linalg.norm(at.tool_first * acceleration + at.tool_second * squares, axis=1)
    return float(np.max(sampled_peaks(joints) / np.array(limits.acceleration_rad_s2))), float(sampled_peaks(of_tool))


def sampled_peaks(samples: Vector) -> Vector:
    """Upper estimate of a smooth function's maximum from its samples along the first axis.

    A parabola through three samples has its vertex at most an eighth of their second difference above the middle one.
    """
    bends = np.zeros_like(samples)
    bends[1:-1] = np.abs(np.diff(samples, n=2, axis=0)) / 8.0
    bends[[0, -1]] = bends[[1, -2]]
    peaks: Vector = np.max(samples + bends, axis=0)
    return peaks
