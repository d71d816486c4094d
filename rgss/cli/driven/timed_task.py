"""The timed task of a trial as a driver runs it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rgss.drivers import GripperState, Segment, TimedTask
from rgss.errors import MotionError
from rgss.evidence import PlanOutcome

if TYPE_CHECKING:
    from rgss.tasks import CheckStep, GripStep, MoveStep, NeutralStep, ReleaseStep, Step, StepMachine, WaitStep
    from rgss.trials import TaskPlan, TaskTiming, TrialSpec


def timed_task(spec: TrialSpec, plan: TaskPlan, timing: TaskTiming) -> TimedTask:
    """The moves of a trial, with waits in which the gripper closes and opens.

    Raises:
        MotionError: A move was not planned or timed.
    """
    recorder: StepMachine[Segment | None] = _Recorder(spec, plan, timing)
    segments = (step.run(recorder) for step in spec.task.steps)
    return TimedTask(segments=tuple(segment for segment in segments if segment is not None))


class _Recorder:
    """Machine that turns each step into a segment: a motion, or a wait with the gripper in a state."""

    def __init__(self, spec: TrialSpec, plan: TaskPlan, timing: TaskTiming) -> None:
        from rgss.trials.hands import hand_of

        self._control = spec.settings.control
        self._hand = hand_of(spec.gripper)
        self._plan = plan
        self._timing = timing
        self._limit_s = spec.planning_limit_s
        self._state = GripperState.OPEN

    def move(self, step: MoveStep) -> Segment:
        if reason := self._missing(step):
            raise MotionError(
                f"the move {step.name} cannot be sent to a robot: {reason}",
                hint="'rgss run' without --driver shows the trial",
            )
        return Segment(name=step.name, gripper=self._state, motion=self._timing.trajectories[step.name])

    def _missing(self, step: MoveStep) -> str:
        """Reason why the trial has no such move; empty if it has."""
        if step.name not in self._timing.trajectories:
            return _reason(step.name, self._plan, self._timing)
        if step.name in self._plan.moves:
            # The searches of a plan go on to the longest limit of the study; a design's own may be shorter.
            limit_s = min(step.limit_s or self._limit_s, self._limit_s)
            if self._plan.move_within(step.name, limit_s).outcome is not PlanOutcome.SOLVED:
                return f"no path was found within the planning limit of {limit_s:g} s"
        return ""

    def grip(self, step: GripStep) -> Segment:
        self._state = GripperState.CLOSED
        # The whole travel, or the build-up of the vacuum: the robot does not report when it holds the object.
        closing_s = max(self._hand.longest_travel_s, self._hand.least_closing_s)
        firm_s = self._control.firm_grasp_s if step.firm_s is None else step.firm_s
        return self._rest(step, closing_s + firm_s)

    def release(self, step: ReleaseStep) -> Segment:
        self._state = GripperState.OPEN
        opening_s = max(self._hand.longest_travel_s, self._hand.least_opening_s)
        return self._rest(step, opening_s + self._control.settled_s)

    def neutral(self, step: NeutralStep) -> Segment:
        self._state = GripperState.NEUTRAL
        return self._rest(step, self._hand.least_opening_s or self._hand.longest_travel_s)

    def wait(self, step: WaitStep) -> Segment:
        return self._rest(step, step.duration_s)

    def check(self, step: CheckStep) -> None:
        """No segment: a driver does not report the quantities that a check observes."""

    def _rest(self, step: Step, duration_s: float) -> Segment:
        return Segment(name=step.name, gripper=self._state, wait_s=duration_s)


def _reason(phase: str, plan: TaskPlan, timing: TaskTiming) -> str:
    if phase in timing.failures:
        return timing.failures[phase][1]
    move = plan.moves.get(phase)
    if move is None:
        return "a move before it has no path"
    return f"its planning ended with {move.outcome.value}" + (f" ({move.detail})" if move.detail else "")
