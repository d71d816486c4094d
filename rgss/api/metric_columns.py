"""What each metric of a trial and of a phase means, and its unit: the columns that frames have of them."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from rgss.api.column import Column, Kind
from rgss.trials import AT_GRASP, METRICS, MetricKind

_CARRIED = "the worst while the object is carried"

_MEANINGS: Mapping[str, str] = MappingProxyType(
    {
        "phases_completed": "how many of the states were completed",
        "phases_total": "how many states the task has",
        "planning_time_s": (
            "planning time t_sp of each planned move by the study's planning clock: search and simplification"
        ),
        "planning_checks": "state-validity checks of the search, of each planned move",
        "path_length_m": "length of the tool's path, of each planned move",
        "motion_time_s": "simulated time of all states, planning not counted",
        "task_time_s": "simulated time of the task, planning included; missing without success",
        "grasp_cycle_time_s": "time of closing on the object and of opening",
        "peak_tool_speed_m_s": "greatest speed of the grasp centre",
        "peak_tool_acceleration_m_s2": "greatest acceleration of the grasp centre; with contact averaged over 20 ms",
        "slip_m": "greatest distance of the object from where it was grasped in the hand",
        "grip_margin_min": "least ratio of friction available to friction needed while the object is carried",
        "sensed_finger_force_n": "greatest normal force of a finger, averaged over the object's force window",
        "peak_finger_force_n": "greatest normal force of a finger in one physics step; depends on the step",
        "place_error_m": "horizontal distance of the placed object from where it should stand",
        "place_tilt_rad": "angle by which the placed object leans",
        "arm_scene_contacts": "steps in which the arm touched the scene",
        "peak_joint_torque_n_m": "greatest torque, of each joint of the arm",
        "peak_joint_torque_ratio": "greatest share of its torque limit that a joint reached",
        "most_loaded_joint": "number of the joint that came nearest to its torque limit, from 1",
        "joint_saturated_s": "time at the torque limit, of each joint of the arm",
        "tracking_error_m": "greatest distance of the grasp centre from where it should be",
        "bench_payload_kg": "greatest mass that the gripper held on the payload bench",
        "grasp_contact_count": "contacts of fingers and object",
        "grasp_equilibrium": "1 if the contacts can squeeze without a net wrench, 0 if not",
        "grasp_force_closure": "1 if the grasp can resist every wrench, 0 if not",
        "grasp_form_closure": "1 if the contacts immobilise the object without friction, 0 if not",
        "grasp_q_msv_1": "smallest singular value of the grasp matrix (3.6)",
        "grasp_q_voe_1": "product of the singular values of the grasp matrix (3.7)",
        "grasp_q_gii_1": "smallest over greatest singular value of the grasp matrix (3.8)",
        "grasp_q_gpri_1": "irregularity of the polygon of fingers (3.9)",
        "grasp_q_diff_m": "distance of the polygon's centroid from the centre of mass (3.10)",
        "grasp_q_smw_n": "greatest wrench that is resisted in every direction (3.12)",
        "grasp_load_factor_1": "multiple of the object's weight that the grasp can bear",
        "contact_gap_min_m": "least gap of finger and object; below 0 where they penetrate",
        "contact_closing_speed_m_s": "greatest speed at which a gap shrinks",
        "contact_opening_speed_m_s": "greatest speed at which a gap grows",
        "contact_slip_speed_m_s": "greatest relative tangential speed of finger and object",
        "contacts_penetrating": "contacts that penetrate",
        "contacts_separating": "contacts that part",
        "contacts_slipping": "contacts that slip",
        "contacts_rolling": "contacts that touch and do not slip",
        "held_wrench_n": "norm of the contacts' net wrench on the object, torque over its radius",
        "held_distance_m": "distance of the object from how it was grasped, its turn counted with its radius",
        "held_speed_m_s": "norm of the object's velocity in the hand, its turning counted with its radius",
        "grasp_samples": "how often the carried grasp was analysed",
        "grasp_force_closure_share_1": "share of these samples in force closure",
    }
)

_OF_PHASES_ALONE: Mapping[str, tuple[MetricKind, str]] = MappingProxyType(
    {
        "commanded_tool_speed_m_s": (MetricKind("m/s"), "greatest speed of the grasp centre that was asked for"),
        "commanded_tool_acceleration_m_s2": (MetricKind("m/s**2"), "greatest acceleration that was asked for"),
        "workpiece_displacement_m": (
            MetricKind("m"),
            "how far the object moved before the grasp, or the hand moved it in its release and afterwards",
        ),
        "workpiece_position_m": (MetricKind("m", 3), "position of the object in the world at the end: x, y, z"),
        "workpiece_tilt_rad": (MetricKind("rad"), "angle by which the object leans at the end"),
        "finger_force_n": (MetricKind("N", 0), "normal force at the end of the grasp, of each finger"),
        "finger_force_needed_n": (MetricKind("N"), "normal force of a finger that Coulomb friction needs at rest"),
        "finger_travel_m": (MetricKind("m", 0), "how far it had closed at the end of the grasp, of each finger"),
        "tightenings": (MetricKind("1"), "how often the grip was tightened"),
        "grasp_samples_closed": (MetricKind("1"), "how many of the samples of the grasp were in force closure"),
        "release_height_m": (MetricKind("m"), "height above the surface at which the object was released"),
        "landing_force_n": (
            MetricKind("N"),
            "greatest force of the scene on the object as it lands, averaged over the object's force window",
        ),
        "landing_speed_m_s": (MetricKind("m/s"), "greatest velocity change of the object by the scene as it lands"),
        "touch_force_n": (MetricKind("N"), "greatest normal force of a finger on the object after its release"),
        "opening_s": (MetricKind("s"), "time of opening"),
        "settling_s": (MetricKind("s"), "time after opening until the object stood still"),
    }
)
"""Metrics that only single phases have; a row whose length is that of the gripper's fingers has length 0 here."""

_NOT_OF_PHASES = (
    "phases_completed",
    "phases_total",
    "planning_time_s",
    "planning_checks",
    "path_length_m",
    "motion_time_s",
    "task_time_s",
    "grasp_cycle_time_s",
    "bench_payload_kg",
    "grasp_force_closure_share_1",
)
_SAID_OTHERWISE = "success"
_FIRM = ", when the grasp was firm"
_HELD = ("held_distance_m", "held_speed_m_s")


def trial_metric_columns() -> tuple[Column, ...]:
    """The columns of a trial's metrics, in the order in which a record has them; a row is one column here."""
    found = []
    at_its_worst = {*AT_GRASP.values(), *_HELD}
    for name, kind in METRICS.items():
        if name == _SAID_OTHERWISE:
            continue
        at_grasp = AT_GRASP.get(name)
        meaning = _MEANINGS[at_grasp or name]
        if at_grasp is not None:
            meaning += _FIRM
        elif name in at_its_worst:
            meaning += f", {_CARRIED}"
        found.append(_column(name, kind, meaning))
    return tuple(found)


def phase_metric_columns() -> tuple[Column, ...]:
    """The columns of a phase's metrics; those that a trial has too are of the phase alone."""
    shared = [
        _column(name, METRICS[name], meaning) for name, meaning in _MEANINGS.items() if name not in _NOT_OF_PHASES
    ]
    return (*shared, *(_column(name, kind, meaning) for name, (kind, meaning) in _OF_PHASES_ALONE.items()))


def _column(name: str, kind: MetricKind, meaning: str) -> Column:
    return Column(name=name, unit=kind.unit, meaning=meaning, kind=Kind.NUMBER, items=kind.length)
