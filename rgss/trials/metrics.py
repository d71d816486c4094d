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
        length: The number of its entries; None for a single number. A row of which nothing is known may be missing.
    """

    unit: str
    length: int | None = None


_ROW = len(PLANNED_PHASES)
_JOINTS = 6

_TRIAL = {
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
    "sensed_finger_force_n": MetricKind("N"),
    "peak_finger_force_n": MetricKind("N"),
    "place_error_m": MetricKind("m"),
    "place_tilt_rad": MetricKind("rad"),
    "arm_scene_contacts": MetricKind("1"),
    "peak_joint_torque_n_m": MetricKind("N*m", _JOINTS),
    "peak_joint_torque_ratio": MetricKind("1"),
    "most_loaded_joint": MetricKind("1"),
    "joint_saturated_s": MetricKind("s", _JOINTS),
    "tracking_error_m": MetricKind("m"),
    "bench_payload_kg": MetricKind("kg"),
}

_GRASP = {
    "grasp_contact_count": MetricKind("1"),
    "grasp_equilibrium": MetricKind("1"),
    "grasp_force_closure": MetricKind("1"),
    "grasp_form_closure": MetricKind("1"),
    "grasp_q_msv_1": MetricKind("1"),
    "grasp_q_voe_1": MetricKind("1"),
    "grasp_q_gii_1": MetricKind("1"),
    "grasp_q_gpri_1": MetricKind("1"),
    "grasp_q_diff_m": MetricKind("m"),
    "grasp_q_smw_n": MetricKind("N"),
    "grasp_load_factor_1": MetricKind("1"),
    "contact_gap_min_m": MetricKind("m"),
    "contact_closing_speed_m_s": MetricKind("m/s"),
    "contact_opening_speed_m_s": MetricKind("m/s"),
    "contact_slip_speed_m_s": MetricKind("m/s"),
    "contacts_penetrating": MetricKind("1"),
    "contacts_separating": MetricKind("1"),
    "contacts_slipping": MetricKind("1"),
    "contacts_rolling": MetricKind("1"),
    "held_wrench_n": MetricKind("N"),
}

_CARRY = {
    "held_distance_m": MetricKind("m"),
    "held_speed_m_s": MetricKind("m/s"),
    "grasp_samples": MetricKind("1"),
    "grasp_force_closure_share_1": MetricKind("1"),
}

AT_GRASP: Mapping[str, str] = MappingProxyType({f"at_grasp_{name.removeprefix('grasp_')}": name for name in _GRASP})
"""What is known of the grasp as it was closed, by the name of the same at its worst over the carry."""

METRICS: Mapping[str, MetricKind] = MappingProxyType(
    {**_TRIAL, **_GRASP, **_CARRY, **{at_grasp: _GRASP[name] for at_grasp, name in AT_GRASP.items()}}
)
"""Every key of a record's metrics; those of the grasp are at their worst while the object is carried."""
