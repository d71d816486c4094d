"""Timing by joint waypoints: each joint moves from waypoint to waypoint by its own trapezoidal profile.

A joint that moves the distance d with the speed limit v and the acceleration limit a takes

    T = d/v + v/a  where d ≥ v²/a,  else  T = 2 √(d/a)

and waits at the waypoint for the slowest joint (B. Siciliano et al., "Robotics: Modelling, Planning and Control", 2009,
section 4.2.1). The joints then deviate from the straight line between two waypoints: the executed motion is checked,
and where it would collide all joints share one profile, which follows the planned straight line.
"""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from rgss.motion.blending import SmoothPath
from rgss.motion.derivatives import path_derivatives
from rgss.motion.limits import MotionLimits, require_joints
from rgss.motion.paths import JointPath
from rgss.motion.profiles.trapezoid import sampled_peaks
from rgss.motion.runs import joined
from rgss.motion.timing import TimedMove, TimingOutcome
from rgss.motion.trajectory import Trajectory
from rgss.motion.validity import StateValidity, ToolKinematics, first_invalid_between

Vector = NDArray[np.float64]

_SAMPLES_OF_PIECE = 33
# Times nearer than this are equal but for rounding, such as the two sides of a triangle's apex.
_SAME_TIME_S = 1e-12
# A joint that moves by less is still: with a profile of its own, rounding noise would accelerate it, and so the tool.
_STILL_RAD = 1e-9


def time_move_by_joint_waypoints(
    path: JointPath, validity: StateValidity, tool: ToolKinematics, limits: MotionLimits, *, resolution_rad: float
) -> TimedMove:
    """Time a path by one trapezoidal profile a joint between waypoints, with a stop at each of them.

    Args:
        path: A valid polyline, whose points are the waypoints.
        validity: State-validity checker.
        tool: Kinematics of the tool centre.
        limits: Limits of the motion; if the tool exceeds its own, the whole segment between two waypoints is slowed
            uniformly.
        resolution_rad: Greatest distance in joint space between two checked states.

    Raises:
        MotionError: The limits are not for the joints of the path.
    """
    require_joints(limits, path.points_rad.shape[1])
    points = [path.points_rad[0], *(b for a, b in pairwise(path.points_rad) if np.any(np.abs(b - a) > _STILL_RAD))]
    first_invalid = first_invalid_between(validity)
    segments, speed_m_s, acceleration_m_s2 = [], 0.0, 0.0
    for start, end in pairwise(points):
        for is_shared in (False, True):
            segment, of_tool = _within_tool_limits(_segment(start, end, limits, is_shared=is_shared), tool, limits)
            if first_invalid(_states(segment, resolution_rad)) is None:
                break
        else:
            return TimedMove(outcome=TimingOutcome.IN_COLLISION, trajectory=None, blended=0, stops=len(points) - 2)
        segments.append(segment)
        speed_m_s, acceleration_m_s2 = max(speed_m_s, of_tool[0]), max(acceleration_m_s2, of_tool[1])
    trajectory = _joined(points[0], segments, speed_m_s, acceleration_m_s2)
    return TimedMove(outcome=TimingOutcome.TIMED, trajectory=trajectory, blended=0, stops=max(len(points) - 2, 0))


def _segment(start: Vector, end: Vector, limits: MotionLimits, *, is_shared: bool) -> SmoothPath:
    """Motion between two waypoints; the path parameter is the time in s."""
    way = np.abs(end - start)
    speeds, accelerations = np.array(limits.speed_rad_s), np.array(limits.acceleration_rad_s2)
    if is_shared:
        moving = way > _STILL_RAD
        speeds = way * np.min(speeds[moving] / way[moving])
        accelerations = way * np.min(accelerations[moving] / way[moving])
    ramps, peaks, durations = np.zeros_like(way), np.zeros_like(way), np.zeros_like(way)
    for joint in np.flatnonzero(way > _STILL_RAD):
        peaks[joint] = min(speeds[joint], math.sqrt(way[joint] * accelerations[joint]))
        ramps[joint] = peaks[joint] / accelerations[joint]
        durations[joint] = way[joint] / peaks[joint] + ramps[joint]
    times = np.unique(np.concatenate([[0.0], ramps, durations - ramps, durations]))
    times = np.append(times[:-1][np.diff(times) > _SAME_TIME_S], times[-1])
    pieces = np.zeros((len(times) - 1, 6, len(way)))
    for index, (begin, after) in enumerate(pairwise(times)):
        pieces[index, :3] = _piece(begin, (begin + after) / 2.0, start, end, (ramps, peaks, durations))
    return SmoothPath(breaks=times, coefficients=pieces, stops=(0, len(times) - 1), curved=tuple(True for _ in pieces))


