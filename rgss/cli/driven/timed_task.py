"""The timed task of a trial as a driver runs it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rgss.drivers import GripperState, Segment, TimedTask
from rgss.errors import MotionError
from rgss.tasks import CheckStep, GripStep, MoveStep, ReleaseStep, WaitStep, no_branch_for

if TYPE_CHECKING:
    from rgss.trials import TaskPlan, TaskTiming, TrialSpec


def timed_task(spec: TrialSpec, plan: TaskPlan, timing: TaskTiming) -> TimedTask:
    """The moves of a trial, with waits in which the gripper closes and opens.

    Args:
        spec: The trial.
        plan: Its plan.
        timing: Its timed moves.

    Raises:
        MotionError: A move was not planned or timed.
    """
    state, segments = GripperState.OPEN, []
    for step in spec.task.steps:
        if isinstance(step, GripStep):
            state = GripperState.CLOSED
        elif isinstance(step, ReleaseStep):
            state = GripperState.OPEN
        # A driver does not report the quantities that a check observes.
        if not isinstance(step, CheckStep):
            segments.append(_segment(step, state, spec, plan, timing))
    return TimedTask(segments=tuple(segments))


def _segment(
    step: MoveStep | GripStep | ReleaseStep | WaitStep,
    state: GripperState,
    spec: TrialSpec,
    plan: TaskPlan,
    timing: TaskTiming,
) -> Segment:
    """One step: a motion, or a wait with the gripper in a state."""
    control, gripper = spec.settings.control, spec.gripper
    travel_s = gripper.geometry.stroke_m / gripper.finger_velocity_m_s
    if isinstance(step, GripStep):
        return Segment(name=step.name, gripper=state, wait_s=travel_s + control.firm_grasp_s)
    if isinstance(step, ReleaseStep):
        return Segment(name=step.name, gripper=state, wait_s=travel_s + control.settled_s)
    if isinstance(step, WaitStep):
        return Segment(name=step.name, gripper=state, wait_s=step.duration_s)
    if isinstance(step, MoveStep):
        if step.name not in timing.trajectories:
            raise MotionError(
                f"the move {step.name} cannot be sent to a robot: {_reason(step.name, plan, timing)}",
                hint="'rgss run' without --driver shows the trial",
            )
        return Segment(name=step.name, gripper=state, motion=timing.trajectories[step.name])
    raise no_branch_for(step)


def _reason(phase: str, plan: TaskPlan, timing: TaskTiming) -> str:
    if phase in timing.failures:
        return timing.failures[phase][1]
    move = plan.moves.get(phase)
    if move is None:
        return "a move before it has no path"
    return f"its planning ended with {move.outcome.value}" + (f" ({move.detail})" if move.detail else "")
