"""The plan of a task: one configuration for each waypoint, one search for each of the five moves."""

from __future__ import annotations

import hashlib
import itertools
from collections.abc import Iterable, Mapping
from dataclasses import replace
from functools import lru_cache

import numpy as np

from rgss.evidence import PLANNED_PHASES, Phase, PlanOutcome
from rgss.kinematics import choose_branches, inverse_kinematics, straight_line
from rgss.motion import (
    PlannerSettings,
    PlanningProblem,
    PlanResult,
    path_length,
    plan,
    segment_states,
)
from rgss.scenes import Scene, Waypoint, too_wide, waypoint_poses
from rgss.trials.move_kinds import MoveKind
from rgss.trials.planning.direct_moves import direct_move
from rgss.trials.planning.goal_reasons import GoalReason, reason_against
from rgss.trials.planning.planned_moves import PlannedMove, TaskPlan
from rgss.trials.planning.planning_costs import state_cost
from rgss.trials.reference import Array
from rgss.trials.settings import PlanningSettings
from rgss.trials.trial_spec import TrialSpec
from rgss.trials.workcell import Workcell, cell_of

_ENDS: Mapping[Phase, tuple[Waypoint, Waypoint]] = {
    Phase.MOVE_TO_GRASP: (Waypoint.GRASP_APPROACH, Waypoint.GRASP),
    Phase.LIFT: (Waypoint.GRASP, Waypoint.LIFT),
    Phase.MOVE_TO_GRASP_DEPARTURE: (Waypoint.LIFT, Waypoint.GRASP_DEPARTURE),
    Phase.MOVE_TO_PLACE_APPROACH: (Waypoint.GRASP_DEPARTURE, Waypoint.PLACE_APPROACH),
    Phase.MOVE_TO_PLACE: (Waypoint.PLACE_APPROACH, Waypoint.PLACE),
    Phase.MOVE_TO_GRASP_APPROACH: (Waypoint.PLACE, Waypoint.GRASP_APPROACH),
}
"""Where each move begins and ends."""


def plan_task(
    cell: Workcell,
    planner: PlannerSettings | str,
    *,
    seed: int,
    settings: PlanningSettings,
    past_failures: bool = False,
) -> TaskPlan:
    """Plan every move of the task.

    All planners are given the same configurations at the waypoints, and each move has its own
    seed, so that planners are compared on the same problems.

    Args:
        cell: Scene, arm and collision models.
        planner: The planner with its parameters, or the name of one with OMPL's.
        seed: The trial's seed.
        settings: Clock, limit, resolutions.
        past_failures: Whether the moves after one that finds no path are planned too, as planners are compared.
    """
    scene, models = cell.scene, cell.planning
    stops, lift, reasons = waypoint_configurations(cell)
    chosen = PlannerSettings(algorithm=planner) if isinstance(planner, str) else planner
    moves: dict[Phase, PlannedMove] = {}
    for phase, kind in zip(PLANNED_PHASES, settings.moves, strict=True):
        start, goal = (stops.get(waypoint) for waypoint in _ENDS[phase])
        if start is None or goal is None:
            outcome = PlanOutcome.INVALID_START if start is None else PlanOutcome.INVALID_GOAL
            waypoint = _ENDS[phase][start is not None]
            why = too_wide(cell.geometry, scene.workpiece.shape) or reasons.get(
                waypoint, "none leads to it from the waypoint before"
            )
            moves[phase] = _ill_posed(phase, outcome, f"no configuration serves {waypoint.value}: {why}")
            break
        if kind is not MoveKind.PLANNED:
            moves[phase] = _direct(phase, kind, start, goal, cell, settings)
            if moves[phase].outcome is not PlanOutcome.SOLVED:
                break
            continue
        result = plan(
            _problem(scene, start, goal, settings),
            models[phase],
            chosen,
            seed=_move_seed(seed, phase),
            clock=settings.clock,
            budget_checks=settings.search_checks,
            limit_s=settings.search_limit_s,
            simplification_checks=settings.simplification_checks,
            simplification_limit_s=settings.simplification_limit_s,
            on_unverified=settings.on_unverified,
            cost=state_cost(cell, phase, chosen.objective),
        )
        moves[phase] = _planned(phase, result, cell, settings)
        if result.outcome is not PlanOutcome.SOLVED and not past_failures:
            break
    return TaskPlan(moves=moves, lift_rad=lift, clock=settings.clock)


def plan_of(spec: TrialSpec) -> TaskPlan:
    """The plan of a trial.

    Args:
        spec: The trial.

    Raises:
        MotionError: The planner is not there.
    """
    return plan_task(cell_of(spec), spec.planned_by, seed=spec.seed, settings=spec.settings.planning)


