"""Timeline of a replay: phases, plots and contact forces as plain data for the page."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rgss.evidence import PhaseOutcome, TrialRecord
from rgss.evidence.records import TrialTrace
from rgss.reports.trials import words
from rgss.scenes import Joint, JointKind
from rgss.trials.replay import ReplayScene

_DIGITS = 5
"""Significant digits of plotted values."""


def timeline_of(
    record: TrialRecord, trace: TrialTrace, scene: ReplayScene, *, joints: Sequence[Joint], title: str
) -> dict[str, Any]:
    """Timeline that a replay's page shows beside the scene, as plain data for JSON; unknown values are None.

    Args:
        record: The trial.
        trace: Its course, the source of the plots: greatest forces and least margins between samples.
        scene: The scene of its replay.
        joints: The joints of the arm.
        title: Title of the trial.
    """
    return {
        "title": title,
        "outcome": _outcome(record),
        "success": record.success,
        "start_s": float(scene.time_s[0]),
        "end_s": float(scene.time_s[-1]),
        "time_s": [round(time, 6) for time in scene.time_s.tolist()],
        "phases": _phases(record, trace),
        "plots": _plots(trace, scene, joints),
        "contacts": [{"points_m": _rows(one.points_m), "forces_n": _rows(one.forces_n)} for one in scene.contacts],
        "greatest_force_n": _greatest([one.forces_n for one in scene.contacts]),
        "perceived": {
            "distance_mm": round(1e3 * scene.perceived.distance_m, 2),
            "angle_deg": round(math.degrees(scene.perceived.angle_rad), 2),
        },
        "middle_m": list(scene.middle_m),
    }


def _outcome(record: TrialRecord) -> str:
    if record.failure is None or record.failed_phase is None:
        return "Done: every phase is complete."
    detail = f": {record.failure_detail}" if record.failure_detail else ""
    return f"Failed at {words(record.failed_phase)}, {words(record.failure.value)}{detail}."


def _phases(record: TrialRecord, trace: TrialTrace) -> list[dict[str, Any]]:
    """The phases in order; those without motion have no times."""
    spans = {span.phase: span for span in trace.spans}
    return [
        {
            "name": words(phase.phase),
            "outcome": words(phase.outcome.value),
            "failed": phase.outcome is PhaseOutcome.FAILED,
            "start_s": spans[phase.phase].start_s if phase.phase in spans else None,
            "end_s": spans[phase.phase].end_s if phase.phase in spans else None,
            "key": phase.phase,
        }
        for phase in record.phases
    ]


def _plots(trace: TrialTrace, scene: ReplayScene, joints: Sequence[Joint]) -> list[dict[str, Any]]:
    # The first trace sample of each interval of the replay, but the worst force and margin of the interval.
    starts = np.unique(np.clip(np.searchsorted(trace.time_s, scene.time_s - 1e-9), 0, len(trace.time_s) - 1))
    if len(starts) != len(scene.time_s):
        raise AssertionError("checked before: a replay is sampled no more often than its trace")
    angles = [
        {"name": words(joint.name.removesuffix("_joint")), "values": _numbers(_joint(trace, place, joint)[starts])}
        for place, joint in enumerate(joints)
    ]
    sliding = any(joint.kind is JointKind.PRISMATIC for joint in joints)
    forces = [
        {"name": f"finger {finger + 1}", "values": _numbers(np.maximum.reduceat(column, starts))}
        for finger, column in enumerate(trace.finger_forces_n.T)
    ]
    commanded = {"name": "commanded", "values": _numbers(trace.commanded_force_n[starts]), "dashed": True}
    margin = {"name": "grip margin", "values": _numbers(np.fmin.reduceat(trace.grip_margin, starts))}
    speed = {"name": "tool speed", "values": _numbers(trace.tool_speed_m_s[starts])}
    return [
        {"title": "Joint positions", "unit": "° or mm" if sliding else "°", "series": angles, "limit": None},
        {
            "title": "Tool speed",
            "unit": "m/s",
            "series": [speed],
            "limit": {"name": "limit", "value": trace.tool_speed_limit_m_s},
        },
        {"title": "Finger forces", "unit": "N", "series": [*forces, commanded], "limit": None},
        {"title": "Grip margin", "unit": "1", "series": [margin], "limit": {"name": "slips below", "value": 1.0}},
    ]


def _joint(trace: TrialTrace, place: int, joint: Joint) -> NDArray[np.float64]:
    """Positions of a joint: degrees, or millimetres of a prismatic one."""
    factor = 1e3 if joint.kind is JointKind.PRISMATIC else math.degrees(1.0)
    positions: NDArray[np.float64] = factor * trace.joint_positions_rad[:, place]
    return positions


def _greatest(forces: Sequence[NDArray[np.float64]]) -> float:
    """Greatest magnitude of the forces; 0 if there are none."""
    known = [np.linalg.norm(rows[np.isfinite(rows[:, 0])], axis=1) for rows in forces]
    return _number(max((float(rows.max(initial=0.0)) for rows in known), default=0.0)) or 0.0


def _rows(rows: NDArray[np.float64]) -> list[list[float | None] | None]:
    return [_numbers(row) if math.isfinite(row[0]) else None for row in rows]


def _numbers(values: NDArray[np.float64]) -> list[float | None]:
    return [_number(value) for value in values.tolist()]


def _number(value: float) -> float | None:
    return float(f"{value:.{_DIGITS}g}") if math.isfinite(value) else None
