"""A record put together from pieces made by hand."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rgss.evidence import Failure, PhaseOutcome, PlanOutcome, record_from_json, record_to_json
from rgss.motion import PlanningClock
from rgss.trials.metrics import METRICS
from rgss.trials.phase_result import PhaseResult
from rgss.trials.planning import PlannedMove, TaskPlan
from rgss.trials.record import assemble_record
from tests.fixtures.eight_states import PLANNED_PHASES, Phase

CHARGE_S = 0.001
CLOCK = PlanningClock(charge_s=CHARGE_S)
PHASES = tuple(Phase)
CARRYING = PHASES[2:6]
ILL_POSED = {
    PlanOutcome.INVALID_START: Failure.INVALID_START,
    PlanOutcome.INVALID_GOAL: Failure.INVALID_GOAL,
}


def move(phase, checks=1000, **changes):
    values = {
        "phase": phase,
        "outcome": PlanOutcome.SOLVED,
        "checks": checks,
        "simplification_checks": 500,
        "search_time_s": checks * CHARGE_S,
        "time_s": (checks + 500) * CHARGE_S,
        "path_rad": np.zeros((2, 6)),
        "path_length_m": 0.5,
    }
    return PlannedMove(**(values | changes))


def plan_of(*checks, **changes):
    moves = {phase: move(phase, count) for phase, count in zip(PLANNED_PHASES, checks, strict=False)}
    for name, change in changes.items():
        moves[Phase(name)] = change
    return TaskPlan(moves=moves, direct={"lift": np.zeros((2, 6))}, clock=CLOCK)


def result(phase, **changes):
    """A phase that lasts a second and has the largest metrics in the sixth phase, the smallest margin in the third."""
    number = PHASES.index(phase) + 1
    metrics = {
        "arm_scene_contacts": 0,
        "sensed_finger_force_n": 0.5 * number,
        "peak_finger_force_n": float(number),
        "peak_joint_torque_ratio": 0.1 * number,
        "tracking_error_m": 1e-4 / number,
        "slip_m": 1e-3 * number if phase in CARRYING else None,
        "grip_margin_min": float(number) if phase in CARRYING else None,
        "peak_tool_speed_m_s": 1.0 / number,
        "peak_tool_acceleration_m_s2": float(number == 4),
    }
    metrics |= {
        "peak_joint_torque_n_m": (float(number), 5.0, 5.0, 5.0, 5.0, 1.0 / number),
        "joint_saturated_s": (0.0, 0.0, 0.0, 0.0, 0.0, 0.25),
        "most_loaded_joint": number,
    }
    if phase == Phase.GRASP or phase in CARRYING:
        metrics |= {"grasp_q_msv_1": float(number), "held_distance_m": 1e-4 * number, "contacts_slipping": number}
    if phase in CARRYING:
        metrics |= {"grasp_samples": 10, "grasp_samples_closed": 9}
    if phase == Phase.PLACE:
        metrics |= {"opening_s": 0.25, "place_error_m": 0.9, "place_tilt_rad": 0.8}
    if phase == Phase.MOVE_TO_GRASP_APPROACH:
        metrics |= {"place_error_m": 0.002, "place_tilt_rad": 0.001}
    values = {"phase": phase, "failure": None, "detail": "", "duration_s": 1.0 + number, "metrics": metrics}
    return PhaseResult(**(values | changes))


EXECUTION = tuple(result(phase) for phase in PHASES)


@pytest.fixture
def spec(spec_of):
    return replace(spec_of(65, 7), planning_limit_s=2.0)


def test_success(spec):
    record = assemble_record(spec, plan_of(1000, 1100, 1200, 1300, 2000), {}, EXECUTION)

    assert (record.variant, record.seed, record.fidelity) == (65, 7, spec.fidelity)
    assert (record.success, record.failure, record.failed_phase, record.failure_detail) == (True, None, None, "")
    assert [phase.phase for phase in record.phases] == list(PHASES)
    assert {phase.outcome for phase in record.phases} == {PhaseOutcome.COMPLETED}
    assert [planning.subtask for planning in record.planning] == list(PLANNED_PHASES)
    assert record_from_json(record_to_json(record)) == record


def test_metrics_of_a_success(spec):
    metrics = assemble_record(spec, plan_of(1000, 1100, 1200, 1300, 2000), {}, EXECUTION).metrics

    motion_s = sum(range(2, 10))
    assert metrics["success"] == 1
    assert (metrics["phases_completed"], metrics["phases_total"]) == (8, 8)
    assert metrics["planning_checks"] == (1000, 1100, 1200, 1300, 2000)
    assert metrics["planning_time_s"] == pytest.approx((1.5, 1.6, 1.7, 1.8, 2.5))
    assert metrics["path_length_m"] == (0.5,) * 5
    assert metrics["motion_time_s"] == motion_s
    assert metrics["task_time_s"] == metrics["attempt_time_s"] == pytest.approx(motion_s + 9.1)
    assert metrics["grasp_cycle_time_s"] == 3.0 + 0.25
    assert metrics["sensed_finger_force_n"] == 4.0
    assert metrics["peak_finger_force_n"] == 8.0
    assert metrics["peak_joint_torque_ratio"] == pytest.approx(0.8)
    assert metrics["tracking_error_m"] == 1e-4
    assert metrics["slip_m"] == pytest.approx(6e-3)
    assert metrics["grip_margin_min"] == 3.0
    assert metrics["peak_tool_speed_m_s"] == 1.0
    assert metrics["peak_tool_acceleration_m_s2"] == 1.0
    assert metrics["arm_scene_contacts"] == 0
    # Where the object stands is told by the last phase that looked.
    assert (metrics["place_error_m"], metrics["place_tilt_rad"]) == (0.002, 0.001)


@pytest.mark.parametrize(
    ("checks", "execution"),
    [
        ((1000,) * 5, EXECUTION),
        ((1000,) * 5, (result(Phase.MOVE_TO_GRASP, failure=Failure.ARM_COLLISION, detail="x"),)),
        ((9000,), ()),
    ],
    ids=["success", "failure", "no path"],
)
def test_every_metric_is_named_with_its_length(spec, checks, execution):
    metrics = assemble_record(spec, plan_of(*checks), {}, execution).metrics

    assert set(metrics) == set(METRICS)
    for name, kind in METRICS.items():
        assert (
            (length := kind.length_in_trial(planned=5, joints=6)) is None
            or metrics[name] is None
            or len(metrics[name]) == length
        )


def test_the_load_of_each_joint_is_that_of_all_phases(spec):
    metrics = assemble_record(spec, plan_of(*(1000,) * 5), {}, EXECUTION).metrics

    # The torque of the first joint grows from phase to phase, that of the last falls.
    assert metrics["peak_joint_torque_n_m"] == (8.0, 5.0, 5.0, 5.0, 5.0, 1.0)
    assert metrics["joint_saturated_s"] == (0.0, 0.0, 0.0, 0.0, 0.0, 2.0)
    # The greatest ratio is that of the last phase.
    assert metrics["most_loaded_joint"] == 8
    assert metrics["governing_joint"] is None  # No phase observed its utilisation.


def test_the_grasp_is_at_its_worst_over_the_carry_and_as_it_was_closed(spec):
    metrics = assemble_record(spec, plan_of(*(1000,) * 5), {}, EXECUTION).metrics

    # Phases 3 to 6 carry; the grasp itself, phase 2, would be the worst of all.
    assert metrics["grasp_q_msv_1"] == 3.0
    assert metrics["held_distance_m"] == pytest.approx(6e-4)
    assert metrics["contacts_slipping"] == 6
    assert (metrics["grasp_samples"], metrics["grasp_force_closure_share_1"]) == (40, pytest.approx(36 / 40))
    assert (metrics["at_grasp_q_msv_1"], metrics["at_grasp_contacts_slipping"]) == (2.0, 2)
    assert metrics["grasp_q_gpri_1"] is metrics["at_grasp_q_gpri_1"] is None


def test_a_trial_that_never_carried_knows_nothing_of_the_carry(spec):
    metrics = assemble_record(spec, plan_of(9000), {}, ()).metrics
    assert metrics["at_grasp_q_msv_1"] is metrics["joint_saturated_s"] is metrics["most_loaded_joint"] is None

    failed = result(Phase.LIFT, failure=Failure.ARM_COLLISION, detail="x", metrics={})
    metrics = assemble_record(spec, plan_of(*(1000,) * 5), {}, (*EXECUTION[:2], failed)).metrics
    assert metrics["at_grasp_q_msv_1"] == 2.0
    assert metrics["grasp_q_msv_1"] is metrics["grasp_samples"] is metrics["grasp_force_closure_share_1"] is None


def test_a_limit_cuts_the_trial_before_the_move_that_comes_too_late(spec):
    record = assemble_record(spec, plan_of(1000, 1000, 2001, 1000, 1000), {}, EXECUTION)

    assert (record.failure, record.failed_phase) == (Failure.PLANNING_LIMIT, Phase.MOVE_TO_PLACE_APPROACH)
    assert record.failure_detail == f"{spec.planner} found no path in 2 s (2000 validity checks)"
    assert [phase.outcome.value for phase in record.phases] == ["completed"] * 4 + ["failed"] + ["not_run"] * 3
    assert [planning.outcome.value for planning in record.planning] == [
        "solved",
        "solved",
        "budget_spent",
        "not_run",
        "not_run",
    ]
    assert record.metrics["planning_time_s"] == (1.5, 1.5, 2.0, None, None)
    assert record.metrics["planning_checks"] == (1000, 1000, 2000, None, None)
    assert record.metrics["path_length_m"] == (0.5, 0.5, None, None, None)
    assert record.metrics["motion_time_s"] == 2 + 3 + 4 + 5
    assert record.metrics["task_time_s"] is None
    planning_s = sum(one.time_s for one in record.planning if one.time_s is not None)
    assert record.metrics["attempt_time_s"] == pytest.approx(2 + 3 + 4 + 5 + planning_s)
    assert record.metrics["grasp_cycle_time_s"] is None
    assert record.metrics["phases_completed"] == 4
    assert record.metrics["peak_finger_force_n"] == 4.0
    assert record.metrics["place_error_m"] is None


def test_the_limit_itself_is_within_the_limit(spec):
    plan = plan_of(1000, 1000, 2000, 1000, 1000)

    assert assemble_record(spec, plan, {}, EXECUTION).success
    late = assemble_record(replace(spec, planning_limit_s=2.0 - 1e-6), plan, {}, EXECUTION)
    assert (late.failure, late.planning[2].checks) == (Failure.PLANNING_LIMIT, 1999)


@pytest.mark.verifies("SYS-023")
def test_phases_before_the_cut_are_those_of_the_whole_trial(spec):
    whole = assemble_record(spec, plan_of(1000, 1000, 1000, 1000, 1000), {}, EXECUTION)
    cut = assemble_record(spec, plan_of(1000, 1000, 1000, 3000, 1000), {}, EXECUTION)

    assert cut.phases[:5] == whole.phases[:5]
    assert cut.planning[:3] == whole.planning[:3]
    assert all(phase.duration_s is None and phase.metrics == {} for phase in cut.phases[5:])


@pytest.mark.parametrize(("outcome", "failure"), ILL_POSED.items())
@pytest.mark.parametrize("index", range(5))
def test_an_ill_posed_problem_says_what_stands_in_the_way(spec, outcome, failure, index):
    phase = PLANNED_PHASES[index]
    stuck = move(phase, 0, outcome=outcome, path_rad=None, path_length_m=None, time_s=0.0, detail="no way to the cup")
    plan = plan_of(*(1000,) * index, **{phase.value: stuck})
    record = assemble_record(spec, plan, {}, EXECUTION[: PHASES.index(phase)])

    assert (record.failure, record.failed_phase) == (failure, phase)
    assert record.failure_detail == "no way to the cup"
    assert record.planning[index].outcome is outcome


@pytest.mark.parametrize(
    ("limit_s", "outcome", "failure", "detail"),
    [
        (4.0, PlanOutcome.NOT_VERIFIED, Failure.PATH_NOT_VERIFIED, "it touches something"),
        (2.0, PlanOutcome.BUDGET_SPENT, Failure.PLANNING_LIMIT, "found no path in 2 s (2000 validity checks)"),
    ],
)
def test_a_path_that_is_not_verified_is_no_planning_limit_unless_it_came_too_late(
    spec, limit_s, outcome, failure, detail
):
    phase = PLANNED_PHASES[1]
    touching = move(
        phase,
        3000,
        outcome=PlanOutcome.NOT_VERIFIED,
        path_rad=None,
        path_length_m=None,
        time_s=3.0,
        detail="it touches something",
    )
    record = assemble_record(
        replace(spec, planning_limit_s=limit_s), plan_of(1000, **{phase.value: touching}), {}, EXECUTION[:3]
    )

    assert (record.failure, record.failed_phase) == (failure, phase)
    assert record.failure_detail.endswith(detail)
    assert record.planning[1].outcome is outcome
    assert record.planning[1].time_s == min(limit_s, 3.0)
    assert record_from_json(record_to_json(record)) == record


@pytest.mark.parametrize("phase", [*PLANNED_PHASES, Phase.LIFT])
@pytest.mark.parametrize(
    "failure", [Failure.TRAJECTORY_IN_COLLISION, Failure.TRAJECTORY_INFEASIBLE, Failure.UNREACHABLE_WAYPOINT]
)
def test_a_move_that_cannot_be_timed_is_not_run(spec, phase, failure):
    before = EXECUTION[: PHASES.index(phase)]
    record = assemble_record(spec, plan_of(*(1000,) * 5), {phase: (failure, "cannot be timed")}, before)

    assert (record.failure, record.failed_phase, record.failure_detail) == (failure, phase, "cannot be timed")
    assert record.metrics["phases_completed"] == len(before)
    assert record.phases[len(before)].duration_s is None
    if phase in PLANNED_PHASES:
        assert record.planning[PLANNED_PHASES.index(phase)].outcome is PlanOutcome.SOLVED


def test_a_search_that_came_too_late_hides_what_would_have_come_of_its_path(spec):
    failures = {Phase.MOVE_TO_PLACE: (Failure.TRAJECTORY_INFEASIBLE, "cannot be timed")}
    record = assemble_record(spec, plan_of(1000, 1000, 1000, 9000), failures, EXECUTION[:5])

    assert record.failure is Failure.PLANNING_LIMIT


@pytest.mark.parametrize("phase", PHASES)
def test_a_phase_that_fails_in_physics_ends_the_trial(spec, phase):
    failed = result(phase, failure=Failure.OBJECT_COLLISION, detail="the object touched shelf", duration_s=0.5)
    record = assemble_record(spec, plan_of(*(1000,) * 5), {}, (*EXECUTION[: PHASES.index(phase)], failed))

    assert (record.failure, record.failed_phase) == (Failure.OBJECT_COLLISION, phase)
    assert record.failure_detail == "the object touched shelf"
    assert record.phases[PHASES.index(phase)].duration_s == 0.5
    assert record.metrics["phases_completed"] == PHASES.index(phase)
    assert record.metrics["peak_finger_force_n"] == PHASES.index(phase) + 1
    planned = [planning.outcome for planning in record.planning]
    begun = sum(PHASES.index(other) <= PHASES.index(phase) for other in PLANNED_PHASES)
    assert planned == [PlanOutcome.SOLVED] * begun + [PlanOutcome.NOT_RUN] * (5 - begun)


def test_a_grasp_that_was_never_opened_has_no_cycle(spec):
    failed = result(Phase.PLACE, failure=Failure.NOT_UPRIGHT, detail="x")
    complete = assemble_record(spec, plan_of(*(1000,) * 5), {}, (*EXECUTION[:6], failed))
    dropped = replace(failed, metrics={})
    without = assemble_record(spec, plan_of(*(1000,) * 5), {}, (*EXECUTION[:6], dropped))

    assert complete.metrics["grasp_cycle_time_s"] == 3.25
    assert without.metrics["grasp_cycle_time_s"] is None


def test_contacts_are_summed_over_the_phases(spec):
    touching = [replace(each, metrics={**each.metrics, "arm_scene_contacts": 2}) for each in EXECUTION]

    assert assemble_record(spec, plan_of(*(1000,) * 5), {}, touching).metrics["arm_scene_contacts"] == 16


@given(
    checks=st.lists(st.integers(0, 4000), min_size=5, max_size=5),
    limit=st.integers(0, 4000),
    untimed=st.sets(st.sampled_from([*PLANNED_PHASES, Phase.LIFT]), max_size=2),
    broken=st.none() | st.sampled_from(PHASES),
)
def test_exactly_one_phase_fails_and_nothing_runs_after_it(whole_spec, checks, limit, untimed, broken):
    failures = dict.fromkeys(untimed, (Failure.TRAJECTORY_INFEASIBLE, "x"))
    ran = []
    for phase in PHASES:
        if phase in untimed:
            break
        ran.append(result(phase, failure=Failure.ARM_COLLISION, detail="y") if phase is broken else result(phase))
        if phase is broken:
            break
    spec = replace(whole_spec, planning_limit_s=limit * CHARGE_S)
    record = assemble_record(spec, plan_of(*checks), failures, ran)

    outcomes = [phase.outcome.value for phase in record.phases]
    completed = outcomes.count("completed")
    failed = 0 if record.success else 1
    assert outcomes == ["completed"] * completed + ["failed"] * failed + ["not_run"] * (8 - completed - failed)
    assert record.success is (completed == 8)
    assert (record.failure is None) is record.success
    assert bool(record.failure_detail) is not record.success
    assert record.failed_phase == (None if record.success else PHASES[completed])
    late = [count > limit for count in checks]
    if record.failure is Failure.PLANNING_LIMIT:
        assert record.failed_phase == PLANNED_PHASES[late.index(True)]
    spent = [planning.time_s for planning in record.planning if planning.outcome is PlanOutcome.BUDGET_SPENT]
    assert len(spent) <= 1
    assert all(math.isclose(time_s, limit * CHARGE_S) for time_s in spent)


@pytest.fixture(scope="session")
def whole_spec(spec_of):
    return spec_of(65, 7)