def _piece(begin: float, middle: float, start: Vector, end: Vector, profiles: tuple[Vector, Vector, Vector]) -> Vector:
    """Coefficients of position in powers of the time since the beginning of a piece, shape (3, joints)."""
    ramps, peaks, durations = profiles
    signs = np.sign(end - start)
    left = durations - begin
    gain = np.divide(peaks, ramps, out=np.zeros_like(peaks), where=ramps > 0.0)
    rises, falls, waits = middle < ramps, middle >= durations - ramps, middle >= durations
    speed = np.where(rises, gain * begin, np.where(falls, gain * left, peaks))
    done = np.where(rises, 0.5 * gain * begin**2, peaks * (begin - ramps / 2.0))
    position = np.where(falls, end - signs * 0.5 * gain * left**2, start + signs * done)
    change = np.where(rises, gain, np.where(falls, -gain, 0.0))
    still = np.zeros_like(speed)
    return np.array(
        [
            np.where(waits, end, position),
            np.where(waits, still, signs * speed),
            np.where(waits, still, 0.5 * signs * change),
        ]
    )


def _within_tool_limits(
    segment: SmoothPath, tool: ToolKinematics, limits: MotionLimits
) -> tuple[SmoothPath, tuple[float, float]]:
    """Segment slowed to the tool's limits, and the tool's peak speed and acceleration."""
    speed, acceleration = 0.0, 0.0
    for begin, end in pairwise(segment.breaks):
        # Exactly at its end a piece evaluates to the derivatives of the next one.
        times = np.minimum(np.linspace(begin, end, _SAMPLES_OF_PIECE), np.nextafter(end, begin))
        at = path_derivatives(segment, times, tool)
        speed = max(speed, float(sampled_peaks(np.linalg.norm(at.tool_first, axis=1))))
        acceleration = max(acceleration, float(sampled_peaks(np.linalg.norm(at.tool_second, axis=1))))
    slowdown = max(1.0, speed / limits.tool_speed_m_s, math.sqrt(acceleration / limits.tool_acceleration_m_s2))
    powers = slowdown ** np.arange(6)
    slowed = SmoothPath(
        breaks=segment.breaks * slowdown,
        coefficients=segment.coefficients / powers[:, None],
        stops=segment.stops,
        curved=segment.curved,
    )
    return slowed, (speed / slowdown, acceleration / slowdown**2)


def _states(segment: SmoothPath, resolution_rad: float) -> Vector:
    """States of a segment including both ends, at most the resolution apart."""
    fastest = np.max(np.abs(segment(segment.breaks, 1)), axis=0)
    count = max(1, math.ceil(float(segment.breaks[-1] * np.linalg.norm(fastest)) / resolution_rad))
    return segment(np.linspace(0.0, segment.breaks[-1], count + 1))


def _joined(start: Vector, segments: list[SmoothPath], speed_m_s: float, acceleration_m_s2: float) -> Trajectory:
    """Trajectory through all segments; its parameter is the time, so that its rate is 1."""
    if not segments:
        piece = np.zeros((1, 6, len(start)))
        piece[0, 0] = start
        still = SmoothPath(breaks=np.zeros(2), coefficients=piece, stops=(0, 1), curved=(False,))
        return joined(still, [])
    ends = np.cumsum([segment.breaks[-1] for segment in segments])
    begins = np.append(0.0, ends[:-1])
    breaks = [begin + segment.breaks[:-1] for begin, segment in zip(begins, segments, strict=True)]
    pieces = [len(segment.coefficients) for segment in segments]
    path = SmoothPath(
        breaks=np.append(np.concatenate(breaks), ends[-1]),
        coefficients=np.concatenate([segment.coefficients for segment in segments]),
        stops=(0, *np.cumsum(pieces).tolist()),
        curved=tuple(flag for segment in segments for flag in segment.curved),
    )
    span = np.array([0.0, ends[-1]])
    return Trajectory(
        path=path,
        parameters=span,
        rates=np.ones(2),
        times_s=span,
        peak_tool_speed_m_s=speed_m_s,
        peak_tool_acceleration_m_s2=acceleration_m_s2,
    )
