"""Timing of a task: a trajectory for each move under the joint limits and the tool speed."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from rgss.evidence import Failure
from rgss.motion import (
    JointPath,
    MotionLimits,
    TimedMove,
    TimingOutcome,
    Trajectory,
    time_move,
    time_move_by_joint_waypoints,
    time_move_by_trapezoids,
)
from rgss.scenes import too_wide
from rgss.tasks import MoveKind, MoveStep, TaskProgram
from rgss.trials.conditions import conditions_of
from rgss.trials.path_quality import PathQuality, path_quality
from rgss.trials.planning import TaskPlan, stops_of
from rgss.trials.reference import Array
from rgss.trials.settings import PlanningSettings
from rgss.trials.timing_settings import TimingProfile, TimingSettings
from rgss.trials.trial_spec import TrialSpec
from rgss.trials.workcell import Workcell, cell_of

_FAILURES = {
    TimingOutcome.IN_COLLISION: (
        Failure.TRAJECTORY_IN_COLLISION,
        "the timed motion collides, although the path does not",
    ),
    TimingOutcome.INFEASIBLE: (
        Failure.TRAJECTORY_INFEASIBLE,
        "no motion along the path satisfies the limits of joints and tool",
    ),
}

_TIME_OPTIMAL = TimingSettings()

LONGEST_MOVE_S = 600.0
"""Greatest duration of a move in s: its targets, one for each physics step, must fit into memory."""


@dataclass(frozen=True, slots=True, kw_only=True)
class TaskTiming:
    """The timed moves.

    Attributes:
        trajectories: The trajectories by move.
        failures: Reason for each move with a path but without a trajectory.
        qualities: Clearance and manipulability along each trajectory.
    """

    trajectories: Mapping[str, Trajectory]
    failures: Mapping[str, tuple[Failure, str]]
    qualities: Mapping[str, PathQuality]


def time_task(
    cell: Workcell,
    plan: TaskPlan,
    *,
    tool_speed_m_s: float,
    settings: PlanningSettings,
    timing: TimingSettings = _TIME_OPTIMAL,
) -> TaskTiming:
    """Time every move of a plan; the resulting trajectory is checked for collisions.

    Args:
        cell: Scene, arm and collision models.
        plan: The paths.
        tool_speed_m_s: Greatest speed of the tool.
        settings: Resolution of the check, and the kinds of the moves.
        timing: The velocity profile, and its shares of the joint limits.
    """
    limits = _limits(cell, timing, tool_speed_m_s)
    trajectories: dict[str, Trajectory] = {}
    failures: dict[str, tuple[Failure, str]] = {}
    for step, path in _paths(cell.task, plan):
        phase = step.name
        if path is None:
            failures[phase] = _no_line(cell, step)
            continue
        own = limits if step.speed_share == 1.0 else _limits(cell, timing, step.speed_share * tool_speed_m_s)
        result = _timed(cell, step, JointPath(path), own, settings, timing.profile)
        if result.trajectory is None:
            failures[phase] = _FAILURES[result.outcome]
        elif result.trajectory.duration_s > LONGEST_MOVE_S:
            failures[phase] = (Failure.TRAJECTORY_INFEASIBLE, _too_slow(result.trajectory, own))
        else:
            trajectories[phase] = result.trajectory
    qualities = {
        phase: path_quality(trajectory, cell.running[phase], cell.arm) for phase, trajectory in trajectories.items()
    }
    # The resolution of the check may step over what the finer samples of the clearance find.
    for phase, quality in list(qualities.items()):
        if quality.clearance_m is not None and quality.clearance_m < 0.0:
            failures[phase] = (Failure.TRAJECTORY_IN_COLLISION, _overlap(quality.clearance_m, settings))
            del trajectories[phase], qualities[phase]
    return TaskTiming(trajectories=trajectories, failures=failures, qualities=qualities)


def _overlap(clearance_m: float, settings: PlanningSettings) -> str:
    return (
        f"the timed motion overlaps an obstacle by {-clearance_m * 1e3:.2g} mm between configurations that were "
        f"checked, {settings.verified_every_rad:g} rad apart"
    )


def _no_line(cell: Workcell, step: MoveStep) -> tuple[Failure, str]:
    """Reason why a straight move of the tool or of the joints has no path."""
    line = "joints" if step.mode is MoveKind.JOINT else "tool"
    message = f"the arm cannot follow the straight line of the {line} in {step.name!r} without collision"
    (leg,) = (leg for leg in cell.route.legs if leg.step.name == step.name)
    if (none := cell.without_grasp(leg)) is not None:
        return Failure.UNREACHABLE_WAYPOINT, none.detail("")
    if wide := too_wide(cell.geometry, leg.scene):
        return Failure.UNREACHABLE_WAYPOINT, wide
    stops, why = stops_of(cell), ""
    if step.name in stops.obstacles:
        outcome, detail = stops.obstacles[step.name]
        return Failure(outcome.value), detail
    for index in (leg.start, leg.goal):
        if not why and index in stops.reasons:
            why = f"no valid configuration for {cell.route.stops[index].name}: {stops.reasons[index]}"
    return Failure.UNREACHABLE_WAYPOINT, f"{message}: {why}" if why else message


def timing_of(spec: TrialSpec, plan: TaskPlan) -> TaskTiming:
    """Timing of a trial."""
    speed_m_s = conditions_of(spec).tool_speed_m_s
    settings = spec.settings
    return time_task(cell_of(spec), plan, tool_speed_m_s=speed_m_s, settings=settings.planning, timing=settings.timing)


def _limits(cell: Workcell, timing: TimingSettings, tool_speed_m_s: float) -> MotionLimits:
    robot = cell.scene.robot
    acceleration_m_s2 = robot.tool_acceleration_m_s2
    return timing.limits(robot.joints, tool_speed_m_s=tool_speed_m_s, tool_acceleration_m_s2=acceleration_m_s2)


def _timed(
    cell: Workcell,
    step: MoveStep,
    path: JointPath,
    limits: MotionLimits,
    settings: PlanningSettings,
    profile: TimingProfile,
) -> TimedMove:
    validity, resolution_rad = cell.running[step.name], settings.verified_every_rad
    if profile is TimingProfile.TIME_OPTIMAL:
        return time_move(path, validity, cell.arm, limits, resolution_rad=resolution_rad)
    is_curve = settings.kinds(cell.task.planned).get(step.name, step.mode) is MoveKind.STRAIGHT
    if profile is TimingProfile.JOINT_WAYPOINTS and not is_curve:
        return time_move_by_joint_waypoints(path, validity, cell.arm, limits, resolution_rad=resolution_rad)
    return time_move_by_trapezoids(path, validity, cell.arm, limits, resolution_rad=resolution_rad, is_curve=is_curve)


def _too_slow(trajectory: Trajectory, limits: MotionLimits) -> str:
    return (
        f"the move would take {trajectory.duration_s:.3g} s, more than {LONGEST_MOVE_S:g} s "
        f"(tool speed limit {limits.tool_speed_m_s:g} m/s)"
    )


def _paths(task: TaskProgram, plan: TaskPlan) -> Iterator[tuple[MoveStep, Array | None]]:
    """Moves to be timed with their paths, planned and straight; None for an infeasible straight one."""
    for step in task.moves:
        if step.name in plan.direct:
            yield step, plan.direct[step.name]
        elif step.name in plan.moves and (path := plan.moves[step.name].path_rad) is not None:
            yield step, path
