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
    """Least number of equal steps between two samples, none longer than a bound."""
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


@dataclass(frozen=True, slots=True, kw_only=True)
class ServoCommands:
    """Commands of a joint and its start.

    Attributes:
        times_s: Times of the samples, rising, shape (times,).
        commanded_rad: Commanded positions, shape (times,).
        commanded_rad_s: Commanded speeds, shape (times,).
        start: Position (rad) and speed (rad/s) at the first sample, each one for all servos or of shape (servos,).
    """

    times_s: Array
    commanded_rad: Array
    commanded_rad_s: Array
    start: tuple[float | Array, float | Array] = (0.0, 0.0)


def servo_motion(
    servos: Sequence[JointServo],
    times_s: Array,
    commanded_rad: Array,
    commanded_rad_s: Array,
    *,
    start: tuple[float | Array, float | Array] = (0.0, 0.0),
    commands: CommandedPositions = CommandedPositions.HELD,
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
    """
    given = ServoCommands(times_s=times_s, commanded_rad=commanded_rad, commanded_rad_s=commanded_rad_s, start=start)
    (motion,) = servo_motions(servos, [given], commands=commands)
    return motion


def servo_motions(
    servos: Sequence[JointServo],
    given: Sequence[ServoCommands],
    *,
    commands: CommandedPositions = CommandedPositions.HELD,
    longest_step_s: float = LONGEST_STEP_S,
) -> list[ServoMotion]:
    """Motion of several servos under each of several series of commands, as `servo_motion` solves it.

    Steps of all series are taken together, since a step takes nearly as long for many servos as for one.

    Args:
        servos: The servos.
        given: The series.
        commands: Course of the commanded positions between samples.
        longest_step_s: Bound of the step.
    """
    found: dict[int, ServoMotion] = {}
    courses = [_Course.of(servos, each, commands, longest_step_s) for each in given]
    for together in _batches([each.steps for each in courses], len(servos)):
        motions = _solved(servos, [courses[index] for index in together])
        found.update(zip(together, motions, strict=True))
    return [found[index] for index in range(len(given))]


_MOST_VALUES = 2_000_000
"""Bound of the values of one array, 16 MB."""


def _batches(steps: Sequence[int], servos: int) -> list[list[int]]:
    """Indices of series that are solved together: those of like lengths, as many as memory allows."""
    batches: list[list[int]] = []
    for index in sorted(range(len(steps)), key=lambda each: -steps[each]):
        longest = steps[batches[-1][0]] if batches else 0
        if batches and (len(batches[-1]) + 1) * servos * (longest + 1) <= _MOST_VALUES:
            batches[-1].append(index)
        else:
            batches.append([index])
    return batches


@dataclass(frozen=True, slots=True, kw_only=True)
class _Course:
    """Commands of several servos in each step of a series, delayed: shapes (steps, servos)."""

    given: ServoCommands
    edges: Array
    step_s: float
    targets: Array
    speeds: Array

    @property
    def steps(self) -> int:
        """Number of steps."""
        return len(self.edges) - 1

    @staticmethod
    def of(
        servos: Sequence[JointServo], given: ServoCommands, commands: CommandedPositions, longest_step_s: float
    ) -> _Course:
        times_s, commanded_rad = given.times_s, given.commanded_rad
        pieces = steps_per_sample(float(np.median(np.diff(times_s))), longest_step_s)
        steps = pieces * (len(times_s) - 1)
        step_s = float(times_s[-1] - times_s[0]) / steps
        edges = times_s[0] + step_s * np.arange(steps + 1)
        speeds = [mean_commands(times_s, given.commanded_rad_s, edges - each.delay_s) for each in servos]
        if commands is CommandedPositions.INTERPOLATED:
            middles = edges[:-1] + step_s / 2
            targets = [np.interp(middles - each.delay_s, times_s, commanded_rad) for each in servos]
        else:
            targets = [mean_commands(times_s, commanded_rad, edges - each.delay_s) for each in servos]
        return _Course(given=given, edges=edges, step_s=step_s, targets=np.array(targets).T, speeds=np.array(speeds).T)


def _solved(servos: Sequence[JointServo], courses: Sequence[_Course]) -> list[ServoMotion]:
    """Motions of series that begin together; the shorter ones are continued without a command, which is not used."""
    count, steps = len(servos), max(each.steps for each in courses)
    loop = VelocityLoop([*servos] * len(courses), np.repeat([each.step_s for each in courses], count))
    targets, speeds = np.zeros((2, steps, count * len(courses)))
    positions, velocities = np.empty((2, steps + 1, count * len(courses)))
    for index, each in enumerate(courses):
        own = slice(index * count, (index + 1) * count)
        targets[: each.steps, own], speeds[: each.steps, own] = each.targets, each.speeds
        positions[0, own], velocities[0, own] = each.given.start
    q, v = positions[0], velocities[0]
    for index in range(steps):
        q, v = loop.after(q, v, targets[index], speeds[index])
        positions[index + 1], velocities[index + 1] = q, v
    return [
        ServoMotion(
            positions_rad=_sampled(each, positions[:, index * count : (index + 1) * count]),
            velocities_rad_s=_sampled(each, velocities[:, index * count : (index + 1) * count]),
        )
        for index, each in enumerate(courses)
    ]


def _sampled(course: _Course, values: Array) -> Array:
    """Values at the edges of the steps, interpolated at the sample times, shape (servos, times)."""
    times_s, edges = course.given.times_s, course.edges
    return np.array([np.interp(times_s, edges, each) for each in values[: len(edges)].T])
