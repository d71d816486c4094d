"""The project's own measures against the published equations, computed by hand."""

from __future__ import annotations

import math
import sys
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import pytest

from rgss.measures import Estimate, MeasureKind, MeasureSet, evaluate
from rgss.quantities import dimension

# Component values of the tests' own, so that the catalogue may change; the arm's are published.
COMPONENTS: Mapping[str, float] = {
    "component.manipulator.payload": 10.0,
    "component.manipulator.wrist_torque": 56.0,
    "component.manipulator.wrist_offset": 0.1157,
    "component.manipulator.flange_offset": 0.0922,
    "component.manipulator.cost": 30_000.0,
    "component.gripper.cost": 5_000.0,
    "component.finger_actuator.cost": 400.0,
    "component.finger_actuator.mass": 0.05,
    "component.planner.cost": 700.0,
}
# Rows 1 and 65 of the published design table, d1 to d9.
ROWS: Mapping[int, tuple[float | str, ...]] = {
    1: (3, 0.3, 0.4, 0.04, 10, 0.7, 0.5, "RRT", 4),
    65: (2, 0.2, 0.2, 0.04, 10, 0.7, 1, "RRT", 6),
}
TRIAL: Mapping[str, Any] = {
    "success": 1,
    "planning_time_s": (0.5, 0.25, 1.0, 0.75, 0.5),
    "path_length_m": (0.2, 0.3, 1.0, 0.25, 1.25),
    "phases_completed": 8,
    "phases_total": 8,
    "task_time_s": 15.5,
    "motion_time_s": 12.5,
    "grasp_cycle_time_s": 1.1,
    "peak_tool_speed_m_s": 0.49,
    "peak_tool_acceleration_m_s2": 1.1,
    "slip_m": 0.0015,
    "grip_margin_min": 1.6,
    "bench_payload_kg": 1.2,
    "grasp_force_closure": 1,
    "grasp_q_msv_1": 1.5,
    "grasp_q_gii_1": 0.5,
    "grasp_q_smw_n": 3.0,
    "grasp_force_closure_share_1": 0.75,
    "grasp_equilibrium": 1,
    "grasp_form_closure": 0,
    "grasp_q_voe_1": 13.5,
    "grasp_q_gpri_1": 0.2,
    "grasp_q_diff_m": 0.012,
    "grasp_load_factor_1": 5.5,
    "contact_gap_min_m": -0.00004,
    "contact_closing_speed_m_s": 0.0002,
    "contact_opening_speed_m_s": 0.0003,
    "contact_slip_speed_m_s": 0.0004,
    "contacts_penetrating": 2,
    "contacts_separating": 1,
    "contacts_slipping": 3,
    "contacts_rolling": 4,
    "held_distance_m": 0.0025,
    "held_speed_m_s": 0.0015,
    "held_wrench_n": 2.7,
    "at_grasp_contact_gap_min_m": -0.00001,
    "at_grasp_contacts_penetrating": 1,
    "at_grasp_contacts_slipping": 0,
    "at_grasp_force_closure": 0,
    "at_grasp_equilibrium": 1,
    "at_grasp_form_closure": 0,
    "at_grasp_q_msv_1": 0.25,
    "at_grasp_q_voe_1": 8.0,
    "at_grasp_q_gii_1": 0.125,
    "at_grasp_q_gpri_1": 0.1,
    "at_grasp_q_diff_m": 0.006,
    "at_grasp_q_smw_n": 2.0,
    "joint_saturated_s": (0.0, 0.5, 0.0, 0.0, 0.25, 0.0),
    "sensed_finger_force_n": 9.5,
    "place_error_m": 0.004,
    "place_tilt_rad": math.radians(0.5),
    "attempt_time_s": 15.5,
    "joint_work_j": 310.0,
    "joint_net_work_j": 12.0,
    "peak_joint_speed_ratio": 0.7,
    "peak_joint_utilisation": 0.7,
    "manipulability_min_m3": 0.06,
    "path_clearance_min_m": 0.005,
    "landing_force_n": 11.5,
    "peak_joint_torque_ratio": 0.6,
}


