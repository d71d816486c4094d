"""Document model of the joint control in one step."""

from __future__ import annotations

from typing import Literal

from rgss.documents import Dimensionless, DocumentModel, RadiansPerSecond
from rgss.tasks.reading.reader import Location, TaskReader
from rgss.tasks.steps import StepControl


class StepControlEntry(DocumentModel):
    """Joint control in one step; omitted values are those of the study."""

    mode: Literal["position", "velocity", "computed_torque", "tool_tracking"] | None = None
    natural_frequency: RadiansPerSecond | None = None
    damping_ratio: Dimensionless | None = None
    position_gain: RadiansPerSecond | None = None
    velocity_gain: RadiansPerSecond | None = None


def control_of(entry: StepControlEntry | None, reader: TaskReader, at: Location) -> StepControl | None:
    """Joint control of a step; None for that of the study."""
    if entry is None:
        return None
    here = (*at, "control")
    reader.refuse_not_positive(
        here,
        natural_frequency=entry.natural_frequency,
        damping_ratio=entry.damping_ratio,
        velocity_gain=entry.velocity_gain,
    )
    if entry.position_gain is not None and entry.position_gain < 0.0:
        reader.report("task.negative", "position_gain must not be negative", (*here, "position_gain"))
    return StepControl(
        mode=entry.mode,
        natural_frequency_rad_s=entry.natural_frequency,
        damping_ratio=entry.damping_ratio,
        position_gain_1_s=entry.position_gain,
        velocity_gain_1_s=entry.velocity_gain,
    )
