"""Bit-exact serialisation of a timing."""

from __future__ import annotations

from dataclasses import dataclass

from rgss.documents import canonical_json
from rgss.errors import EvidenceError
from rgss.evidence import Failure, read_json
from rgss.motion import SmoothPath, Trajectory
from rgss.trials.path_quality import PathQuality
from rgss.trials.pieces.float_array import FloatArray
from rgss.trials.pieces.plain_values import to_plain
from rgss.trials.timing import TaskTiming


@dataclass(frozen=True, slots=True, kw_only=True)
class _Motion:
    phase: str
    breaks: FloatArray
    coefficients: FloatArray
    stops: tuple[int, ...]
    curved: tuple[bool, ...]
    parameters: FloatArray
    rates: FloatArray
    times_s: FloatArray
    peak_tool_speed_m_s: float
    peak_tool_acceleration_m_s2: float
    clearance_m: float | None
    manipulability_m3: float


@dataclass(frozen=True, slots=True, kw_only=True)
class _Untimed:
    phase: str
    failure: Failure
    detail: str


@dataclass(frozen=True, slots=True, kw_only=True)
class _Timing:
    motions: tuple[_Motion, ...]
    untimed: tuple[_Untimed, ...]


def timing_to_json(timing: TaskTiming) -> str:
    """Timing as canonical JSON: the smooth paths and the knots of their motions."""
    motions = tuple(
        _Motion(
            phase=phase,
            breaks=FloatArray.of(motion.path.breaks),
            coefficients=FloatArray.of(motion.path.coefficients),
            stops=motion.path.stops,
            curved=motion.path.curved,
            parameters=FloatArray.of(motion.parameters),
            rates=FloatArray.of(motion.rates),
            times_s=FloatArray.of(motion.times_s),
            peak_tool_speed_m_s=motion.peak_tool_speed_m_s,
            peak_tool_acceleration_m_s2=motion.peak_tool_acceleration_m_s2,
            clearance_m=timing.qualities[phase].clearance_m,
            manipulability_m3=timing.qualities[phase].manipulability_m3,
        )
        for phase, motion in timing.trajectories.items()
    )
    untimed = tuple(
        _Untimed(phase=phase, failure=failure, detail=detail) for phase, (failure, detail) in timing.failures.items()
    )
    return canonical_json(to_plain(_Timing(motions=motions, untimed=untimed)))


def timing_from_json(text: str) -> TaskTiming:
    """Timing from the output of `timing_to_json`.

    Raises:
        EvidenceError: The text is not valid.
    """
    read = read_json(text, _Timing, "timing")
    phases = [*(motion.phase for motion in read.motions), *(entry.phase for entry in read.untimed)]
    if len(set(phases)) != len(phases):
        raise EvidenceError("the timing has two entries of one phase")
    return TaskTiming(
        trajectories={motion.phase: _trajectory(motion) for motion in read.motions},
        failures={entry.phase: (entry.failure, entry.detail) for entry in read.untimed},
        qualities={
            motion.phase: PathQuality(clearance_m=motion.clearance_m, manipulability_m3=motion.manipulability_m3)
            for motion in read.motions
        },
    )


def _trajectory(motion: _Motion) -> Trajectory:
    pieces, knots = len(motion.curved), motion.times_s.shape
    if (
        pieces < 1
        or motion.breaks.shape != (pieces + 1,)
        or motion.coefficients.shape[:2] != (pieces, 6)
        or len(motion.coefficients.shape) != 3
        or len(knots) != 1
        or knots[0] < 2
        or not motion.parameters.shape == motion.rates.shape == knots
    ):
        raise EvidenceError(f"the motion of {motion.phase} has arrays of inconsistent shapes")
    return Trajectory(
        path=SmoothPath(
            breaks=motion.breaks.array(),
            coefficients=motion.coefficients.array(),
            stops=motion.stops,
            curved=motion.curved,
        ),
        parameters=motion.parameters.array(),
        rates=motion.rates.array(),
        times_s=motion.times_s.array(),
        peak_tool_speed_m_s=motion.peak_tool_speed_m_s,
        peak_tool_acceleration_m_s2=motion.peak_tool_acceleration_m_s2,
    )
