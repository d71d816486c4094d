"""Objects that the hand grips and releases in each step of a task."""

from __future__ import annotations

from collections.abc import Sequence

from rgss.scenes import SceneObject, Workpiece
from rgss.tasks import TaskProgram, stages_of


class GripSequence:
    """The object that is concerned in each step of a task.

    Attributes:
        first_grip: Name of the first step that closes the hand; empty if there is none.
        first_release: Name of the first step that opens the hand; empty if there is none.
    """

    def __init__(self, task: TaskProgram, workpiece: Workpiece, others: Sequence[SceneObject] = ()) -> None:
        """Look the objects up.

        Args:
            task: The task.
            workpiece: The object of steps that name none.
            others: The other objects.
        """
        known = {workpiece.id: workpiece, **{one.workpiece.id: one.workpiece for one in others}}
        self._of_step = {stage.step.name: known[stage.object] for stage in stages_of(task, workpiece.id)}
        self.first_grip = next(iter(task.grips), "")
        self.first_release = next(iter(task.releases), "")

    def object_of(self, phase: str) -> Workpiece:
        """The object that a step concerns.

        Args:
            phase: Name of the step.
        """
        return self._of_step[phase]
