"""Object and finger travel of each step of a task."""

from __future__ import annotations

from rgss.scenes import GripperGeometry, Scene, grasp_opening_m, initial_placements, scene_about
from rgss.tasks import Step, TaskProgram, stages_of


class GripSequence:
    """Lookup of object and finger travel by step."""

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
        stages = stages_of(task, scene.workpiece.id)
        self._views = {stage.step.name: views[stage.object] for stage in stages}
        self._lifted = {stage.step.name for stage in stages if stage.is_held and not stage.is_standing}
        self._geometry = geometry

    def view_of(self, step: Step) -> Scene:
        """Scene with the object of a step as its workpiece."""
        return self._views[step.name]

    def is_lifted(self, step: Step) -> bool:
        """True if the hand alone holds the object during a step."""
        return step.name in self._lifted

    def travel_m(self, step: Step) -> float:
        """Travel in m of a finger from open to contact with the object of a step."""
        geometry = self._geometry
        return min(geometry.stroke_m, geometry.largest_opening_m - grasp_opening_m(self.view_of(step), geometry))
