"""Each way in which a trial can end early, provoked, and named in its record."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass, replace

import pytest

from rgss.evidence import Failure, PhaseOutcome, PlanOutcome, TrialRecord
from rgss.physics import World
from rgss.scenes import Cylinder, Pose
from rgss.trials import timing as timing_module
from rgss.trials.executing import execute
from rgss.trials.pieces import TrialSpec, run_trial
from rgss.trials.planning import TaskPlan, plan_task
from rgss.trials.record import assemble_record
from rgss.trials.timing import TaskTiming, time_task
from rgss.trials.workcell import Workcell
from tests.fixtures.eight_states import Phase

from .spec_changes import (
    with_body,
    with_control,
    with_cup_at,
    with_cup_of,
    with_gripper,
    with_joint,
    with_moves,
    with_place,
    with_planning,
    with_slippery_slope,
    with_task,
    with_workpiece,
)

pytestmark = pytest.mark.engine


TRIALS = {
    "a limit that no search keeps": (
        # The name that a study gives the planner is not in what trials share.
        lambda spec: replace(spec, planner="quick", planning_limit_s=0.01),
        (Failure.PLANNING_LIMIT, Phase.MOVE_TO_GRASP, r"RRT found no path in 0\.01 s \(\d+ validity checks\)"),
    ),
    "a path that touches something between the states of the search": (
        lambda spec: with_planning(spec, resolution_rad=2.0, verification_resolution_rad=0.005),
        (
            Failure.PATH_NOT_VERIFIED,
            Phase.MOVE_TO_PLACE_APPROACH,
            r"the path found after \d+ validity checks collides between states 2 rad apart",
        ),
    ),
    "a joint move past the coffee machine": (
        lambda spec: with_moves(spec, move_to_place_approach="joint"),
        (
            Failure.MOVE_BLOCKED,
            Phase.MOVE_TO_PLACE_APPROACH,
            r"the straight line of the joints is blocked at \d+ % of the way: gripper_base is .* coffee_machine, .*",
        ),
    ),
    "a straight move through the arm's own foot": (
        lambda spec: with_place(with_moves(spec, move_to_place_approach="straight"), centre_m=(-0.7, 0.3, 0.9)),
        (
            Failure.MOVE_UNREACHABLE,
            Phase.MOVE_TO_PLACE_APPROACH,
            r"the straight line of the tool ends at \d+ % of the way: the arm does not reach .*",
        ),
    ),
    "a cup out of reach": (
        lambda spec: with_cup_at(spec, 3.0, -0.3),
        (
            Failure.INVALID_START,
            Phase.MOVE_TO_GRASP,
            r"no valid configuration for grasp_approach: out of reach: 3\.\d\d m from the origin of the .*, reach .*",
        ),
    ),
    "a cup inside another body": (
        lambda spec: with_cup_at(spec, 0.72, -0.06),
        (
            Failure.INVALID_START,
            Phase.MOVE_TO_GRASP,
            r"no valid configuration for grasp_approach: collision of finger_\d with glass_rack, [\d.]+ mm deep, in .*",
        ),
    ),
    "a cup that fills the hand": (
        lambda spec: with_cup_of(spec, 0.069),
        (Failure.INVALID_GOAL, Phase.MOVE_TO_GRASP, r"no valid configuration for grasp: .*(finger|cup|gripper).*"),
    ),
    "a lift out of reach": (
        lambda spec: with_task(spec, lift_height_m=0.9),
        (Failure.UNREACHABLE_WAYPOINT, Phase.LIFT, ".* of the tool in 'lift' .*: no valid configuration .*"),
    ),
    "a place out of reach": (
        lambda spec: with_place(spec, centre_m=(-3.0, 0.7, 0.9)),
        (
            Failure.INVALID_GOAL,
            Phase.MOVE_TO_PLACE_APPROACH,
            r"no valid configuration for place_approach: out of reach: 3\.\d\d m .*",
        ),
    ),
    "a place that is taken": (
        lambda spec: with_place(spec, centre_m=(-0.03, 0.68, 0.9)),
        (Failure.INVALID_GOAL, Phase.MOVE_TO_PLACE, r"no valid configuration for place: .* menu_stand.*"),
    ),
    "a tool that hardly moves": (
        lambda spec: replace(spec, tool_speed_m_s=1e-9),
        (
            Failure.TRAJECTORY_INFEASIBLE,
            Phase.MOVE_TO_GRASP,
            r"the move would take [\d.]+e\+08 s, more than 600 s \(tool speed limit 1e-09 m/s\)",
        ),
    ),
    "fingers too weak": (
        lambda spec: with_gripper(spec, finger_force_n=0.3),
        (Failure.NO_FIRM_GRASP, Phase.GRASP, r"fingers press with [\d., ]+ N, each needs 1\.75 N"),
    ),
    "a cup narrower than the closed hand": (
        lambda spec: with_cup_of(spec, 0.018),
        (Failure.NO_FIRM_GRASP, Phase.GRASP, r"cup, 36 mm across, is too narrow .* kg-2, which closes to 44 mm"),
    ),
    "a cup too heavy to begin with": (
        lambda spec: with_workpiece(spec, mass_kg=3.0),
        (Failure.NO_FIRM_GRASP, Phase.GRASP, r"fingers press with [\d., ]+ N, each needs 21\.02 N"),
    ),
    "a cup that bears little": (
        lambda spec: with_workpiece(spec, force_limit_n=5.0),
        (Failure.OBJECT_DAMAGED, Phase.GRASP, r"a finger pressed with \d+\.\d\d N over 10 ms, above its limit of 5 N"),
    ),
    "hardly any friction": (
        lambda spec: with_gripper(spec, friction=0.13),
        (Failure.OBJECT_DROPPED, Phase.LIFT, r"the object slipped \d+\.\d mm in the gripper"),
    ),
    "no deviation allowed": (
        lambda spec: with_control(spec, largest_tracking_error_m=1e-9),
        (Failure.TRACKING_ERROR, Phase.MOVE_TO_GRASP, r"the tool was 0\.00 mm from its target"),
    ),
    "a place region of no size": (
        lambda spec: with_place(spec, radius_m=1e-7),
        (
            Failure.NOT_IN_PLACE_REGION,
            Phase.PLACE,
            r"the object is 0\.\d mm from the place and 0\.\d mm off its height, at most 0\.0001 mm each",
        ),
    ),
    "a cup released high above the place": (
        lambda spec: with_task(spec, place_clearance_m=0.25),
        (
            Failure.OBJECT_DAMAGED,
            Phase.PLACE,
            r"the object landed with 2\.2\d m/s after a drop of 25\d\.\d mm, above its limit of 1 m/s",
        ),
    ),
    "a cup that bears a fall and may be dropped": (
        lambda spec: with_place(
            with_workpiece(with_task(spec, place_clearance_m=0.25), landing_limit_m_s=10.0), largest_drop_m=1.0
        ),
        (Failure.NOT_UPRIGHT, Phase.PLACE, r"the object is tilted by \d+\.\d deg"),
    ),
    "a cup released above the place": (
        lambda spec: with_task(spec, place_clearance_m=0.03),
        (
            Failure.OBJECT_DROPPED,
            Phase.PLACE,
            r"the object was released 30\.\d mm above counter_place, at most 10 mm",
        ),
    ),
    "a cup that lands harder than above its limit of": (
        lambda spec: with_workpiece(with_task(spec, place_clearance_m=0.009), landing_limit_m_s=0.3),
        (
            Failure.OBJECT_DAMAGED,
            Phase.PLACE,
            r"the object landed with 0\.\d\d m/s after a drop of 9\.0 mm, above its limit of 0\.3 m/s",
        ),
    ),
}


@pytest.mark.parametrize("name", TRIALS)
def test_a_trial_names_its_failure(spec_of, name):
    change, (failure, phase, detail) = TRIALS[name]
    record = run_trial(change(spec_of()))

    assert (record.failure, record.failed_phase) == (failure, phase)
    assert re.fullmatch(detail, record.failure_detail)
    agrees_with_its_phases(record)


def agrees_with_its_phases(record: TrialRecord) -> None:
    done = list(Phase).index(record.failed_phase)
    assert not record.success
    assert record.metrics["success"] == 0
    assert record.metrics["phases_completed"] == done
    assert record.metrics["task_time_s"] is None
    assert record.phases[done].outcome is PhaseOutcome.FAILED
    assert {phase.outcome for phase in record.phases[:done]} <= {PhaseOutcome.COMPLETED}
    assert {phase.outcome for phase in record.phases[done + 1 :]} <= {PhaseOutcome.NOT_RUN}


@dataclass(frozen=True, kw_only=True)
class Planned:
    """A trial that is planned and timed, and goes on in another world than it was planned for."""

    spec: TrialSpec
    cell: Workcell
    plan: TaskPlan
    timing: TaskTiming

    def run_in(self, spec):
        return assemble_record(spec, self.plan, self.timing.failures, execute(spec, self.cell, self.timing))

    def timed_in(self, spec):
        planning = spec.settings.planning
        cell = Workcell(spec.scene, spec.gripper.geometry, clearance_m=planning.clearance_m, task=spec.task)
        return time_task(cell, self.plan, tool_speed_m_s=spec.tool_speed_m_s, settings=planning)


@pytest.fixture(scope="module")
def planned(spec_of):
    planning = (spec := spec_of()).settings.planning
    cell = Workcell(spec.scene, spec.gripper.geometry, clearance_m=planning.clearance_m, task=spec.task)
    plan = plan_task(cell, spec.planner, seed=spec.seed, settings=planning)
    timing = time_task(cell, plan, tool_speed_m_s=spec.tool_speed_m_s, settings=planning)
    return Planned(spec=spec, cell=cell, plan=plan, timing=timing)


def with_tall_cup(spec):
    return with_workpiece(spec, shape=Cylinder(radius_m=0.035, height_m=0.16), pose=Pose(position_m=(0.7, -0.3, 0.98)))


UNFORESEEN = {
    "a bar over the cup": (
        lambda spec: with_body(spec, (0.3, 0.02, 0.02), (0.70, -0.30, 1.03)),
        (Failure.ARM_COLLISION, Phase.MOVE_TO_GRASP, r"finger_\d touched obstacle"),
    ),
    "a saucer on the place": (
        lambda spec: with_body(spec, (0.1, 0.1, 0.02), (-0.25, 0.70, 0.91)),
        (Failure.OBJECT_COLLISION, Phase.MOVE_TO_PLACE, "the object touched obstacle"),
    ),
    "a taller cup": (
        with_tall_cup,
        (Failure.OBJECT_COLLISION, Phase.MOVE_TO_GRASP, r"gripper_base pressed the object with \d+\.\d\d N"),
    ),
    "a cup under the finger": (
        lambda spec: with_cup_at(spec, 0.74, -0.3),
        (
            Failure.OBJECT_DAMAGED,
            Phase.MOVE_TO_GRASP,
            r"a finger pressed with \d+\.\d\d N over 10 ms, above its limit of 40 N",
        ),
    ),
    "a place that is not where it was": (
        lambda spec: with_place(spec, centre_m=(-0.25, 0.64, 0.9)),
        (
            Failure.NOT_IN_PLACE_REGION,
            Phase.PLACE,
            r"the object is 60\.\d mm from the place and 0\.\d mm off its height, at most 40 mm each",
        ),
    ),
    "a counter that slopes and is slippery": (
        # What slides down along a finger and leans on it may count as dragged by it, so it may be.
        lambda spec: with_place(with_slippery_slope(spec, math.radians(3.0)), largest_drag_m=1.0),
        (Failure.NOT_RELEASED, Phase.PLACE, "1 fingers still touch the object"),
    ),
    "a shoulder too weak for its own arm": (
        lambda spec: with_joint(spec, "shoulder_lift_joint", 60.0),
        (
            Failure.TRACKING_ERROR,
            Phase.MOVE_TO_GRASP,
            r"the tool was \d+\.\d\d mm from its target; at its torque limit: shoulder_lift_joint.*",
        ),
    ),
    "a cup that does not stay where it was": (
        lambda spec: with_workpiece(spec, pose=spec.scene.workpiece.pose.raised(0.008)),
        (Failure.OBJECT_DROPPED, Phase.MOVE_TO_GRASP, r"the object fell by itself: 8\.\d mm before the grasp"),
    ),
    "a cup that topples by itself": (
        lambda spec: with_workpiece(
            spec,
            pose=spec.scene.workpiece.pose.raised(0.02) @ Pose.from_roll_pitch_yaw((0.0, 0.0, 0.0), (0.9, 0.0, 0.0)),
        ),
        (
            Failure.NOT_UPRIGHT,
            Phase.MOVE_TO_GRASP,
            r"the object toppled by itself: it is tilted by 9\d° and moved [\d.]+ mm .*",
        ),
    ),
}


@pytest.mark.verifies("SYS-003")
@pytest.mark.parametrize("name", UNFORESEEN)
def test_what_planning_did_not_know_ends_the_trial(planned, name):
    change, (failure, phase, detail) = UNFORESEEN[name]
    record = planned.run_in(change(planned.spec))

    assert (record.failure, record.failed_phase) == (failure, phase)
    assert re.fullmatch(detail, record.failure_detail)
    agrees_with_its_phases(record)
    assert (record.metrics["arm_scene_contacts"] > 0) is (failure is Failure.ARM_COLLISION)


def test_every_failure_of_a_trial_is_produced_here():
    produced = {failure for _, (failure, _, _) in (*TRIALS.values(), *UNFORESEEN.values())}
    # The next test; tasks with checks (objects/test_checks.py) and a time limit (test_task_time.py); a run that broke.
    elsewhere = {Failure.TRAJECTORY_IN_COLLISION, Failure.CHECK_FAILED, Failure.TASK_TIME_LIMIT, Failure.RUN_CRASHED}

    assert produced | elsewhere == set(Failure)
    assert not produced & elsewhere


@pytest.mark.verifies("SYS-016")
def test_a_success_says_which_joint_was_at_its_limit(planned):
    whole = planned.run_in(planned.spec)
    needed = whole.metrics["peak_joint_torque_n_m"]
    joints = [joint.name for joint in planned.spec.scene.robot.joints]
    lift = joints.index("shoulder_lift_joint")
    assert whole.metrics["joint_saturated_s"] == (0.0,) * 6
    assert whole.metrics["most_loaded_joint"] == lift + 1

    # So little less than the peak that the arm lags by less than a trial allows.
    record = planned.run_in(with_joint(planned.spec, "shoulder_lift_joint", 0.999 * needed[lift]))
    assert record.success
    saturated = record.metrics["joint_saturated_s"]
    assert saturated[lift] > 0.0
    assert sum(saturated) == saturated[lift]
    assert record.metrics["peak_joint_torque_n_m"][lift] == pytest.approx(0.999 * needed[lift])
    assert record.metrics["peak_joint_torque_ratio"] == pytest.approx(1.0)
    assert record.metrics["most_loaded_joint"] == lift + 1


@pytest.mark.verifies("SYS-034")
def test_what_runs_is_itself_checked(planned):
    spec = with_body(planned.spec, (0.1, 0.1, 0.02), (-0.25, 0.70, 0.91))
    timing = planned.timed_in(spec)

    assert timing.failures == {
        Phase.MOVE_TO_PLACE: (
            Failure.TRAJECTORY_IN_COLLISION,
            "the timed motion collides, although the path does not",
        )
    }
    record = assemble_record(spec, planned.plan, timing.failures, execute(spec, planned.cell, timing))
    assert (record.failure, record.failed_phase) == (Failure.TRAJECTORY_IN_COLLISION, Phase.MOVE_TO_PLACE)
    assert record.planning[3].outcome is PlanOutcome.SOLVED
    agrees_with_its_phases(record)


def test_a_motion_that_keeps_no_limits_is_named(planned, monkeypatch):
    real = timing_module.time_move

    def infeasible(*arguments, **options):
        timed = real(*arguments, **options)
        return replace(timed, outcome=timing_module.TimingOutcome.INFEASIBLE, trajectory=None)

    monkeypatch.setattr(timing_module, "time_move", infeasible)
    timing = planned.timed_in(planned.spec)

    assert not timing.trajectories
    assert set(timing.failures.values()) == {
        (Failure.TRAJECTORY_INFEASIBLE, "no motion along the path satisfies the limits of joints and tool")
    }
    assert execute(planned.spec, planned.cell, timing) == ()


class StuckWorld(World):
    """The fingers stop two millimetres before they are open."""

    def finger_travel_m(self):
        return tuple(max(travel, 0.002) for travel in super().finger_travel_m())


class StickyWorld(World):
    """A finger keeps touching the object once the hand has opened."""

    _opened = 0

    def hold_open(self):
        self._opened += 1
        super().hold_open()

    def contacts(self, standing=None):
        contacts = super().contacts(standing)
        return contacts._replace(finger_forces_n=(0.1, 0.0)) if self._opened > 1 else contacts


@pytest.mark.verifies("SYS-008")
@pytest.mark.parametrize(
    ("world", "detail"),
    [(StuckWorld, "a finger is still 2.0 mm from open"), (StickyWorld, "1 fingers still touch the object")],
)
def test_a_hand_that_does_not_let_go_is_named(planned, monkeypatch, world, detail):
    monkeypatch.setattr("rgss.physics.opening.World", world)
    record = planned.run_in(planned.spec)

    assert (record.failure, record.failed_phase) == (Failure.NOT_RELEASED, Phase.PLACE)
    assert record.failure_detail == detail
    agrees_with_its_phases(record)
