"""Timeline of a replay as plain data for its page, in the units that are read there."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rgss.evidence import PhaseOutcome
from rgss.reports.replay.timeline import Plot, Series, Timeline, TimelinePhase
from rgss.reports.trials import words
from rgss.trials.replay import LEAST_SHOWN_S, ReplayScene, Touch

_DIGITS = 5
"""Significant digits of plotted values."""

_SHOWN = {"rad": ("°", math.degrees(1.0)), "m": ("mm", 1e3)}
"""Unit in which a page shows another one, with its factor; others are shown as they are."""


def timeline_to_json(timeline: Timeline, scene: ReplayScene) -> dict[str, Any]:
    """Timeline that a replay's page shows beside the scene, as plain data for JSON; unknown values are None."""
    return {
        "title": timeline.title,
        "outcome": timeline.outcome,
        "success": timeline.success,
        "start_s": float(timeline.time_s[0]),
        "end_s": float(timeline.time_s[-1]),
        "time_s": [round(time, 6) for time in timeline.time_s.tolist()],
        "phases": [_phase(phase) for phase in timeline.phases],
        "plots": [_plot(plot) for plot in (timeline.joint_positions, *timeline.quantities)],
        "contacts": [{"points_m": _rows(one.points_m), "forces_n": _rows(one.forces_n)} for one in scene.contacts],
        "touches": [_touch(one) for one in scene.touches],
        "greatest_force_n": _number(timeline.greatest_force_n),
        "perceived": [
            {
                "object": one.object,
                "distance_mm": round(1e3 * one.distance_m, 2),
                "angle_deg": round(math.degrees(one.angle_rad), 2),
            }
            for one in scene.perceived
        ],
    }


def _touch(touch: Touch) -> dict[str, Any]:
    return {
        "link": words(touch.link.removesuffix("_link")),
        "body": words(touch.body),
        "start_s": round(touch.start_s, 6),
        "end_s": round(max(touch.end_s, touch.start_s + LEAST_SHOWN_S), 6),
        "point_m": [_number(value) for value in touch.point_m],
        "force_n": [_number(value) for value in touch.force_n],
    }


def _phase(phase: TimelinePhase) -> dict[str, Any]:
    return {
        "name": phase.name,
        "outcome": words(phase.outcome.value),
        "failed": phase.outcome is PhaseOutcome.FAILED,
        "start_s": phase.start_s,
        "end_s": phase.end_s,
        "key": phase.key,
    }


def _plot(plot: Plot) -> dict[str, Any]:
    units = sorted({_SHOWN.get(series.unit, (series.unit, 1.0))[0] for series in plot.series}, reverse=True)
    return {
        "title": plot.title,
        "unit": " or ".join(units),
        "series": [_series(series) for series in plot.series],
        "limit": None if plot.limit is None else {"name": plot.limit.name, "value": plot.limit.value},
    }


def _series(series: Series) -> dict[str, Any]:
    _, factor = _SHOWN.get(series.unit, (series.unit, 1.0))
    shown = {"name": series.name, "values": _numbers(factor * series.values)}
    return {**shown, "dashed": True} if series.is_commanded else shown


def _rows(rows: NDArray[np.float64]) -> list[list[float | None] | None]:
    return [_numbers(row) if math.isfinite(row[0]) else None for row in rows]


def _numbers(values: NDArray[np.float64]) -> list[float | None]:
    return [_number(value) for value in values.tolist()]


def _number(value: float) -> float | None:
    return float(f"{value:.{_DIGITS}g}") if math.isfinite(value) else None
