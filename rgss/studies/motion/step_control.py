"""Control of the joints that steps of a task state: what is unstable at the rate of the study."""

from __future__ import annotations

from collections.abc import Iterator

from rgss.findings import Finding
from rgss.tasks import LoadedTask
from rgss.trials import ControlMode, JointController, least_stable_rate_hz, stated_in_step

_ANY_JOINT = ""


def step_control_findings(loaded: LoadedTask, controller: JointController, *, rate_hz: float) -> Iterator[Finding]:
    """Steps whose gains make the error of a joint grow from step to step.

    Args:
        loaded: The task with its positions.
        controller: The controller of the study.
        rate_hz: Physics steps a second.
    """
    seen = set()
    for step, at in zip(loaded.program.steps, loaded.places, strict=True):
        if step.control is None or at in seen:
            continue
        seen.add(at)
        own = stated_in_step(controller, step.control)
        if own.mode is ControlMode.CALIBRATED:
            continue
        names = (_ANY_JOINT, *(gains.joint for gains in own.joints))
        least_hz = max(least_stable_rate_hz(own, [name]) for name in names)
        if 0.0 < rate_hz <= least_hz:
            message = f"the control is unstable at {rate_hz:g} Hz: its gains need more than {least_hz:.4g} Hz"
            hint = "lower the gains, or raise the rate of the study"
            yield loaded.document.finding("task.unstable-control", message, (*at, "control"), hint=hint)
