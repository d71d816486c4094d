"""Timeline of a replay: phases and plotted quantities over time, for every viewer."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rgss.evidence import PhaseOutcome, TrialRecord
from rgss.evidence.records import TrialTrace
from rgss.reports.trials import words
from rgss.scenes import Joint, JointKind
from rgss.trials.replay import ReplayScene


@dataclass(frozen=True, slots=True, kw_only=True)
class TimelinePhase:
    """Phase of a trial.

    Attributes:
        key: Its name in the record.
        name: Its name in words.
        outcome: Its outcome.
        start_s: Its start; None if nothing moved in it.
        end_s: Its end; None if nothing moved in it.
    """

    key: str
    name: str
    outcome: PhaseOutcome
    start_s: float | None
    end_s: float | None


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Series:
    """Plotted quantity over time.

    Attributes:
        name: Its name in words.
        unit: Its unit: rad, m, rad/s, m/s, N, or 1.
        values: Its values, shape (n,); NaN where it is unknown.
        is_commanded: True if it is a command and not a measured value.
    """

    name: str
    unit: str
    values: NDArray[np.float64]
    is_commanded: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class Limit:
    """Constant limit of a plotted quantity.

    Attributes:
        name: Its name in words.
        value: Its value, in the unit of the series.
    """

    name: str
    value: float


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Plot:
    """Plot of one quantity.

    Attributes:
        title: Name of the quantity.
        series: Its series.
        limit: Its limit; None if there is none.
    """

    title: str
    series: tuple[Series, ...]
    limit: Limit | None = None


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Timeline:
    """Timeline of a trial; n samples in simulated time without planning, SI units.

    Attributes:
        title: Title of the trial.
        outcome: Its outcome in one sentence.
        success: True if it succeeded.
        time_s: Times of the samples, shape (n,).
        phases: Its phases in order.
        joint_names: Names of the joints in the robot's file, in the order of their series.
        joint_positions: Positions of the joints.
        joint_speeds: Speeds of the joints: second-order differences of the trace's positions.
        quantities: Tool speed, finger forces and grip margin.
        greatest_force_n: Greatest force of a finger on the object, normal and friction; 0 without contact.
    """

    title: str
    outcome: str
    success: bool
    time_s: NDArray[np.float64]
    phases: tuple[TimelinePhase, ...]
    joint_names: tuple[str, ...]
    joint_positions: Plot
    joint_speeds: Plot
    quantities: tuple[Plot, ...]
    greatest_force_n: float

    @property
    def end_s(self) -> float:
        """End of the last phase that moved, at or after the last sample."""
        return max([float(self.time_s[-1]), *(phase.end_s for phase in self.phases if phase.end_s is not None)])


def timeline_of(
    record: TrialRecord, trace: TrialTrace, scene: ReplayScene, *, joints: Sequence[Joint], title: str
) -> Timeline:
    """Timeline of a trial at the samples of its replay.

    Args:
        record: The trial.
        trace: Its course, the source of the plots: greatest forces and least margins between samples.
        scene: The scene of its replay.
        joints: The joints of the arm.
        title: Title of the trial.
    """
    # The first trace sample of each interval of the replay, but the worst force and margin of the interval.
    starts = np.unique(np.clip(np.searchsorted(trace.time_s, scene.time_s - 1e-9), 0, len(trace.time_s) - 1))
    if len(starts) != len(scene.time_s):
        raise AssertionError("checked before: a replay is sampled no more often than its trace")
    return Timeline(
        title=title,
        outcome=_outcome(record),
        success=record.success,
        time_s=scene.time_s,
        phases=_phases(record, trace),
        joint_names=tuple(joint.name for joint in joints),
        joint_positions=_joint_plot("Joint positions", joints, trace.joint_positions_rad[starts], per=""),
        joint_speeds=_joint_plot("Joint speeds", joints, _speeds(trace)[starts], per="/s"),
        quantities=_quantities(trace, starts),
        greatest_force_n=_greatest([one.forces_n for one in scene.contacts]),
    )


def _outcome(record: TrialRecord) -> str:
    if record.failure is None or record.failed_phase is None:
        return "Done: every phase is complete."
    detail = f": {record.failure_detail}" if record.failure_detail else ""
    return f"Failed at {words(record.failed_phase)}, {words(record.failure.value)}{detail}."


def _phases(record: TrialRecord, trace: TrialTrace) -> tuple[TimelinePhase, ...]:
    spans = {span.phase: span for span in trace.spans}
    return tuple(
        TimelinePhase(
            key=phase.phase,
            name=words(phase.phase),
            outcome=phase.outcome,
            start_s=spans[phase.phase].start_s if phase.phase in spans else None,
            end_s=spans[phase.phase].end_s if phase.phase in spans else None,
        )
        for phase in record.phases
    )


def _joint_plot(title: str, joints: Sequence[Joint], columns: NDArray[np.float64], *, per: str) -> Plot:
    return Plot(
        title=title,
        series=tuple(
            Series(
                name=name,
                unit=("m" if joint.kind is JointKind.PRISMATIC else "rad") + per,
                values=columns[:, place],
            )
            for place, (joint, name) in enumerate(zip(joints, _joint_names(joints), strict=True))
        ),
    )


def _joint_names(joints: Sequence[Joint]) -> list[str]:
    """Name of each joint in words, without the suffix where that leaves the names different."""
    short = Counter(joint.name.removesuffix("_joint") for joint in joints)
    names = ((joint.name, joint.name.removesuffix("_joint")) for joint in joints)
    return [words(brief if short[brief] == 1 else name) for name, brief in names]


def _speeds(trace: TrialTrace) -> NDArray[np.float64]:
    """Speeds of the joints, shape (n, joints); unknown with a single sample."""
    if len(trace.time_s) == 1:
        return np.full_like(trace.joint_positions_rad, np.nan)
    speeds: NDArray[np.float64] = np.gradient(trace.joint_positions_rad, trace.time_s, axis=0)
    return speeds


def _quantities(trace: TrialTrace, starts: NDArray[np.intp]) -> tuple[Plot, ...]:
    forces = [
        Series(name=f"finger {finger + 1}", unit="N", values=np.maximum.reduceat(column, starts))
        for finger, column in enumerate(trace.finger_forces_n.T)
    ]
    commanded = Series(name="commanded", unit="N", values=trace.commanded_force_n[starts], is_commanded=True)
    margin = Series(name="grip margin", unit="1", values=np.fmin.reduceat(trace.grip_margin, starts))
    speed = Series(name="tool speed", unit="m/s", values=trace.tool_speed_m_s[starts])
    return (
        Plot(title="Tool speed", series=(speed,), limit=Limit(name="limit", value=trace.tool_speed_limit_m_s)),
        Plot(title="Finger forces", series=(*forces, commanded)),
        Plot(title="Grip margin", series=(margin,), limit=Limit(name="slips below", value=1.0)),
    )


def _greatest(forces: Sequence[NDArray[np.float64]]) -> float:
    known = [np.linalg.norm(rows[np.isfinite(rows[:, 0])], axis=1) for rows in forces]
    return max((float(rows.max(initial=0.0)) for rows in known), default=0.0)
