"""Object, hand opening, thresholds and control of each step of a task."""

from __future__ import annotations

from rgss.scenes import GripperGeometry, Scene, grasp_opening_m, initial_placements, scene_about
from rgss.tasks import CheckStep, GripStep, MoveStep, Step, StepControl, TaskProgram, stages_of


class GripSequence:
    """Lookup of object, hand opening, thresholds and control by step.

    Attributes:
        first_grip: Name of the first step that closes the hand; empty if there is none.
        first_release: Name of the first step that opens the hand; empty if there is none.
    """

    def __init__(self, task: TaskProgram, scene: Scene, geometry: GripperGeometry) -> None:
        """Look the objects up.

        Args:
            task: The task.
            scene: The scene; its workpiece is the default object of steps.
            geometry: The gripper's shape.
        """
        placements = initial_placements(scene)
        views = {
            name: scene if name == scene.workpiece.id else scene_about(scene, name, place="", placements=placements)
            for name in placements
        }
        self._views = {stage.step.name: views[stage.object] for stage in stages_of(task, scene.workpiece.id)}
        self._steps: dict[str, Step] = {step.name: step for step in task.steps}
        self._geometry = geometry
        self.first_grip = next(iter(task.grips), "")
        self.first_release = next(iter(task.releases), "")

    def control_in(self, phase: str) -> StepControl | None:
        """Joint control of a step; None for that of the study.

        Args:
            phase: Name of the step.
        """
        step = self._steps[phase]
        return None if isinstance(step, CheckStep) else step.control

    def reached_rad(self, phase: str) -> float | None:
        """Greatest joint error at which the end of a move counts as reached; None if the move does not state it.

        Args:
            phase: Name of the step.
        """
        step = self._steps[phase]
        return step.reached_rad if isinstance(step, MoveStep) else None

    def firm_s(self, phase: str, common_s: float) -> float:
        """Required duration of a firm grasp in s.

        Args:
            phase: Name of the step.
            common_s: Default of steps that state none.
        """
        step = self._steps[phase]
        return step.firm_s if isinstance(step, GripStep) and step.firm_s is not None else common_s

    def view_of(self, phase: str) -> Scene:
        """Scene with the object of a step as its workpiece.

        Args:
            phase: Name of the step.
        """
        return self._views[phase]

    def travel_m(self, phase: str) -> float:
        """Travel in m of a finger from open to contact with the object of a step.

        Args:
            phase: Name of the step.
        """
        geometry = self._geometry
        return min(geometry.stroke_m, geometry.largest_opening_m - grasp_opening_m(self._views[phase], geometry))
