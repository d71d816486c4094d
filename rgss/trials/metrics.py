"""The metrics of a trial as a whole: what measures may take from it."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import NamedTuple

from rgss.evidence import PLANNED_PHASES


class MetricKind(NamedTuple):
    """What a metric is.

    Attributes:
        unit: Its unit, in SI.
        length: The number of its entries; None for a single number.
    """

    unit: str
    length: int | None = None


_ROW = len(PLANNED_PHASES)

METRICS: Mapping[str, MetricKind] = MappingProxyType(
    {
        "success": MetricKind("1"),
        "phases_completed": MetricKind("1"),
        "phases_total": MetricKind("1"),
        "planning_time_s": MetricKind("s", _ROW),
        "planning_checks": MetricKind("1", _ROW),
        "path_length_m": MetricKind("m", _ROW),
        "motion_time_s": MetricKind("s"),
        "task_time_s": MetricKind("s"),
        "grasp_cycle_time_s": MetricKind("s"),
        "peak_tool_speed_m_s": MetricKind("m/s"),
        "peak_tool_acceleration_m_s2": MetricKind("m/s**2"),
        "slip_m": MetricKind("m"),
        "grip_margin_min": MetricKind("1"),
        "peak_finger_force_n": MetricKind("N"),
        "place_error_m": MetricKind("m"),
        "place_tilt_rad": MetricKind("rad"),
        "arm_scene_contacts": MetricKind("1"),
        "peak_joint_torque_ratio": MetricKind("1"),
        "tracking_error_m": MetricKind("m"),
        "bench_payload_kg": MetricKind("kg"),
        "grasp_force_closure": MetricKind("1"),
        "grasp_q_msv_1": MetricKind("1"),
        "grasp_q_voe_1": MetricKind("1"),
        "grasp_q_gii_1": MetricKind("1"),
        "grasp_q_gpri_1": MetricKind("1"),
        "grasp_q_diff_m": MetricKind("m"),
        "grasp_q_smw_n": MetricKind("N"),
        "grasp_load_factor_1": MetricKind("1"),
    }
)
"""Every key of a record's metrics."""
