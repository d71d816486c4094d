"""Timed task as a driver runs it: motions from rest to rest, and waits for the gripper."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from rgss.drivers.driver import GripperState
from rgss.errors import DefinitionError

Array = NDArray[np.float64]


class SampledMotion(Protocol):
    """A joint trajectory from rest to rest that can be sampled."""

    @property
    def duration_s(self) -> float:
        """Its duration."""

    def positions(self, times: Array) -> Array:
        """Joint positions, shape (n, joints), at times in s, shape (n,)."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Segment:
    """Part of a task: a motion, or a wait in which the gripper reaches its state.

    Attributes:
        name: Name of the phase.
        gripper: State of the gripper, commanded from the beginning of the segment.
        motion: The motion; None for a wait.
        wait_s: Duration of a wait. It does not depend on the speed at which motions are run.
    """

    name: str
    gripper: GripperState
    motion: SampledMotion | None = None
    wait_s: float = 0.0


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class TimedTask:
    """Segments in the order in which they run.

    Attributes:
        segments: The segments, each beginning where the one before it ends.

    Raises:
        DefinitionError: The task has no motion.
    """

    segments: tuple[Segment, ...]

    def __post_init__(self) -> None:
        if all(segment.motion is None for segment in self.segments):
            raise DefinitionError("a timed task must have a motion", hint="its start is where the robot must be")

    @property
    def start_rad(self) -> tuple[float, ...]:
        """Joint positions at which the task begins, those of its first motion."""
        motions = (segment.motion for segment in self.segments)
        return next((_at(motion, 0.0) for motion in motions if motion is not None), ())


class TaskCursor:
    """Position in a task whose motions run at a rate: path seconds for each second."""

    def __init__(self, task: TimedTask, period_s: float) -> None:
        """Begin at the start of the task, at rest.

        Args:
            task: The task.
            period_s: Period of the set points.
        """
        self._segments = task.segments
        self._period_s = period_s
        self._index = 0
        self._since_s = 0.0
        self._positions = task.start_rad
        self.rate = 0.0

    @property
    def is_finished(self) -> bool:
        """True after the last segment."""
        return self._index >= len(self._segments)

    @property
    def segment(self) -> Segment:
        """The current segment; the last one after the end."""
        return self._segments[min(self._index, len(self._segments) - 1)]

    def candidate(self, rate: float) -> tuple[float, ...]:
        """Joint positions after one period at a rate; the cursor stays where it is."""
        motion = self.segment.motion
        return self._positions if motion is None else _at(motion, self._since_s + rate * self._period_s)

    def advance(self, rate: float) -> None:
        """Go to the candidate of a rate, and to the next segment where the current one is complete."""
        self._positions = self.candidate(rate)
        segment, self.rate = self.segment, rate
        step_s = self._period_s if segment.motion is None else rate * self._period_s
        length_s = segment.wait_s if segment.motion is None else segment.motion.duration_s
        self._since_s += step_s
        if self._since_s >= length_s - 1e-9:
            self._index, self._since_s = self._index + 1, 0.0


def rate_candidates(now: float, target: float, step: float) -> Sequence[float]:
    """Rates to try for the next period, the one nearest to the target first and the present one last."""
    change = min(max(target - now, -step), step)
    return [*dict.fromkeys((now + change, now + change / 2, now + change / 4, now))]


def _at(motion: SampledMotion, time_s: float) -> tuple[float, ...]:
    time_s = min(time_s, motion.duration_s)
    return tuple(np.asarray(motion.positions(np.array([time_s])))[0].tolist())
