"""Motion of a joint's servo under recorded commands, for the fit."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rgss.identification.recording import CommandedPositions
from rgss.physics import VelocityLoop, mean_commands
from rgss.scenes import JointServo

Array = NDArray[np.float64]

LONGEST_STEP_S = 5.0e-4
"""Bound of the step with which servos are solved."""


def steps_per_sample(sampling_s: float, longest_step_s: float = LONGEST_STEP_S) -> int:
    """Least number of equal steps between two samples, none longer than a bound.

    Args:
        sampling_s: Time between samples.
        longest_step_s: The bound.
    """
    return max(1, math.ceil(sampling_s / longest_step_s - 1e-9))


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
    start: tuple[float | Array, float | Array] = (0.0, 0.0),
    commands: CommandedPositions = CommandedPositions.HELD,
    longest_step_s: float = LONGEST_STEP_S,
) -> ServoMotion:
    """Motion of several servos under the same commands, from the same start.

    A command acts from its sample to the next one; commanded positions may be interpolated instead. Between steps the
    velocity loop is solved exactly, Coulomb friction stops a joint and holds it, and the position loop is taken at the
    middle of the step, so that the error is of second order in the step.

    Args:
        servos: The servos.
        times_s: Times of the samples, rising, shape (times,).
        commanded_rad: Commanded positions, shape (times,).
        commanded_rad_s: Commanded speeds, shape (times,).
        start: Position (rad) and speed (rad/s) at the first sample, each one for all or of shape (servos,).
        commands: Course of the commanded positions between samples.
        longest_step_s: Bound of the step.
    """
    pieces = steps_per_sample(float(np.median(np.diff(times_s))), longest_step_s)
    steps = pieces * (len(times_s) - 1)
    step_s = float(times_s[-1] - times_s[0]) / steps
    edges = times_s[0] + step_s * np.arange(steps + 1)
    speeds = np.array([mean_commands(times_s, commanded_rad_s, edges - each.delay_s) for each in servos])
    if commands is CommandedPositions.INTERPOLATED:
        middles = edges[:-1] + step_s / 2
        targets = np.array([np.interp(middles - each.delay_s, times_s, commanded_rad) for each in servos])
    else:
        targets = np.array([mean_commands(times_s, commanded_rad, edges - each.delay_s) for each in servos])
    loop = VelocityLoop(servos, step_s)
    q, v = (np.array(np.broadcast_to(each, len(servos)), dtype=np.float64) for each in start)
    positions, velocities = np.empty((steps + 1, len(servos))), np.empty((steps + 1, len(servos)))
    positions[0], velocities[0] = q, v
    for index in range(steps):
        q, v = loop.after(q, v, targets[:, index], speeds[:, index])
        positions[index + 1], velocities[index + 1] = q, v
    return ServoMotion(
        positions_rad=np.array([np.interp(times_s, edges, each) for each in positions.T]),
        velocities_rad_s=np.array([np.interp(times_s, edges, each) for each in velocities.T]),
    )
