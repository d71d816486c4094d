"""Moves without a search: what runs, what it is charged, and how each of them fails."""

from __future__ import annotations

import itertools
import math
from dataclasses import replace

import numpy as np
import pytest

from rgss.evidence import Failure, Fidelity, PlanOutcome
from rgss.kinematics import inverse_kinematics
from rgss.motion import ClockKind, PlanningClock
from rgss.scenes import Waypoint, waypoint_poses
from rgss.tasks import MoveKind, load_task
from rgss.trials.pieces import Pieces
from rgss.trials.pieces.plan_json import plan_from_json, plan_to_json
from rgss.trials.planning import direct_move, plan_of
from rgss.trials.workcell import cell_of
from tests.fixtures.eight_states import PLANNED_PHASES, Phase

from .spec_changes import with_moves

pytestmark = pytest.mark.engine

RESOLUTION_RAD = 0.01
TASK = """task: transfer
start: {{to: grasp_approach}}
steps:
  - move: {{to: grasp}}
  - grip: {{}}
  - move: {{to: lift, mode: straight}}
  - move: {{to: grasp_departure}}
  - move: {{to: place_approach, mode: {transfer}}}
  - move: {{to: place}}
  - release: {{}}
  - move: {{name: return, to: grasp_approach, mode: {back}}}
"""


@pytest.fixture(scope="module")
def reference(spec_of):
    return replace(spec_of(28), fidelity=Fidelity.KINEMATIC)


@pytest.fixture(scope="module")
def planned(reference):
    return plan_of(reference)


def distances_from_line(points, start, end):
    along = (end - start) / np.linalg.norm(end - start)
    offset = points - start
    return np.linalg.norm(offset - (offset @ along)[:, None] * along, axis=1)


def test_the_tool_of_a_straight_move_stays_on_its_line_and_is_charged_for_every_check(reference, planned):
    made = plan_of(with_moves(reference, move_to_place="straight"))
    move, cell = made.moves[Phase.MOVE_TO_PLACE], cell_of(reference)
    tool = cell.arm.tool_position(move.path_rad)

    assert move.outcome is PlanOutcome.SOLVED
    assert distances_from_line(tool, tool[0], tool[-1]).max() < 1e-6
    assert move.path_length_m == pytest.approx(float(np.linalg.norm(tool[-1] - tool[0])), rel=1e-3)
    # Every state of the path at the planning resolution, its start included.
    steps = [max(1, math.ceil(np.linalg.norm(b - a) / RESOLUTION_RAD)) for a, b in itertools.pairwise(move.path_rad)]
    assert move.checks == 1 + sum(steps)
    assert move.time_s == move.search_time_s == pytest.approx(move.checks * 0.25e-3)
    # It begins and ends where the planned moves beside it do.
    assert np.array_equal(move.path_rad[0], planned.moves[Phase.MOVE_TO_PLACE].path_rad[0])
    assert np.array_equal(move.path_rad[-1], planned.moves[Phase.MOVE_TO_PLACE].path_rad[-1])


def test_a_joint_move_is_one_straight_motion_of_the_joints(reference, planned):
    made = plan_of(with_moves(reference, move_to_grasp="joint"))
    move, was = made.moves[Phase.MOVE_TO_GRASP], planned.moves[Phase.MOVE_TO_GRASP]

    assert np.array_equal(move.path_rad, was.path_rad[[0, -1]])
    assert move.simplification_checks == 0
    assert move.path_length_m <= was.path_length_m + 1e-9


def test_the_other_moves_are_the_same_bit_for_bit(reference, planned):
    made = plan_of(with_moves(reference, move_to_grasp="straight", move_to_grasp_departure="joint"))

    for phase in PLANNED_PHASES[2:]:
        one, other = made.moves[phase], planned.moves[phase]
        assert np.array_equal(one.path_rad, other.path_rad)
        assert (one.checks, one.time_s) == (other.checks, other.time_s)
    assert np.array_equal(made.direct["lift"], planned.direct["lift"])


def test_a_trial_with_straight_moves_keeps_the_tool_speed_and_plans_sooner(reference):
    pieces = Pieces()
    kinds = dict.fromkeys(("move_to_grasp", "move_to_grasp_departure", "move_to_place"), "straight")

    was, record = pieces.record(reference), pieces.record(with_moves(reference, **kinds))

    assert (was.success, record.success) == (True, True)
    assert record.metrics["peak_tool_speed_m_s"] <= reference.tool_speed_m_s * 1.01
    assert sum(record.metrics["planning_time_s"]) < sum(was.metrics["planning_time_s"])
    assert sum(record.metrics["path_length_m"]) < sum(was.metrics["path_length_m"])


@pytest.mark.parametrize(
    ("phase", "kind", "detail"),
    [
        (
            "move_to_grasp_approach",
            "straight",
            (
                "the straight line of the tool is blocked at 16 % of the way: "
                "finger_1 is 7.4 mm from menu_stand, 8 mm must be kept"
            ),
        ),
        (
            "move_to_place_approach",
            "joint",
            (
                "the straight line of the joints is blocked at 44 % of the way: "
                "gripper_base is 3.0 mm from coffee_machine, 8 mm must be kept"
            ),
        ),
    ],
)
def test_a_blocked_move_ends_the_trial_and_says_where_and_by_what(reference, phase, kind, detail):
    spec = with_moves(reference, **{phase: kind})
    record = Pieces().record(spec)
    move = next(one for one in record.planning if one.subtask == Phase(phase))

    assert (record.failure, record.failed_phase) == (Failure.MOVE_BLOCKED, Phase(phase))
    assert record.failure_detail == detail
    assert move.outcome is PlanOutcome.MOVE_BLOCKED
    assert 0 < move.checks < 400
    assert move.time_s == pytest.approx(move.checks * 0.25e-3)
    assert record.metrics["attempt_time_s"] > 0.0
    again = plan_from_json(plan_to_json(plan_of(spec)))
    assert again.moves[Phase(phase)].detail == detail


