"""Check steps of a task whose conditions its own places exclude."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from rgss.scenes import ObjectPlacement, Pose, Scene, initial_placements, region_now, scene_about
from rgss.tasks import CheckStep, HandAction, Nearness, TaskProgram, stages_of

_EXACT_M, _EXACT_RAD = 1e-6, 1e-6


@dataclass(frozen=True, slots=True, kw_only=True)
class CheckStepProblem:
    """Condition of a check step that is violated where the task leaves the object, without any error.

    Attributes:
        step: Index of the step.
        key: Key of the condition in the task's file.
        detail: What it compares, with its numbers.
    """

    step: int
    key: str
    detail: str


def check_step_problems(scene: Scene, task: TaskProgram) -> tuple[CheckStepProblem, ...]:
    """Violated conditions of check steps, for objects at rest exactly where the scene or the last release has them.

    An object that the hand has moved is where the arm holds it, and the position of what stands on it is not known
    either: their conditions are not checked. Whether `held` agrees with the grips is found as a task's file is read.

    Args:
        scene: The scene.
        task: The task.
    """
    return tuple(_problems(scene, task))


def _problems(scene: Scene, task: TaskProgram) -> Iterator[CheckStepProblem]:
    placements = initial_placements(scene)
    for index, stage in enumerate(stages_of(task, scene.workpiece.id)):
        step = stage.step
        if step.hand is HandAction.OPENS:
            view = scene_about(scene, stage.object, place=stage.place, placements=placements)
            placements[stage.object] = ObjectPlacement(pose=view.placed_object, support=view.place_support)
        if not isinstance(step, CheckStep):
            continue
        name = step.object or stage.object
        # What stands where it was gripped has not moved.
        moved = {stage.object} if stage.is_held and not stage.is_standing else set[str]()
        for key, detail in _violated(_Known(scene, placements, moved), step, name):
            yield CheckStepProblem(step=index, key=key, detail=detail)


@dataclass(frozen=True, slots=True)
class _Known:
    """Objects that rest somewhere known.

    Attributes:
        scene: The scene.
        placements: Their placements, and the former one of an object in the hand.
        moved: The object in the hand, if it was moved.
    """

    scene: Scene
    placements: Mapping[str, ObjectPlacement]
    moved: set[str]

    def pose_of(self, name: str) -> Pose | None:
        """Pose of an object; None if it, or what it stands on, is in the moving hand."""
        beneath, seen = name, set[str]()
        while beneath in self.placements and beneath not in seen:
            if beneath in self.moved:
                return None
            seen.add(beneath)
            beneath = self.placements[beneath].support
        return self.placements[name].pose

    def place_at(self, name: str) -> tuple[tuple[float, float, float], float] | None:
        """Centre and radius of a named place; None if what bears it is not at rest."""
        named = next(one for one in self.scene.places if one.id == name)
        if named.region.offset_m is not None and self.pose_of(named.support) is None:
            return None
        region = region_now(self.scene, named.region, named.support, lambda bearing: self.placements[bearing].pose)
        return region.centre_m, region.radius_m


def _violated(known: _Known, step: CheckStep, name: str) -> Iterator[tuple[str, str]]:
    """Key and detail of each condition on a resting object that it does not meet."""
    pose = known.pose_of(name)
    if pose is None:
        return
    about = next(one for one in known.scene.objects if one.workpiece.id == name)
    half_height_m = about.workpiece.shape.half_height_m
    place = known.place_at(step.at) if step.at else None
    if place is not None:
        (x, y, z), radius_m = place
        across_m = math.dist(pose.position_m[:2], (x, y))
        height_m = abs(pose.position_m[2] - z - half_height_m)
        if max(across_m, height_m) > radius_m + _EXACT_M:
            off = f" and {height_m * 1e3:.4g} mm off its height there" if height_m > radius_m + _EXACT_M else ""
            yield "at", f"{name} is {across_m * 1e3:.4g} mm from {step.at}{off}, at most {radius_m * 1e3:.4g} mm"
    if step.near is not None:
        point_m = _point(known, step.near, half_height_m)
        distance_m = 0.0 if point_m is None else math.dist(pose.position_m, point_m)
        if distance_m > step.near.within_m + _EXACT_M:
            far = f"the centre of {name} is {distance_m * 1e3:.4g} mm from {_named(step.near)}"
            yield "near", f"{far}, at most {step.near.within_m * 1e3:.4g} mm"
    if step.is_upright and pose.tilt_rad > about.place.largest_tilt_rad + _EXACT_RAD:
        tilt, most = math.degrees(pose.tilt_rad), math.degrees(about.place.largest_tilt_rad)
        yield "upright", f"{name} is tilted by {tilt:.4g} deg, at most {most:.4g} deg"


def _point(known: _Known, near: Nearness, half_height_m: float) -> tuple[float, float, float] | None:
    """Reference point of a nearness condition; None if it is not known."""
    if near.point_m is not None:
        return near.point_m
    if near.object:
        pose = known.pose_of(near.object)
        return None if pose is None else pose.position_m
    place = known.place_at(near.place)
    if place is None:
        return None
    (x, y, z), _ = place
    return x, y, z + half_height_m


def _named(near: Nearness) -> str:
    if near.point_m is not None:
        return "the point"
    return f"that of {near.object}" if near.object else f"its position at {near.place}"
