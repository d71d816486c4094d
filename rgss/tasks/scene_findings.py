"""Findings about a task in a scene: unknown objects and places, configurations out of range."""

from __future__ import annotations

from collections.abc import Iterator

from rgss.findings import Finding
from rgss.scenes import Scene
from rgss.tasks.check_step import CheckStep
from rgss.tasks.grip_step import GripStep
from rgss.tasks.move_step import MoveStep, Target
from rgss.tasks.release_step import ReleaseStep
from rgss.tasks.task_file import LoadedTask, Location


def task_findings(loaded: LoadedTask, scene: Scene) -> tuple[Finding, ...]:
    """Findings about a task in a scene.

    Args:
        loaded: The task with its positions in the file.
        scene: The scene.
    """
    found: list[Finding] = []
    program = loaded.program
    if program.start is not None:
        found += _of_target(loaded, scene, program.start, ("start",))
    for step, at in zip(program.steps, loaded.places, strict=True):
        if isinstance(step, MoveStep):
            found += _of_target(loaded, scene, step.target, at)
        elif isinstance(step, (GripStep, CheckStep)):
            found += _of_object(loaded, scene, step.object, at)
        if isinstance(step, CheckStep):
            found += _of_place(loaded, scene, step.at, (*at, "at"))
            if step.near is not None:
                found += _of_place(loaded, scene, step.near.place, (*at, "near", "place"))
                found += _of_object(loaded, scene, step.near.object, (*at, "near", "object"))
        elif isinstance(step, ReleaseStep):
            found += _of_place(loaded, scene, step.place, (*at, "place"))
    return tuple(sorted(set(found)))


def _of_target(loaded: LoadedTask, scene: Scene, target: Target, at: Location) -> Iterator[Finding]:
    yield from _of_object(loaded, scene, target.object, at)
    yield from _of_place(loaded, scene, target.place, (*at, "place"))
    angles, joints = target.configuration_rad, scene.robot.joints
    if not angles:
        return
    place = ("configurations", target.name)
    if len(angles) != len(joints):
        message = f"configuration {target.name!r} has {len(angles)} joints, the robot has {len(joints)}"
        hint = f"joints: {', '.join(joint.name for joint in joints)}"
        yield loaded.document.finding("task.joints", message, place, hint=hint)
        return
    for index, (angle, joint) in enumerate(zip(angles, joints, strict=True)):
        if not joint.lower_rad <= angle <= joint.upper_rad:
            message = f"{joint.name} is at {angle:.4g}, outside its range"
            hint = f"from {joint.lower_rad:.4g} to {joint.upper_rad:.4g}"
            yield loaded.document.finding("task.joint-range", message, (*place, index), hint=hint)


def _of_object(loaded: LoadedTask, scene: Scene, name: str, at: Location) -> Iterator[Finding]:
    known = [one.workpiece.id for one in scene.objects]
    if name and name not in known:
        message = f"there is no object {name!r}"
        yield loaded.document.finding("task.unknown-object", message, at, hint=f"objects: {', '.join(known)}")


def _of_place(loaded: LoadedTask, scene: Scene, name: str, at: Location) -> Iterator[Finding]:
    known = [one.id for one in scene.places]
    if name and name not in known:
        hint = f"places: {', '.join(known)}" if known else "list it under places in the scene"
        yield loaded.document.finding("task.unknown-place", f"there is no place {name!r}", at, hint=hint)
