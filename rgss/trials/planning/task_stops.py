"""Configurations at the stops of a task, and its straight moves."""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from functools import lru_cache

import numpy as np

from rgss.evidence import PlanOutcome
from rgss.kinematics import (
    CollisionModel,
    InverseKinematics,
    choose_branches,
    follow_line,
    inverse_kinematics,
    straight_line,
)
from rgss.motion import segment_states
from rgss.scenes import Pose
from rgss.tasks import MoveKind
from rgss.trials.planning.direct_moves import move_obstacle
from rgss.trials.planning.goal_reasons import GoalReason, infeasibility_reason
from rgss.trials.planning.present_object import with_object_named
from rgss.trials.reference import Array
from rgss.trials.route import Leg, Stop
from rgss.trials.workcell import Workcell

_SAME_CONFIGURATION_RAD = 1e-6
_JOINT_STEP_RAD = 0.01


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class TaskStops:
    """One configuration for each stop, the same for every planner and seed.

    Attributes:
        configurations: Joint positions (n,) by the index of the stop, without stops that have no valid one.
        direct: Configurations (k, n) of each move that the task defines as straight; None if it is infeasible.
        reasons: Reason why a stop has no valid configuration, by its index.
        obstacles: Outcome and detail of each infeasible straight move between stops that have one.
    """

    configurations: Mapping[int, Array]
    direct: Mapping[str, Array | None]
    reasons: Mapping[int, GoalReason]
    obstacles: Mapping[str, tuple[PlanOutcome, str]] = field(default_factory=dict)


@lru_cache(maxsize=4)
def stops_of(cell: Workcell) -> TaskStops:
    """One configuration for each stop: collision-free in all adjoining moves, with the least joint travel.

    Args:
        cell: Scene, arm and collision models.
    """
    stops, pairs = cell.route.stops, cell.route.pairs
    none: dict[str, Array | None] = dict.fromkeys(cell.task.direct)
    candidates = [
        [q for q in _solutions(cell, stop) if all(model.is_valid(q) for model in _meeting(cell, index))]
        for index, stop in enumerate(stops)
    ]
    reasons = _reasons(cell, (index for index, found in enumerate(candidates) if not found))
    # The task is planned up to the first stop without a valid configuration, or of an object without a grasp.
    visited = {index for leg in cell.legs for index in (leg.start, leg.goal)}
    order = list(itertools.takewhile(lambda index: index in visited and candidates[index], range(len(stops))))
    legs = [pair for pair in pairs if {*pair} <= {*order}]
    if not legs:
        return TaskStops(configurations={index: candidates[index][0] for index in order}, direct=none, reasons=reasons)
    chosen = choose_branches([candidates[index] for index in order], legs=legs, home=cell.scene.robot.home_rad)
    if chosen is None:
        return TaskStops(configurations={}, direct=none, reasons=reasons)
    found = dict(zip(order, chosen, strict=True))
    direct, obstacles = _direct_moves(cell, found)
    return TaskStops(configurations=found, direct={**none, **direct}, reasons=reasons, obstacles=obstacles)


def every_stop_is_feasible(cell: Workcell) -> bool:
    """True if each stop has a configuration that is valid in all adjoining moves; the moves are not checked.

    Args:
        cell: Scene, arm and collision models.
    """
    return all(
        any(all(model.is_valid(q) for model in _meeting(cell, index)) for q in _solutions(cell, stop))
        for index, stop in enumerate(cell.route.stops)
    )


def waypoint_configurations(cell: Workcell) -> Mapping[str, Array]:
    """Configuration of each stop by name, without stops that have no valid one.

    Args:
        cell: Scene, arm and collision models.
    """
    found = stops_of(cell).configurations
    return {stop.name: found[index] for index, stop in enumerate(cell.route.stops) if index in found}


def infeasible_waypoints(cell: Workcell) -> dict[Stop, GoalReason]:
    """Reasons why stops have no configuration that is valid in all adjoining moves.

    Args:
        cell: Scene, arm and collision models.
    """
    stops = cell.route.stops
    return {stops[index]: reason for index, reason in _reasons(cell, range(len(stops))).items()}


def goal_pose_of(cell: Workcell, stop: Stop) -> Pose:
    """Transform of the tool-centre frame to the world at a stop.

    Args:
        cell: Scene, arm and collision models.
        stop: The stop.
    """
    return cell.arm.tool_pose(np.array(stop.configuration_rad)) if stop.pose is None else stop.pose