def fixed(variant: int, **changes: float) -> dict[str, float | str]:
    design = {f"design.d{index}": value for index, value in enumerate(ROWS[variant], start=1)}
    return {**design, **COMPONENTS, "component.gripper.actuators": float(ROWS[variant][0]), **changes}


def values(reference: MeasureSet, variant: int, *trials: Mapping[str, Any], **changes: float) -> dict[str, Estimate]:
    return evaluate(reference, fixed=fixed(variant, **changes), trials=trials or (TRIAL,), variant=variant)


@pytest.mark.verifies("SYS-036")
@pytest.mark.parametrize(
    ("variant", "expected"),
    [
        (
            1,
            {
                "P_max_m": 10.0,  # 4.6: the torque bound is 56 / (9.81 · √(0.1157² + 0.2372²)) = 21.6 kg
                "M_g": 0.4 + 3 * 0.3 + 3 * 0.05,  # 4.7
                "P_max_g": 0.7 * 30 / (1.5 * (9.81 + 1.2)),  # 4.8 with three fingers of 10 N
                "P_max": 1.27157,  # 4.1: the gripper binds
                "C_m": 30_000.0,
                "C_g": 5_000.0 + 3 * 400.0,
                "C_al": 700.0,
                "C_total": 36_900.0,  # 4.2
                "v_m": 0.5,  # 4.9
                "v_m_peak": 0.49,
                "t_gc": 1.2,  # 4.10
                "t_gc_simulated": 1.1,  # 4.12
                "f_f_peak": 9.5,  # 4.13
                "t_sp": 0.6,  # 4.11, the mean of five
                "t_p": 3.0,  # 4.4
                "L": 3.0,
                "t_e": 3.0 + 1.2 + 3.0 / 0.5,  # 4.3
                "t_m": 7.2,
                "S": 1.0,  # 4.5
                "S_mean": 1.0,
                "F_max": 30.0,
                "t_e_simulated": 15.5,
                "t_m_simulated": 12.5,
                "a_tool_peak": 1.1,
                "joint_torque_ratio": 0.6,
                "grip_margin": 1.6,
                "slip": 1.5,
                "place_error": 4.0,
                "place_tilt": 0.5,
                "MPPH": 3600.0 / 15.5,
                "E_cycle": 310.0,
                "joint_speed_ratio": 0.7,
                "joint_utilisation": 0.7,
                "manipulability": 0.06,
                "clearance": 5.0,
                "contact_force_peak": 11.5,
                "P_max_simulated": 1.2 / 1.5,  # the bench in place of 4.8
                "force_closure": 1.0,
                "Q_MSV": 1.5,
                "Q_GII": 0.5,
                "Q_SMW": 3.0,
                "force_closure_share": 0.75,
                "grasp_equilibrium": 1.0,
                "form_closure": 0.0,
                "Q_VOE": 13.5,
                "Q_GPRI": 0.2,
                "Q_diff": 12.0,
                "load_factor": 5.5,
                "contact_gap": -0.04,
                "contact_closing_speed": 0.2,
                "contact_opening_speed": 0.3,
                "contact_slip_speed": 0.4,
                "contacts_penetrating": 2.0,
                "contacts_separating": 1.0,
                "contacts_slipping": 3.0,
                "contacts_rolling": 4.0,
                "held_distance": 2.5,
                "held_speed": 1.5,
                "held_wrench": 2.7,
                "contact_gap_at_grasp": -0.01,
                "contacts_penetrating_at_grasp": 1.0,
                "contacts_slipping_at_grasp": 0.0,
                "force_closure_at_grasp": 0.0,
                "grasp_equilibrium_at_grasp": 1.0,
                "form_closure_at_grasp": 0.0,
                "Q_MSV_at_grasp": 0.25,
                "Q_VOE_at_grasp": 8.0,
                "Q_GII_at_grasp": 0.125,
                "Q_GPRI_at_grasp": 0.1,
                "Q_diff_at_grasp": 6.0,
                "Q_SMW_at_grasp": 2.0,
                "joint_saturation": 0.75,
            },
        ),
        (
            65,
            {
                "P_max_m": 10.0,
                "M_g": 0.2 + 2 * 0.2 + 2 * 0.05,
                "P_max_g": 0.7 * 20 / (1.5 * (9.81 + 1.2)),
                "P_max": 0.84771,
                "C_m": 30_000.0,
                "C_g": 5_000.0 + 2 * 400.0,
                "C_al": 700.0,
                "C_total": 36_500.0,
                "v_m": 1.0,
                "t_gc": 1.2,
                "t_p": 3.0,
                "L": 3.0,
                "t_e": 3.0 + 1.2 + 3.0 / 1.0,
                "t_m": 4.2,
                "S": 1.0,
                "F_max": 20.0,
            },
        ),
    ],
)
def test_the_equations_by_hand(reference: MeasureSet, variant: int, expected: Mapping[str, float]) -> None:
    result = values(reference, variant)
    assert {name: result[name].value for name in expected} == pytest.approx(expected, rel=1e-5)
    if variant == 1:
        assert list(result) == [measure.id for measure in reference.measures]
        assert {*result} == {*expected}


