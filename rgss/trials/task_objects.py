"""Objects of a task in contact physics: object of each phase, and displacement of the others."""

from __future__ import annotations

import math

from rgss.evidence import Failure
from rgss.physics import ContactWorld
from rgss.scenes import ObjectPlacement, Pose, Scene, initial_placements, scene_about
from rgss.tasks import HandAction, Stage, TaskProgram, stages_of
from rgss.trials.object_checks import moved_by_itself
from rgss.trials.planning import with_object_named


class TaskObjects:
    """State of the objects of a scene during a task.

    Attributes:
        first: The initial object of the world.
    """

    def __init__(self, world: ContactWorld, task: TaskProgram) -> None:
        """Start with the present poses of all objects."""
        self._world = world
        self._scene = world.scene
        self.first = self._scene.workpiece.id
        self._stages = {stage.step.name: stage for stage in stages_of(task, self.first)}
        # The scene of the world is about the first object and its own place, unless that is on another object.
        is_own = self._scene.place.offset_m is None
        self._about = (self.first, 1, "") if is_own else None
        self._supports = {name: one.support for name, one in initial_placements(self._scene).items()}
        self._around: dict[str, Pose] = {}

    def stage(self, phase: str) -> Stage:
        """Stage of a phase."""
        return self._stages[phase]

    def enter(self, stage: Stage) -> bool:
        """Begin a stage; returns True if object, place or grip differ from the previous stage."""
        about = stage.object, stage.turn, stage.place
        is_new = about != self._about
        if is_new:
            self._about = about
            self._world.set_workpiece(self._view(stage.object, stage.place))
        self._around = {
            one.workpiece.id: self._world.object_pose(one.workpiece.id)
            for one in (self._scene.objects if self._scene.others else ())
            if one.workpiece.id != stage.object
        }
        return is_new

    def displaced(self, largest_m: float) -> tuple[Failure, str] | None:
        """Violation if another object was displaced since the start of the phase.

        A contact with the robot or with the held object is a violation of its own, which precedes this one.

        Args:
            largest_m: Greatest displacement.
        """
        for name, before in self._around.items():
            now = self._world.object_pose(name)
            if math.dist(before.position_m, now.position_m) > largest_m:
                place = next(one.place for one in self._scene.objects if one.workpiece.id == name)
                return moved_by_itself(name, before, now, largest_m, place.largest_tilt_rad)
        return None

    def named(self, detail: str) -> str:
        """Detail of a failure with the id of the present object, if the scene has several.

        Args:
            detail: The detail, in which it is "the object".
        """
        return with_object_named(detail, self._world.scene)

    def resting_on(self, stage: Stage) -> str:
        """Body that the object of a stage may touch; empty for none."""
        is_brought = stage.step.hand is HandAction.OPENS and not stage.is_standing
        if is_brought or stage.is_placed:
            return self._world.scene.place_support
        if not stage.is_held or stage.is_standing:
            return self._supports[stage.object]
        return ""

    def note_release(self, stage: Stage) -> None:
        """Register a release."""
        self._supports[stage.object] = self._world.scene.place_support

    def _view(self, name: str, place: str) -> Scene:
        placements = {
            one.workpiece.id: ObjectPlacement(
                pose=self._world.object_pose(one.workpiece.id), support=self._supports[one.workpiece.id]
            )
            for one in self._scene.objects
        }
        return scene_about(self._scene, name, place=place, placements=placements)
