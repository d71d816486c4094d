"""Findings about steps of a task that set a state which no gripper of the study has."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from rgss.findings import Finding
from rgss.scenes import GripperFile
from rgss.tasks import LoadedTask, NeutralStep


def neutral_findings(loaded: LoadedTask, grippers: Mapping[str, GripperFile]) -> Iterator[Finding]:
    """A finding for each neutral step if no gripper has commands.

    Args:
        loaded: The task with its positions in the file.
        grippers: The gripper files by name.
    """
    if any(one.drive.command_s is not None for one in grippers.values()):
        return
    for step, at in zip(loaded.program.steps, loaded.places, strict=True):
        if isinstance(step, NeutralStep):
            message = f"{step.name!r} sets a state of open-loop grippers, and no gripper of the study is one"
            hint = "state 'command' in a gripper of kind parallel, or remove the step"
            yield loaded.document.finding("task.neutral", message, at, hint=hint)
