"""The timed task of a trial as a driver runs it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rgss.drivers import GripperState, Segment, TimedTask
from rgss.errors import MotionError
from rgss.tasks import CheckStep, GripStep, ReleaseStep, WaitStep

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
    control, gripper = spec.settings.control, spec.gripper
    travel_s = gripper.geometry.stroke_m / gripper.finger_velocity_m_s
    state, segments = GripperState.OPEN, []
    for step in spec.task.steps:
        phase = step.name
        if isinstance(step, GripStep):
            state = GripperState.CLOSED
            segments.append(Segment(name=phase, gripper=state, wait_s=travel_s + control.firm_grasp_s))
        elif isinstance(step, ReleaseStep):
            state = GripperState.OPEN
            segments.append(Segment(name=phase, gripper=state, wait_s=travel_s + control.settled_s))
        elif isinstance(step, WaitStep):
            segments.append(Segment(name=phase, gripper=state, wait_s=step.duration_s))
        elif isinstance(step, CheckStep):
            continue  # What a check needs to see, a driver does not report.
        elif phase in timing.trajectories:
            segments.append(Segment(name=phase, gripper=state, motion=timing.trajectories[phase]))
        else:
            raise MotionError(
                f"the move {phase} cannot be sent to a robot: {_reason(phase, plan, timing)}",
                hint="'rgss run' without --driver shows the trial",
            )
    return TimedTask(segments=tuple(segments))


def _reason(phase: str, plan: TaskPlan, timing: TaskTiming) -> str:
    if phase in timing.failures:
        return timing.failures[phase][1]
    move = plan.moves.get(phase)
    if move is None:
        return "a move before it has no path"
    return f"its planning ended with {move.outcome.value}" + (f" ({move.detail})" if move.detail else "")
