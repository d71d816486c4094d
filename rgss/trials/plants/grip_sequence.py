"""Objects that the hand grips and releases in each step of a task, and how far it opens round them."""

from __future__ import annotations

from rgss.scenes import GripperGeometry, Scene, Workpiece, grasp_opening_m, initial_standings, scene_about
from rgss.tasks import TaskProgram, stages_of


class GripSequence:
    """The object that is concerned in each step of a task.

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
        self._geometry = geometry
        self.first_grip = next(iter(task.grips), "")
        self.first_release = next(iter(task.releases), "")

    def object_of(self, phase: str) -> Workpiece:
        """The object that a step concerns.

        Args:
            phase: Name of the step.
        """
        return self._views[phase].workpiece

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
