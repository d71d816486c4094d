"""What each step of a task states: the object that it concerns, how far the hand opens, thresholds and control."""

from __future__ import annotations

from rgss.scenes import GripperGeometry, Scene, grasp_opening_m, initial_standings, scene_about
from rgss.tasks import CheckStep, GripStep, MoveStep, Step, StepControl, TaskProgram, stages_of


class GripSequence:
    """What each step of a task concerns and states.

    Attributes:
        first_grip: Name of the first step that closes the hand; empty if there is none.
        first_release: Name of the first step that opens the hand; empty if there is none.
    """

    def __init__(self, task: TaskProgram, scene: Scene, geometry: GripperGeometry) -> None:
        """Look the objects up.

        Args:
            task: The task.
            scene: The scene, whose workpiece is the object of steps that name none.
            geometry: The gripper's shape.
        """
        standings = initial_standings(scene)
        views = {
            name: scene if name == scene.workpiece.id else scene_about(scene, name, place="", standings=standings)
            for name in standings
        }
        self._views = {stage.step.name: views[stage.object] for stage in stages_of(task, scene.workpiece.id)}
        self._steps: dict[str, Step] = {step.name: step for step in task.steps}
        self._geometry = geometry
        self.first_grip = next(iter(task.grips), "")
        self.first_release = next(iter(task.releases), "")

    def control_in(self, phase: str) -> StepControl | None:
        """The control of the joints that a step states; None if it states none.

        Args:
            phase: Name of the step.
        """
        step = self._steps[phase]
        return None if isinstance(step, CheckStep) else step.control

    def reached_rad(self, phase: str) -> float | None:
        """Error of any joint up to which the end of a move counts as reached; None if the move does not state it.

        Args:
            phase: Name of the step.
        """
        step = self._steps[phase]
        return step.reached_rad if isinstance(step, MoveStep) else None

    def firm_s(self, phase: str, common_s: float) -> float:
        """Time for which the fingers must hold an object for a firm grasp.

        Args:
            phase: Name of the step.
            common_s: That of steps that state none.
        """
        step = self._steps[phase]
        return step.firm_s if isinstance(step, GripStep) and step.firm_s is not None else common_s

    def view_of(self, phase: str) -> Scene:
        """The scene with the object of a step as its workpiece.

        Args:
            phase: Name of the step.
        """
        return self._views[phase]

    def travel_m(self, phase: str) -> float:
        """Travel of a finger from open to where it holds the object of a step.

        Args:
            phase: Name of the step.
        """
        geometry = self._geometry
        return min(geometry.stroke_m, geometry.largest_opening_m - grasp_opening_m(self._views[phase], geometry))