def inverse_at(cell: Workcell, stop: Stop) -> InverseKinematics:
    """Inverse kinematics for a stop, with or without free rotation about the tool's axis.

    Args:
        cell: Scene, arm and collision models.
        stop: The stop.
    """
    return inverse_kinematics(cell.arm, is_turn_free=stop.is_turn_free)


def _solutions(cell: Workcell, stop: Stop) -> list[Array]:
    if stop.pose is None:
        return [np.array(stop.configuration_rad)]
    return list(inverse_at(cell, stop).solve(stop.pose))


def _meeting(cell: Workcell, index: int) -> list[CollisionModel]:
    return [cell.planning[leg.step.name] for leg in cell.route.legs if index in (leg.start, leg.goal)]


def _reasons(cell: Workcell, among: Iterable[int]) -> dict[int, GoalReason]:
    found = {}
    for index in among:
        stop, meeting = cell.route.stops[index], _meeting(cell, index)
        reached = _solutions(cell, stop)
        if not any(all(model.is_valid(q) for model in meeting) for q in reached):
            found[index] = infeasibility_reason(inverse_at(cell, stop), meeting, goal_pose_of(cell, stop), reached)
    return found


def _direct_moves(
    cell: Workcell, found: dict[int, Array]
) -> tuple[dict[str, Array | None], dict[str, tuple[PlanOutcome, str]]]:
    """Straight moves in order, and the obstacles of those that are infeasible.

    The first move to reach a stop determines the configuration there.
    """
    direct: dict[str, Array | None] = {}
    obstacles: dict[str, tuple[PlanOutcome, str]] = {}
    reached = {cell.route.legs[0].start}
    for leg in cell.legs:
        if leg.step.mode is not MoveKind.PLANNED and leg.start in found and leg.goal in found:
            is_new = leg.goal not in reached
            line = _line(cell, leg, found, is_new=is_new)
            direct[leg.step.name] = line
            if line is None:
                obstacle = _obstacle_of(cell, leg, found)
                if obstacle is not None:
                    obstacles[leg.step.name] = obstacle
                # An earlier move comes to a stop that is not new, and can be made.
                if is_new:
                    del found[leg.goal]
            else:
                found[leg.goal] = line[-1]
                line.setflags(write=False)
        reached.add(leg.goal)
    return direct, obstacles


def _line(cell: Workcell, leg: Leg, found: Mapping[int, Array], *, is_new: bool) -> Array | None:
    """Straight move, if it is valid and ends in the configuration at the start of the next move."""
    stop, model = cell.route.stops[leg.goal], cell.planning[leg.step.name]
    start, goal = found[leg.start], found[leg.goal]
    if leg.step.mode is MoveKind.JOINT:
        states = np.vstack([start[None], segment_states(start, goal, leg.step.resolution_rad or _JOINT_STEP_RAD)])
        return np.array([start, goal]) if all(model.is_valid(q) for q in states) else None
    if stop.pose is None:
        raise AssertionError("checked before: a straight line ends at a pose")
    if stop.is_turn_free:
        line = _line_to(cell, stop, start, goal)
    else:
        line = straight_line(inverse_at(cell, stop), start, stop.pose)
    if line is None or not all(model.is_valid(q) for q in line):
        return None
    if not is_new and np.max(np.abs(line[-1] - goal)) > _SAME_CONFIGURATION_RAD:
        return None
    return line


def _obstacle_of(cell: Workcell, leg: Leg, found: Mapping[int, Array]) -> tuple[PlanOutcome, str] | None:
    """Outcome and detail of an infeasible straight move."""
    stop = cell.route.stops[leg.goal]
    obstacle = move_obstacle(
        leg.step.mode,
        found[leg.start],
        found[leg.goal],
        cell.arm.tool_pose(found[leg.goal]) if stop.is_turn_free else goal_pose_of(cell, stop),
        inverse=inverse_at(cell, stop),
        model=cell.planning[leg.step.name],
        resolution_rad=leg.step.resolution_rad or _JOINT_STEP_RAD,
    )
    return None if obstacle is None else (obstacle[0], with_object_named(obstacle[1], leg.scene))


def _line_to(cell: Workcell, stop: Stop, start: Array, goal: Array) -> Array | None:
    """Straight line of the tool to a configuration, which determines the rotation about the tool's axis."""
    line = follow_line(inverse_at(cell, stop), start, cell.arm.tool_pose(goal), goal_configuration=goal)
    return line.configurations_rad if line.broken is None else None