@pytest.mark.parametrize(
    ("transfer", "back", "phase", "detail"),
    [
        (
            "joint",
            "planned",
            "move_to_place_approach",
            "the straight line of the joints is blocked at 44 % of the way: gripper_base is 3.0 mm from coffee_machine",
        ),
        (
            "planned",
            "straight",
            "return",
            "the straight line of the tool is blocked at 16 % of the way: finger_1 is 7.4 mm from menu_stand",
        ),
    ],
)
def test_a_direct_move_of_the_task_says_where_it_is_blocked_and_by_what(
    reference, tmp_path, transfer, back, phase, detail
):
    path = tmp_path / "task.yaml"
    path.write_text(TASK.format(transfer=transfer, back=back), encoding="utf-8")

    planning = replace(reference.settings.planning, moves=())
    spec = replace(reference, settings=replace(reference.settings, planning=planning), task=load_task(path).program)
    record = Pieces().record(spec)

    assert (record.failed_phase, record.failure) == (phase, Failure.MOVE_BLOCKED)
    assert record.failure_detail == f"{detail}, 8 mm must be kept"


def test_a_limit_that_the_check_does_not_keep_is_the_planning_limit(reference):
    spec = replace(with_moves(reference, move_to_grasp="straight"), planning_limit_s=0.005)

    record = Pieces().record(spec)

    assert record.failure is Failure.PLANNING_LIMIT
    assert record.planning[0].time_s == pytest.approx(0.005)


class Ends:
    """A move of the reference task with its models."""

    def __init__(self, spec, planned):
        self.cell = cell_of(spec)
        self.inverse = inverse_kinematics(self.cell.arm)
        self.poses = waypoint_poses(self.cell.scene)
        self.start, self.goal = planned.moves[Phase.MOVE_TO_GRASP].path_rad[[0, -1]]

    def move(self, kind=MoveKind.STRAIGHT, *, goal=None, pose=None, limit_s=8.0, clock=None):
        return direct_move(
            kind,
            self.start,
            self.goal if goal is None else goal,
            pose or self.poses[Waypoint.GRASP],
            inverse=self.inverse,
            model=self.cell.planning[Phase.MOVE_TO_GRASP],
            clock=clock or PlanningClock(charge_s=0.25e-3),
            resolution_rad=RESOLUTION_RAD,
            limit_s=limit_s,
        )


@pytest.fixture(scope="module")
def ends(reference, planned):
    return Ends(reference, planned)


def test_a_line_beyond_the_reach_is_unreachable_and_says_how_far_it_is_followed(ends):
    away = replace(ends.poses[Waypoint.GRASP_APPROACH], position_m=(2.5, -0.9, 1.6))

    found = ends.move(pose=away)

    assert found.outcome in (PlanOutcome.MOVE_UNREACHABLE, PlanOutcome.MOVE_BLOCKED)
    upwards = ends.poses[Waypoint.GRASP_APPROACH].raised(2.0)
    found = ends.move(pose=upwards)
    assert found.outcome is PlanOutcome.MOVE_UNREACHABLE
    assert "the straight line of the tool ends at " in found.detail
    assert found.detail.endswith("does not reach the tool's pose within the ranges of its joints")
    assert found.path_rad is None
    assert found.checks > 0


def test_a_line_that_ends_in_another_configuration_is_unreachable(ends):
    another = ends.goal.copy()
    another[5] -= 2 * math.pi

    found = ends.move(goal=another)

    assert found.outcome is PlanOutcome.MOVE_UNREACHABLE
    assert found.detail == (
        "the straight line of the tool ends in a configuration of the arm that differs from the start of the next move"
    )


def test_a_joint_that_would_leave_its_range_blocks_a_joint_move(ends):
    beyond = ends.goal.copy()
    beyond[5] = ends.cell.arm.upper_rad[5] + 0.5

    found = ends.move(MoveKind.JOINT, goal=beyond)

    assert found.outcome is PlanOutcome.MOVE_BLOCKED
    assert "is blocked at " in found.detail


def test_the_wall_clock_measures_the_check(ends):
    found = ends.move(clock=PlanningClock(kind=ClockKind.WALL), limit_s=1e6)

    assert found.outcome is PlanOutcome.SOLVED
    assert 0.0 < found.time_s < 1e6
    assert ends.move(clock=PlanningClock(kind=ClockKind.WALL), limit_s=0.0).outcome is PlanOutcome.BUDGET_SPENT


def test_a_counted_limit_ends_the_check_where_it_is_spent(ends):
    whole = ends.move()

    found = ends.move(limit_s=10 * 0.25e-3)

    assert (found.outcome, found.checks, found.path_rad) == (PlanOutcome.BUDGET_SPENT, 10, None)
    assert ends.move(limit_s=whole.checks * 0.25e-3).outcome is PlanOutcome.SOLVED
