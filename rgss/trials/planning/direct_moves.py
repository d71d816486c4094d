"""Direct moves: straight lines of the tool or in joint space, checked state by state without a search."""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass

import numpy as np

from rgss.evidence import PlanOutcome
from rgss.kinematics import CollisionModel, InverseKinematics, LineBreak, follow_line
from rgss.motion import ClockKind, PlanningClock, segment_states
from rgss.scenes import Pose
from rgss.tasks import MoveKind
from rgss.trials.planning.goal_reasons import excessive_tilt_rad
from rgss.trials.reference import Array

_SAME_CONFIGURATION_RAD = 1e-6
_AT_CLEARANCE_M = 1e-6
_NAMES = {MoveKind.STRAIGHT: "the straight line of the tool", MoveKind.JOINT: "the straight line of the joints"}
_BREAKS = {
    LineBreak.UNREACHABLE: "the arm does not reach the tool's pose within the ranges of its joints",
    LineBreak.BRANCH_ENDS: "the arm would have to change its configuration, as at a singularity",
}


@dataclass(frozen=True, slots=True, kw_only=True)
class DirectMove:
    """Result of the check of a direct move.

    Attributes:
        outcome: Solved, blocked by a collision, unreachable, or out of time.
        checks: Number of validity checks, up to the first invalid state.
        time_s: Their time by the planning clock.
        path_rad: Configurations (k, n); None unless it is solved.
        detail: Cause and position of the failure along the move; empty if it is solved.
    """

    outcome: PlanOutcome
    checks: int
    time_s: float
    path_rad: Array | None = None
    detail: str = ""


def direct_move(
    kind: MoveKind,
    start: Array,
    goal: Array,
    goal_pose: Pose,
    *,
    inverse: InverseKinematics,
    model: CollisionModel,
    clock: PlanningClock,
    resolution_rad: float,
    limit_s: float,
) -> DirectMove:
    """Check a direct move from its start on.

    Every state at the resolution of a planned path is a validity check, charged to the planning clock as those of a
    search. There is no simplification.

    Args:
        kind: Straight or joint.
        start: Joint positions at its start, shape (n,).
        goal: Joint positions at its end and the start of the next move, shape (n,).
        goal_pose: Transform of the tool-centre frame to the world at its end.
        inverse: Inverse kinematics of the arm.
        model: Collision model of the move.
        clock: The planning clock.
        resolution_rad: Greatest Euclidean distance in joint space between two checked states.
        limit_s: Longest time by the clock.
    """
    elapsed_s = clock.start()
    corners, share, broken = _line(kind, start, goal, goal_pose, inverse)
    states = _states(corners, resolution_rad)
    affordable = clock.checks_within(limit_s) if clock.kind is ClockKind.COUNTED else len(states)
    checked = states[:affordable]
    blocked = next((index for index, q in enumerate(checked) if not model.is_valid(q)), None)
    checks = len(checked) if blocked is None else blocked + 1
    time_s = elapsed_s(checks)
    if time_s > limit_s or (blocked is None and affordable < len(states)):
        return DirectMove(outcome=PlanOutcome.BUDGET_SPENT, checks=checks, time_s=min(time_s, limit_s))
    if blocked is not None:
        detail = _blocked(kind, states, blocked, share, model)
        return DirectMove(outcome=PlanOutcome.MOVE_BLOCKED, checks=checks, time_s=time_s, detail=detail)
    if broken:
        return DirectMove(outcome=PlanOutcome.MOVE_UNREACHABLE, checks=checks, time_s=time_s, detail=broken)
    return DirectMove(outcome=PlanOutcome.SOLVED, checks=checks, time_s=time_s, path_rad=corners)


def move_obstacle(
    kind: MoveKind,
    start: Array,
    goal: Array,
    goal_pose: Pose,
    *,
    inverse: InverseKinematics,
    model: CollisionModel,
    resolution_rad: float,
) -> tuple[PlanOutcome, str] | None:
    """Reason why a direct move cannot be made, without a planning clock; None if it can.

    Args:
        kind: Straight or joint.
        start: Joint positions at its start, shape (n,).
        goal: Joint positions at its end, shape (n,).
        goal_pose: Transform of the tool-centre frame to the world at its end.
        inverse: Inverse kinematics of the arm.
        model: Collision model of the move.
        resolution_rad: Greatest Euclidean distance in joint space between two checked states.
    """
    corners, share, broken = _line(kind, start, goal, goal_pose, inverse)
    states = _states(corners, resolution_rad)
    blocked = next((index for index, q in enumerate(states) if not model.is_valid(q)), None)
    if blocked is not None:
        return PlanOutcome.MOVE_BLOCKED, _blocked(kind, states, blocked, share, model)
    return (PlanOutcome.MOVE_UNREACHABLE, broken) if broken else None


def _blocked(kind: MoveKind, states: Array, index: int, share: float, model: CollisionModel) -> str:
    """Place of the first invalid state along a move, and its reason."""
    place = f"{_NAMES[kind]} is blocked at {_percent(share * (index + 1) / len(states))}"
    return f"{place}: {_obstacle(model, states[index])}"


def _line(
    kind: MoveKind, start: Array, goal: Array, goal_pose: Pose, inverse: InverseKinematics
) -> tuple[Array, float, str]:
    """Corners of a move as far as it can be followed, the fraction reached, and the reason of its end."""
    if kind is MoveKind.JOINT:
        return np.array([start, goal]), 1.0, ""
    line = follow_line(inverse, start, goal_pose, goal_configuration=goal)
    corners = line.configurations_rad
    if line.broken is not None:
        return corners, line.fraction, f"{_NAMES[kind]} ends at {_percent(line.fraction)}: {_BREAKS[line.broken]}"
    if np.max(np.abs(corners[-1] - goal)) > _SAME_CONFIGURATION_RAD:
        return (
            corners,
            1.0,
            f"{_NAMES[kind]} ends in a configuration of the arm that differs from the start of the next move",
        )
    corners[-1] = goal
    return corners, 1.0, ""


def _states(corners: Array, resolution_rad: float) -> Array:
    """States of a path at a resolution, including the start, shape (k, n)."""
    parts = [segment_states(first, second, resolution_rad) for first, second in itertools.pairwise(corners)]
    states: Array = np.vstack([corners[:1], *parts])
    return states


def _obstacle(model: CollisionModel, q: Array) -> str:
    """Reason why a configuration is invalid: two bodies, the tilt of the carried object, or a joint range."""
    nearest = model.nearest_pair(q)
    if nearest is None or nearest.room_m >= 0.0:
        tilt = excessive_tilt_rad(model, q)
        if tilt is not None:
            return f"the object would be tilted by {math.degrees(tilt):.0f}°"
    # Rounding may put the distance of a pair that is exactly at the clearance above it.
    if nearest is not None and nearest.room_m < _AT_CLEARANCE_M:
        if nearest.distance_m <= 0.0:
            return f"{nearest.first} touches {nearest.second}, {-nearest.distance_m * 1e3:.1f} mm deep"
        distance, clearance = f"{nearest.distance_m * 1e3:.1f}", nearest.clearance_m * 1e3
        more = "more than " if distance == f"{clearance:.1f}" else ""
        return f"{nearest.first} is {distance} mm from {nearest.second}, {more}{clearance:g} mm must be kept"
    return "a joint leaves its range"


def _percent(share: float) -> str:
    return f"{100.0 * share:.0f} % of the way"
