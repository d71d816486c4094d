"""Channels of quantities over time: joints, tool speed, finger forces, grip margin; and the phases."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator
from typing import Any

from rgss.evidence import PhaseOutcome
from rgss.reports.replay.foxglove.channels import Channel, Schema, number_schema, published_schema
from rgss.reports.replay.foxglove.primitives import timestamp
from rgss.reports.replay.timeline import Plot, Timeline
from rgss.reports.replay.viewer_names import series_keys, topic_of
from rgss.reports.trials import words

_INFO, _WARNING, _ERROR = 2, 3, 4
_LEVELS = {PhaseOutcome.COMPLETED: _INFO, PhaseOutcome.FAILED: _ERROR, PhaseOutcome.NOT_RUN: _WARNING}
_PHASE_SCHEMA = Schema(
    name="rgss.Phase",
    text=json.dumps(
        {
            "title": "rgss.Phase",
            "type": "object",
            "properties": {
                "number": {"type": "integer", "description": "Place of the phase in the task, from 1"},
                "phase": {"type": "string", "description": "Name of the phase that begins"},
            },
            "required": ["number", "phase"],
        }
    ),
)


def series_channels(timeline: Timeline) -> tuple[Channel, ...]:
    """Channels of the plotted quantities and of the phases."""
    plots = (timeline.joint_positions, timeline.joint_speeds, *timeline.quantities)
    return (
        Channel(topic="/joint_states", schema=published_schema("JointStates"), messages=_joint_states(timeline)),
        *(_plot_channel(timeline, plot) for plot in plots),
        Channel(topic="/phase", schema=_PHASE_SCHEMA, messages=_phase_starts(timeline)),
        Channel(topic="/log", schema=published_schema("Log"), messages=list(_log(timeline))),
    )


def _plot_channel(timeline: Timeline, plot: Plot) -> Channel:
    """Numbers of one plot, each under its name with the unit; unknown ones are absent."""
    named = [(series.name, series.unit) for series in plot.series]
    values = [series.values.tolist() for series in plot.series]
    if plot.limit is not None:
        named.append((plot.limit.name, plot.series[0].unit))
        values.append([plot.limit.value] * len(timeline.time_s))
    keys = series_keys(named)
    columns = dict(zip(keys, values, strict=True))
    described = {key: f"{name} [{unit}]" for key, (name, unit) in zip(keys, named, strict=True)}
    topic = topic_of(plot.title)
    return Channel(
        topic=f"/{topic}",
        schema=number_schema(f"rgss.{plot.title.title().replace(' ', '')}", described),
        messages=[
            (time_s, {key: column[sample] for key, column in columns.items() if math.isfinite(column[sample])})
            for sample, time_s in enumerate(timeline.time_s.tolist())
        ],
    )


def _joint_states(timeline: Timeline) -> list[tuple[float, dict[str, Any]]]:
    positions = [series.values.tolist() for series in timeline.joint_positions.series]
    speeds = [series.values.tolist() for series in timeline.joint_speeds.series]
    states = []
    for sample, time_s in enumerate(timeline.time_s.tolist()):
        joints = []
        for place, name in enumerate(timeline.joint_names):
            state = {"name": name, "position": positions[place][sample]}
            if math.isfinite(speeds[place][sample]):
                state["velocity"] = speeds[place][sample]
            joints.append(state)
        states.append((time_s, {"timestamp": timestamp(time_s), "joints": joints}))
    return states


def _phase_starts(timeline: Timeline) -> list[tuple[float, dict[str, Any]]]:
    return [
        (phase.start_s, {"number": number, "phase": phase.name})
        for number, phase in enumerate(timeline.phases, start=1)
        if phase.start_s is not None
    ]


def _log(timeline: Timeline) -> Iterator[tuple[float, dict[str, Any]]]:
    """Start and outcome of each phase that moved, the outcomes of the others at the end, and that of the trial."""
    last_s = timeline.end_s
    for number, phase in enumerate(timeline.phases, start=1):
        title = f"{number} {phase.name}"
        if phase.start_s is not None:
            yield phase.start_s, _entry(phase.start_s, _INFO, f"{title}: started")
        end_s = last_s if phase.end_s is None else phase.end_s
        yield end_s, _entry(end_s, _LEVELS[phase.outcome], f"{title}: {words(phase.outcome.value)}")
    yield last_s, _entry(last_s, _INFO if timeline.success else _ERROR, timeline.outcome)


def _entry(time_s: float, level: int, message: str) -> dict[str, Any]:
    return {
        "timestamp": timestamp(time_s),
        "level": level,
        "message": message,
        "name": "trial",
        "file": "",
        "line": 0,
    }
