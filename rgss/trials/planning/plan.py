"""Plan of a task: one configuration for each waypoint, one search for each planned move."""

from __future__ import annotations

import hashlib
import itertools
from collections.abc import Callable
from dataclasses import replace
from functools import partial

import numpy as np

from rgss.evidence import PlanOutcome
from rgss.motion import (
    PlannerSettings,
    PlanningProblem,
    PlanResult,
    SearchGraph,
    path_length,
    plan,
    segment_states,
)
from rgss.scenes import Scene, too_wide
from rgss.tasks import MoveKind, MoveStep
from rgss.trials.planning.direct_moves import direct_move
from rgss.trials.planning.planned_moves import PlannedMove, TaskPlan
from rgss.trials.planning.planning_costs import state_cost
from rgss.trials.planning.present_object import with_object_named
from rgss.trials.planning.task_stops import goal_pose_of, inverse_at, stops_of
from rgss.trials.reference import Array
from rgss.trials.route import Leg
from rgss.trials.settings import PlanningSettings
from rgss.trials.trial_spec import TrialSpec
from rgss.trials.workcell import Workcell, cell_of


def plan_task(
    cell: Workcell,
    planner: PlannerSettings | str,
    *,
    seed: int,
    settings: PlanningSettings,
    past_failures: bool = False,
    on_graph: Callable[[str, SearchGraph], None] | None = None,
) -> TaskPlan:
    """Plan every move of the task.

    All planners have the same configurations at the waypoints, and each move has its own seed, so that planners are
    compared on the same problems.

    Args:
        cell: Scene, arm and collision models.
        planner: The planner with its parameters, or the name of one with OMPL's.
        seed: The trial's seed.
        settings: Clock, limit, resolutions.
        past_failures: True to plan also the moves after one without a path, for comparisons of planners.
        on_graph: Callback with each planned move and the graph of its search.
    """
    stops = stops_of(cell)
    chosen = PlannerSettings(algorithm=planner) if isinstance(planner, str) else planner
    kinds = settings.kinds(cell.task.planned)
    moves: dict[str, PlannedMove] = {}
    for leg in (leg for leg in cell.route.legs if leg.step.name in kinds):
        phase, kind = leg.step.name, kinds[leg.step.name]
        if (none := cell.without_grasp(leg)) is not None:
            moves[phase] = _ill_posed(phase, PlanOutcome.INVALID_GOAL, none.detail(""))
            break
        start, goal = stops.configurations.get(leg.start), stops.configurations.get(leg.goal)
        if start is None or goal is None:
            outcome = PlanOutcome.INVALID_START if start is None else PlanOutcome.INVALID_GOAL
            index = leg.start if start is None else leg.goal
            why = too_wide(cell.geometry, leg.scene) or stops.reasons.get(
                index, "none is reachable from the previous waypoint"
            )
            detail = with_object_named(f"no valid configuration for {cell.route.stops[index].name}: {why}", leg.scene)
            ungrasped = cell.ungrasped.get(leg.scene.workpiece.id)
            moves[phase] = _ill_posed(phase, outcome, detail if ungrasped is None else ungrasped.detail(detail))
            break
        if kind is not MoveKind.PLANNED:
            moves[phase] = _direct(leg, kind, start, goal, cell, settings)
            if moves[phase].outcome is not PlanOutcome.SOLVED:
                break
            continue
        result = plan(
            _problem(cell.scene, start, goal, _settings_of(leg.step, settings)),
            cell.planning[phase],
            chosen,
            seed=_move_seed(seed, phase),
            clock=settings.clock,
            budget_checks=settings.search_checks,
            limit_s=settings.search_limit_s,
            simplification_checks=settings.simplification_checks,
            simplification_limit_s=settings.simplification_limit_s,
            on_unverified=settings.on_unverified,
            cost=state_cost(cell, phase, chosen.objective),
            on_graph=None if on_graph is None else partial(on_graph, phase),
        )
        moves[phase] = _planned(phase, result, cell, settings)
        if result.outcome is not PlanOutcome.SOLVED and not past_failures:
            break
    return TaskPlan(moves=moves, direct=stops.direct, clock=settings.clock)


def plan_of(spec: TrialSpec) -> TaskPlan:
    """Plan of a trial.

    Raises:
        MotionError: The planner is not available.
    """
    return plan_task(cell_of(spec), spec.planned_by, seed=spec.seed, settings=spec.settings.planning)


def _settings_of(step: MoveStep, settings: PlanningSettings) -> PlanningSettings:
    """Settings with the resolution of the step, if it states one."""
    if step.resolution_rad is None:
        return settings
    verification_rad = min(step.resolution_rad, settings.verified_every_rad)
    return replace(settings, resolution_rad=step.resolution_rad, verification_resolution_rad=verification_rad)


def _problem(scene: Scene, start: Array, goal: Array, settings: PlanningSettings) -> PlanningProblem:
    return PlanningProblem(
        lower_rad=tuple(joint.lower_rad for joint in scene.robot.joints),
        upper_rad=tuple(joint.upper_rad for joint in scene.robot.joints),
        start=tuple(start.tolist()),
        goal=tuple(goal.tolist()),
        resolution_rad=settings.resolution_rad,
        verification_resolution_rad=settings.verification_resolution_rad,
    )


def _planned(phase: str, result: PlanResult, cell: Workcell, settings: PlanningSettings) -> PlannedMove:
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
        f"the path found after {result.checks} validity checks collides between states "
        f"{settings.resolution_rad:g} rad apart"
    )


def _direct(
    leg: Leg, kind: MoveKind, start: Array, goal: Array, cell: Workcell, settings: PlanningSettings
) -> PlannedMove:
    """Direct move in place of a planned one."""
    stop = cell.route.stops[leg.goal]
    found = direct_move(
        kind,
        start,
        goal,
        # If the rotation of the tool is free, it is that of the configuration at the start of the next move.
        cell.arm.tool_pose(goal) if stop.is_turn_free else goal_pose_of(cell, stop),
        inverse=inverse_at(cell, stop),
        model=cell.planning[leg.step.name],
        clock=settings.clock,
        resolution_rad=_settings_of(leg.step, settings).resolution_rad,
        limit_s=settings.search_limit_s,
    )
    path = found.path_rad
    length_m = None if path is None else _tool_path_length(cell, path, settings.resolution_rad)
    move = _ill_posed(leg.step.name, found.outcome, with_object_named(found.detail, leg.scene))
    move = replace(move, checks=found.checks, time_s=found.time_s)
    return replace(move, search_time_s=found.time_s, path_rad=path, path_length_m=length_m)


def _tool_path_length(cell: Workcell, path: Array, resolution_rad: float) -> float:
    """Length in m of the tool path of a joint path; it is curved between the corners."""
    states = [path[:1]]
    for start, end in itertools.pairwise(path):
        states.append(segment_states(start, end, resolution_rad))
    return path_length(cell.arm.tool_position(np.vstack(states)))


def _ill_posed(phase: str, outcome: PlanOutcome, detail: str) -> PlannedMove:
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


def _move_seed(seed: int, phase: str) -> int:
    """Seed of a move: 31 bits of a hash, since the planner's seed is a C unsigned long."""
    return int.from_bytes(hashlib.sha256(f"{seed}:{phase}".encode()).digest()[:4], "big") >> 1 or 1