def test_two_fingers_have_no_polygon(reference: MeasureSet) -> None:
    known = {**TRIAL, "grasp_q_gpri_1": None, "at_grasp_q_gpri_1": None}
    result = values(reference, 65, known)
    assert result["Q_GPRI"] == result["Q_GPRI_at_grasp"] == Estimate.unknown("1")
    assert result["Q_diff"].value == pytest.approx(12.0)


def test_what_contacts_alone_know_is_unknown_without_them(reference: MeasureSet) -> None:
    trial = {name: value for name, value in TRIAL.items() if not name.startswith(("grasp_q", "contact", "held"))}
    result = values(reference, 1, {**trial, "joint_saturated_s": None})
    unknown = {name for name, estimate in result.items() if estimate.value is None}
    assert {"Q_MSV", "Q_VOE", "Q_SMW", "contact_gap", "contacts_slipping", "held_wrench", "joint_saturation"} <= unknown
    assert "t_e" not in unknown


def test_the_published_payload_of_ten_newtons_at_rest(reference: MeasureSet) -> None:
    at_rest = replace(
        reference,
        constants=tuple(constant for constant in reference.constants if constant.id != "a_m"),
        inputs=(*reference.inputs, _input_like(reference, "a_m", "design.a_m")),
    )
    design = {**fixed(1), "design.d1": 1.0, "design.a_m": 0.0}
    result = evaluate(at_rest, fixed=design, trials=(), variant=1)
    assert result["P_max_g"].value == pytest.approx(0.476, abs=5e-4)


def _input_like(reference: MeasureSet, name: str, source: str) -> Any:
    symbol = reference.inputs[0]
    return type(symbol)(id=name, source=source, unit="m/s^2", length=None, definition="as drawn")


def test_the_manipulator_binds_where_the_gripper_is_strong(reference: MeasureSet) -> None:
    result = values(reference, 1, **{"design.d5": 200.0})
    assert result["P_max"].value == pytest.approx(10.0 - 1.45)


def test_the_torque_bound_binds_where_the_wrist_is_weak(reference: MeasureSet) -> None:
    result = values(reference, 1, **{"component.manipulator.wrist_torque": 20.0})
    assert result["P_max_m"].value == pytest.approx(20.0 / (9.81 * (0.1157**2 + (0.0922 + 0.145) ** 2) ** 0.5))


def test_a_failed_trial_counts_in_success_and_not_in_time(reference: MeasureSet) -> None:
    failed = {
        "success": 0,
        "phases_completed": 2,
        "phases_total": 8,
        "planning_time_s": (0.5, 0.5, 4.0, None, None),
        "path_length_m": (0.2, 0.3, None, None, None),
        "bench_payload_kg": TRIAL["bench_payload_kg"],
    }
    failed["attempt_time_s"] = 7.0
    result = values(reference, 1, TRIAL, failed, TRIAL)
    assert (result["MPPH"].value, result["MPPH"].n) == (pytest.approx(2 * 3600 / (2 * 15.5 + 7.0)), 3)
    assert (result["S"].value, result["S"].n) == (pytest.approx(2 / 3), 3)
    assert result["S_mean"].value == pytest.approx((1 + 0.25 + 1) / 3)
    assert (result["t_e"].value, result["t_e"].n) == (pytest.approx(10.2), 2)
    assert (result["t_p"].value, result["t_p"].n) == (pytest.approx(3.0), 2)


