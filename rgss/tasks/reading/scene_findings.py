"""Findings about a task in a scene: unknown objects and places, configurations out of range, contradictions."""

from __future__ import annotations

import difflib
from collections.abc import Iterable, Iterator

from rgss.counted import counted
from rgss.findings import Finding
from rgss.scenes import Scene
from rgss.tasks.reading.reader import Location
from rgss.tasks.reading.task_file import LoadedTask
from rgss.tasks.stages import stages_of
from rgss.tasks.steps import CheckStep, HandAction, Mention, MoveStep, Named, Target


def task_findings(loaded: LoadedTask, *scenes: Scene) -> tuple[Finding, ...]:
    """Findings about a task in a scene, with each arm that carries it out."""
    return tuple(sorted({finding for scene in scenes for finding in _in_scene(loaded, scene)}))


def _in_scene(loaded: LoadedTask, scene: Scene) -> list[Finding]:
    found: list[Finding] = []
    start = loaded.program.start
    if start is not None:
        found += _of_mentions(loaded, scene, start.mentions, ("start",))
        found += _of_joints(loaded, scene, start)
    for step, at in zip(loaded.program.steps, loaded.places, strict=True):
        found += _of_mentions(loaded, scene, step.mentions, at)
        if isinstance(step, MoveStep):
            found += _of_joints(loaded, scene, step.target)
    found += _of_held(loaded, scene)
    found += _of_chosen_grasps(loaded, scene)
    found += _of_held_frames(loaded, scene)
    return found


def _of_held(loaded: LoadedTask, scene: Scene) -> Iterator[Finding]:
    """Checks of whether an object is held that contradict the steps before."""
    held = gripped = ""
    for step, at in zip(loaded.program.steps, loaded.places, strict=True):
        if isinstance(step, CheckStep) and step.held is not None:
            name = step.object or scene.workpiece.id
            if step.held is not (held == name):
                stated = "held: true" if step.held else "held: false"
                is_held = f"is held since {gripped!r}" if held == name else "is not held"
                message = f"{step.name!r} requires '{stated}' of {name}, which {is_held}"
                hint = f"write 'held: {str(not step.held).lower()}', or move the check"
                yield loaded.document.finding("task.held", message, at, hint=hint)
        if step.hand is HandAction.CLOSES:
            held, gripped = step.object or scene.workpiece.id, step.name
        elif step.hand is HandAction.OPENS:
            held = ""


def _of_chosen_grasps(loaded: LoadedTask, scene: Scene) -> Iterator[Finding]:
    """Grips where a move to a configuration or a pose determines the grasp, though the scene lets it be chosen."""
    if scene.task.candidates is None:
        return
    last: MoveStep | None = None
    for step, at in zip(loaded.program.steps, loaded.places, strict=True):
        if isinstance(step, MoveStep):
            last = step
        elif step.hand is HandAction.CLOSES and last is not None and not last.target.waypoint:
            kind = "configuration" if last.target.configuration_rad else "frame" if last.target.frame else "pose"
            message = (
                f"{step.name!r} grips at the {kind} of {last.name!r}, and the grasp is to be chosen among candidates"
            )
            hint = "state the grasp in the scene ('grasp: as_stated'), or move to grasp before it"
            yield loaded.document.finding("task.unused-grasp", message, at, hint=hint)


def _of_held_frames(loaded: LoadedTask, scene: Scene) -> Iterator[Finding]:
    """Moves to a frame of the object that is in the hand, which moves with it."""
    objects = {one.id: one.object for one in scene.frames}
    stages = stages_of(loaded.program, scene.workpiece.id)
    for stage, at in zip(stages, loaded.places, strict=True):
        if not (isinstance(stage.step, MoveStep) and stage.is_held):
            continue
        frame = stage.step.target.frame
        if frame and objects.get(frame) == stage.object:
            message = f"{stage.step.name!r} moves to the frame {frame!r} of {stage.object}, which is held"
            hint = "move to a frame of the world, or release the object before"
            yield loaded.document.finding("task.held-frame", message, at, hint=hint)


def _of_mentions(loaded: LoadedTask, scene: Scene, mentions: Iterable[Mention], at: Location) -> Iterator[Finding]:
    """Names that the scene does not have."""
    names = {
        Named.OBJECT: [one.workpiece.id for one in scene.objects],
        Named.PLACE: [one.id for one in scene.places],
        Named.FRAME: [one.id for one in scene.frames],
    }
    for mention in mentions:
        kind, known = mention.kind.value, names[mention.kind]
        if mention.name and mention.name not in known:
            message = f"there is no {kind} {mention.name!r}"
            near = difflib.get_close_matches(mention.name, known, n=1) if mention.kind is Named.FRAME else []
            hint = f"{kind}s: {', '.join(known)}" if known else f"list it under {kind}s in the scene"
            hint = f"did you mean {near[0]!r}?" if near else hint
            yield loaded.document.finding(f"task.unknown-{kind}", message, (*at, *mention.key), hint=hint)


def _of_joints(loaded: LoadedTask, scene: Scene, target: Target) -> Iterator[Finding]:
    angles, joints = target.configuration_rad, scene.robot.joints
    if not angles:
        return
    place = ("configurations", target.name)
    if len(angles) != len(joints):
        has = f"has {counted(len(angles), 'joint')}, the robot {scene.robot.id} has {len(joints)}"
        message = f"configuration {target.name!r} {has}"
        hint = f"joints: {', '.join(joint.name for joint in joints)}"
        yield loaded.document.finding("task.joints", message, place, hint=hint)
        return
    for index, (angle, joint) in enumerate(zip(angles, joints, strict=True)):
        if not joint.lower_rad <= angle <= joint.upper_rad:
            message = f"{joint.name} of {scene.robot.id} is at {angle:.4g}, outside its range"
            hint = f"from {joint.lower_rad:.4g} to {joint.upper_rad:.4g}"
            yield loaded.document.finding("task.joint-range", message, (*place, index), hint=hint)
