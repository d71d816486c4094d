"""Outcomes of a trial: expected results, stored in records, never raised."""

from __future__ import annotations

from enum import Enum


class PhaseOutcome(str, Enum):
    """Outcome of a phase."""

    COMPLETED = "completed"
    FAILED = "failed"
    NOT_RUN = "not_run"


class PlanOutcome(str, Enum):
    """Outcome of the planning of one sub-task."""

    SOLVED = "solved"
    BUDGET_SPENT = "budget_spent"
    INVALID_START = "invalid_start"
    INVALID_GOAL = "invalid_goal"
    MOVE_BLOCKED = "move_blocked"
    MOVE_UNREACHABLE = "move_unreachable"
    NOT_RUN = "not_run"
    NOT_VERIFIED = "not_verified"


class Failure(str, Enum):
    """Failure that ended a trial before its last phase was complete."""

    PLANNING_LIMIT = "planning_limit"
    PATH_NOT_VERIFIED = "path_not_verified"
    INVALID_START = "invalid_start"
    INVALID_GOAL = "invalid_goal"
    MOVE_BLOCKED = "move_blocked"
    MOVE_UNREACHABLE = "move_unreachable"
    UNREACHABLE_WAYPOINT = "unreachable_waypoint"
    TRAJECTORY_INFEASIBLE = "trajectory_infeasible"
    TRAJECTORY_IN_COLLISION = "trajectory_in_collision"
    TRACKING_ERROR = "tracking_error"
    ARM_COLLISION = "arm_collision"
    NO_FIRM_GRASP = "no_firm_grasp"
    OBJECT_DROPPED = "object_dropped"
    OBJECT_DAMAGED = "object_damaged"
    OBJECT_COLLISION = "object_collision"
    NOT_RELEASED = "not_released"
    NOT_IN_PLACE_REGION = "not_in_place_region"
    NOT_UPRIGHT = "not_upright"
    TASK_TIME_LIMIT = "task_time_limit"
    CHECK_FAILED = "check_failed"
    RUN_CRASHED = "run_crashed"


class Fidelity(str, Enum):
    """Fidelity of a trial's physics."""

    KINEMATIC = "kinematic"
    DYNAMIC = "dynamic"
    CONTACT = "contact"