@lru_cache(maxsize=4)
def waypoint_configurations(
    cell: Workcell,
) -> tuple[Mapping[Waypoint, Array], Array | None, Mapping[Waypoint, GoalReason]]:
    """One configuration for each waypoint: collision-free in every move that meets there, least travel.

    They are the same for every planner and seed, and so worked out once for a workcell. Beside them are
    the straight lift, and why waypoints that have no configuration have none.

    Args:
        cell: Scene, arm and collision models.
    """
    models = cell.planning
    inverse = inverse_kinematics(cell.arm)
    poses = waypoint_poses(cell.scene)
    candidates: dict[Waypoint, list[Array]] = {}
    for waypoint, pose in poses.items():
        meeting = [models[phase] for phase, ends in _ENDS.items() if waypoint in ends]
        candidates[waypoint] = [q for q in inverse.solve(pose) if all(model.is_valid(q) for model in meeting)]
    reasons = unserved_waypoints(cell, (waypoint for waypoint, found in candidates.items() if not found))
    # The task is planned up to the first unreachable waypoint.
    order = list(itertools.takewhile(lambda waypoint: candidates[waypoint], poses))
    legs = [(order.index(start), order.index(goal)) for start, goal in _ENDS.values() if {start, goal} <= {*order}]
    if not legs:
        return {waypoint: candidates[waypoint][0] for waypoint in order}, None, reasons
    chosen = choose_branches([candidates[waypoint] for waypoint in order], legs=legs, home=cell.scene.robot.home_rad)
    if chosen is None:
        return {}, None, reasons
    stops = dict(zip(order, chosen, strict=True))
    if Waypoint.LIFT not in stops:
        return stops, None, reasons
    lift = straight_line(inverse, stops[Waypoint.GRASP], poses[Waypoint.LIFT])
    if lift is None or not all(models[Phase.LIFT].is_valid(q) for q in lift):
        del stops[Waypoint.LIFT]
        return stops, None, reasons
    stops[Waypoint.LIFT] = lift[-1]
    lift.setflags(write=False)
    return stops, lift, reasons


def unserved_waypoints(cell: Workcell, among: Iterable[Waypoint] = tuple(Waypoint)) -> dict[Waypoint, GoalReason]:
    """Why waypoints have no configuration that is valid in every move that meets there.

    Args:
        cell: Scene, arm and collision models.
        among: The waypoints that are looked at.

    Returns:
        The reason of each that has none, in the task's order.
    """
    inverse, poses, wanted = inverse_kinematics(cell.arm), waypoint_poses(cell.scene), set(among)
    found = {}
    for waypoint in (one for one in poses if one in wanted):
        meeting = [cell.planning[phase] for phase, ends in _ENDS.items() if waypoint in ends]
        reached = inverse.solve(poses[waypoint])
        if not any(all(model.is_valid(q) for model in meeting) for q in reached):
            found[waypoint] = reason_against(inverse, meeting, poses[waypoint], reached)
    return found


def _problem(scene: Scene, start: Array, goal: Array, settings: PlanningSettings) -> PlanningProblem:
    return PlanningProblem(
        lower_rad=tuple(joint.lower_rad for joint in scene.robot.joints),
        upper_rad=tuple(joint.upper_rad for joint in scene.robot.joints),
        start=tuple(start.tolist()),
        goal=tuple(goal.tolist()),
        resolution_rad=settings.resolution_rad,
        verification_resolution_rad=settings.verification_resolution_rad,
    )


def _planned(phase: Phase, result: PlanResult, cell: Workcell, settings: PlanningSettings) -> PlannedMove:
    path = None if result.path is None else result.path.points_rad
    return PlannedMove(
        phase=phase,
        outcome=result.outcome,
        checks=result.checks,
        simplification_checks=result.simplification_checks,
        search_time_s=result.search_time_s,
        time_s=result.search_time_s + result.simplification_time_s,
        path_rad=path,
        path_length_m=None if path is None else _tool_path_length(cell, path, settings.verified_every_rad),
        detail=_unverified_detail(result, settings) if result.outcome is PlanOutcome.NOT_VERIFIED else "",
        verification_checks=result.verification_checks,
        repairs=result.repairs,
        simplification_unlimited_from=result.simplification_unlimited_from,
    )


def _unverified_detail(result: PlanResult, settings: PlanningSettings) -> str:
    return (
        f"the path that was found after {result.checks} validity checks touches something between states "
        f"{settings.resolution_rad:g} rad apart"
    )


def _direct(
    phase: Phase, kind: MoveKind, start: Array, goal: Array, cell: Workcell, settings: PlanningSettings
) -> PlannedMove:
    """A move without a search, in the place of a planned one."""
    found = direct_move(
        kind,
        start,
        goal,
        waypoint_poses(cell.scene)[_ENDS[phase][1]],
        inverse=inverse_kinematics(cell.arm),
        model=cell.planning[phase],
        clock=settings.clock,
        resolution_rad=settings.resolution_rad,
        limit_s=settings.search_limit_s,
    )
    path = found.path_rad
    length_m = None if path is None else _tool_path_length(cell, path, settings.resolution_rad)
    move = replace(_ill_posed(phase, found.outcome, found.detail), checks=found.checks, time_s=found.time_s)
    return replace(move, search_time_s=found.time_s, path_rad=path, path_length_m=length_m)


def _tool_path_length(cell: Workcell, path: Array, resolution_rad: float) -> float:
    """Length of the way of the tool along a joint path, which between its corners is no straight line."""
    states = [path[:1]]
    for start, end in itertools.pairwise(path):
        states.append(segment_states(start, end, resolution_rad))
    return path_length(cell.arm.tool_position(np.vstack(states)))


def _ill_posed(phase: Phase, outcome: PlanOutcome, detail: str) -> PlannedMove:
    return PlannedMove(
        phase=phase,
        outcome=outcome,
        checks=0,
        simplification_checks=0,
        search_time_s=0.0,
        time_s=0.0,
        path_rad=None,
        path_length_m=None,
        detail=detail,
    )


def _move_seed(seed: int, phase: Phase) -> int:
    """A seed of its own for each move: 31 bits of a hash, since the planner's seed is a C unsigned long."""
    return int.from_bytes(hashlib.sha256(f"{seed}:{phase.value}".encode()).digest()[:4], "big") >> 1 or 1