def test_a_task_that_does_not_start_scores_nothing(reference: MeasureSet) -> None:
    result = values(reference, 1, {"success": 0, "phases_completed": 0, "phases_total": 8})
    assert (result["S"].value, result["S_mean"].value) == (0.0, 0.0)
    assert result["t_e"] == Estimate.unknown("s")


def test_the_measures_of_effectiveness_trace_as_published(reference: MeasureSet) -> None:
    assert {measure.id: (measure.unit, measure.traces) for measure in reference.of_kind(MeasureKind.EFFECTIVENESS)} == {
        "P_max": ("kg", ("STK-006", "STK-010", "STK-011", "STK-012")),
        "C_total": ("USD", ("STK-021", "STK-095")),
        "t_e": ("s", ("STK-095",)),
        "t_p": ("s", ("STK-006", "STK-011", "STK-012")),
        "S": ("1", ("STK-097",)),
    }


def test_the_measures_of_performance_contribute_as_published(reference: MeasureSet) -> None:
    assert {measure.id: measure.contributes_to for measure in reference.of_kind(MeasureKind.PERFORMANCE)} == {
        "P_max_m": ("P_max",),
        "v_m": ("t_e",),
        "C_m": ("C_total",),
        "P_max_g": ("P_max",),
        "M_g": ("P_max",),
        "t_gc": ("t_e",),
        "C_g": ("C_total",),
        "t_sp": ("t_p",),
        "L": ("t_e",),
        "C_al": ("C_total",),
    }


@pytest.mark.verifies("SYS-036")
def test_every_published_equation_is_realised(reference: MeasureSet) -> None:
    assert [equation.id for equation in reference.equations] == [f"4.{number}" for number in range(1, 14)]
    assert {measure.equation for measure in reference.measures} >= {equation.id for equation in reference.equations}


def test_double_counting_can_be_found(reference: MeasureSet) -> None:
    assert "t_p" in reference.dependencies("t_e")
    assert "t_p" not in reference.dependencies("t_m")


def test_measures_lead_back_to_design_parameters(reference: MeasureSet) -> None:
    assert reference.sources("t_gc") == ("design.d4",)
    assert reference.sources("P_max_g") == ("design.d1", "design.d5", "design.d6")
    assert {"design.d4", "design.d7", "trial.path_length_m"} <= {*reference.sources("t_e")}


def test_assumptions_are_found_from_a_measure(reference: MeasureSet) -> None:
    found = {assumption.id for assumption in reference.assumptions_of("P_max")}
    assert {"finger-force", "carrying-acceleration", "manipulator-payload", "object-offset"} <= found
    assert "planning-clock" not in found


def test_every_unit_is_known(reference: MeasureSet) -> None:
    for symbol in (*reference.constants, *reference.inputs, *reference.measures):
        dimension(symbol.unit)


def test_the_work_of_an_evaluation_does_not_grow_with_the_variants_before_it(reference: MeasureSet) -> None:
    """Counted in calls of functions, which no other process makes more."""
    trials = [{**TRIAL, "task_time_s": 15.0 + replicate} for replicate in range(3)]
    calls = []
    for variant in range(12):
        counted = 0

        def count(_frame: object, event: str, _argument: object) -> None:
            nonlocal counted
            counted += event == "call"

        sys.setprofile(count)
        try:
            evaluate(reference, fixed=fixed(1), trials=trials, variant=variant)
        finally:
            sys.setprofile(None)
        calls.append(counted)
    assert max(calls[1:]) <= calls[1] * 1.1
    assert calls[1] < 20_000
