"""Rehearsal: dry run of a task's stream with a driver that records the set points."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import groupby

import numpy as np

from rgss.drivers.driver import Estimate, GripperState, SetPoint
from rgss.drivers.limits import Guard, RobotLimits, ToolPositions
from rgss.drivers.streaming import Sample, StreamOutcome, StreamSettings, stream
from rgss.drivers.task import TimedTask


@dataclass(frozen=True, slots=True, kw_only=True)
class SegmentSummary:
    """Summary of the set points of one segment.

    Attributes:
        name: Name of the phase.
        gripper: State of the gripper.
        duration_s: Its duration.
        set_points: Number of set points.
        peak_speed: Greatest joint speed as a share of its limit.
        peak_acceleration: Greatest joint acceleration as a share of its limit.
        peak_tool_speed_m_s: Greatest speed of the tool centre.
    """

    name: str
    gripper: GripperState
    duration_s: float
    set_points: int
    peak_speed: float
    peak_acceleration: float
    peak_tool_speed_m_s: float


@dataclass(frozen=True, slots=True, kw_only=True)
class Rehearsal:
    """Result of a rehearsal.

    Attributes:
        start_rad: Required start configuration.
        segments: The segments in order.
        refusal: Reason why the task would be rejected; empty if it would not.
    """

    start_rad: tuple[float, ...]
    segments: tuple[SegmentSummary, ...]
    refusal: str

    @property
    def duration_s(self) -> float:
        """Duration of all segments."""
        return math.fsum(segment.duration_s for segment in self.segments)


def rehearse(
    task: TimedTask, limits: RobotLimits, tool: ToolPositions, settings: StreamSettings, *, rate_hz: float
) -> Rehearsal:
    """Run a task without a robot, behind the same guard.

    Args:
        task: The task.
        limits: The limits.
        tool: Kinematics of the tool.
        settings: Speed and tolerances.
        rate_hz: Rate of the intended driver.
    """
    echo = _Echo(task.start_rad, rate_hz)
    result = stream(echo, task, Guard(limits, tool, period_s=1.0 / rate_hz), echo, settings)
    refusal = "" if result.outcome is StreamOutcome.COMPLETED else result.detail
    # The first sample is the start, which is measured and not sent.
    sent = result.samples[1:]
    return Rehearsal(
        start_rad=task.start_rad, segments=_summaries(sent, limits, tool, rate_hz=rate_hz), refusal=refusal
    )


class _Echo:
    """A driver and its clock that report each set point as reached after one period."""

    name = "rehearsal"

    def __init__(self, start_rad: tuple[float, ...], rate_hz: float) -> None:
        self.rate_hz = rate_hz
        still = (0.0,) * len(start_rad)
        self._point = SetPoint(positions_rad=start_rad, velocities_rad_s=still, gripper=GripperState.NEUTRAL)
        self._time_s = 0.0

    def connect(self) -> None:
        """Nothing to open."""

    def read(self) -> Estimate:
        """The last set point as an estimate."""
        point = self._point
        return Estimate(
            positions_rad=point.positions_rad,
            velocities_rad_s=point.velocities_rad_s,
            gripper=point.gripper,
            stamp=self._time_s,
        )

    def send(self, point: SetPoint) -> None:
        """Remember a set point."""
        self._point = point

    def stop(self) -> None:
        """Nothing moves."""

    def disconnect(self) -> None:
        """Nothing to close."""

    def now_s(self) -> float:
        """Time of the rehearsal."""
        return self._time_s

    def wait_until(self, time_s: float) -> None:
        """Advance the simulated time."""
        self._time_s = time_s


def _summaries(
    samples: tuple[Sample, ...], limits: RobotLimits, tool: ToolPositions, *, rate_hz: float
) -> tuple[SegmentSummary, ...]:
    """One summary for each run of samples of the same phase."""
    found = []
    for (name, gripper), group in groupby(samples, key=lambda sample: (sample.phase, sample.commanded.gripper)):
        part = list(group)
        speeds = np.array([sample.commanded.velocities_rad_s for sample in part])
        changes = np.diff(np.vstack([np.zeros((1, speeds.shape[1])), speeds]), axis=0) * rate_hz
        tool_m = tool.tool_position(np.array([sample.commanded.positions_rad for sample in part]))
        tool_speeds = np.linalg.norm(np.diff(tool_m, axis=0), axis=1) * rate_hz
        found.append(
            SegmentSummary(
                name=name,
                gripper=gripper,
                duration_s=len(part) / rate_hz,
                set_points=len(part),
                peak_speed=float(np.max(np.abs(speeds) / limits.speed_rad_s)),
                peak_acceleration=float(np.max(np.abs(changes) / limits.acceleration_rad_s2)),
                peak_tool_speed_m_s=float(np.max(tool_speeds, initial=0.0)),
            )
        )
    return tuple(found)
