"""Reader of scene files and their robot files."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path

from rgss.documents import Document, load_document
from rgss.errors import DocumentError
from rgss.findings import Finding
from rgss.scenes.document import BodyEntry, GraspRule, Rest, SceneDocument
from rgss.scenes.findings import Location, named_file_findings, negative, not_positive
from rgss.scenes.frames import ROBOT, WORLD, NamedFrame, frames_of
from rgss.scenes.objects import (
    candidates_of,
    colour_of,
    name_findings,
    named_places,
    object_colour,
    object_lengths,
    object_solid,
    other_objects,
    other_solids,
    place_limits,
    positive_values,
    support_findings,
    supports_of,
    workpiece_of,
)
from rgss.scenes.pose import Pose
from rgss.scenes.robot import Robot
from rgss.scenes.robot_file import load_robot
from rgss.scenes.scene import Scene, SceneBody, Task
from rgss.scenes.shapes import Box, Cylinder, Shape
from rgss.scenes.uncertainty import read_uncertainty, unknown_objects


def load_scene(path: Path, *, label: str | None = None, project: Path | None = None, arm: str = "") -> Scene:
    """Read a scene with its robot, or with another one in its place.

    Args:
        path: The scene file; the path of the robot file is relative to it.
        label: The file's name in messages; the path by default.
        project: The folder that must contain all referenced files; that of the scene by default.
        arm: Robot file, relative to the project, of the arm in the place of the scene's; the scene's own by default.

    Raises:
        DocumentError: A file is invalid; with every problem in it and in the referenced files.
    """
    loaded = load_document(path, SceneDocument, label=label)
    entry, document = loaded.value, loaded.document
    findings = [
        *_body_findings(entry, document),
        *_workpiece_findings(entry, document),
        *_drop_findings(entry, document),
        *_free_yaw_findings(entry, document),
        *name_findings(entry, document),
        *support_findings(entry, document),
        *not_positive(document, (*_positive_values(entry), *positive_values(entry))),
        *negative(document, _values_from_zero(entry)),
    ]
    uncertainty = read_uncertainty(entry.uncertainty, entry.correlations, document, findings, declared=())
    others_ids = [one.id for one in entry.workpieces]
    findings += unknown_objects(entry.uncertainty, document, first=entry.workpiece.id, further=others_ids)
    top = path.parent if project is None else project
    robot = _read_robot(top / arm, arm, entry, findings, top) if arm else _robot(path, entry, document, findings, top)
    solid = object_solid(path, entry.workpiece, document, findings, top)
    others = other_solids(path, entry, document, findings, top)
    frames = _frames(entry, document, findings, robot)
    if findings or robot is None or solid is None:
        raise DocumentError(sorted(findings))
    solids = zip((entry.workpiece, *entry.workpieces), (solid, *others), strict=True)
    half_heights_m = {one.id: found.shape.half_height_m for one, found in solids}
    supports = supports_of(entry, {body.id: _top(body) for body in entry.bodies}, half_heights_m)
    workpiece, place = entry.workpiece, entry.place_region
    return Scene(
        id=entry.scene,
        gravity_m_s2=entry.gravity,
        robot=robot,
        bodies=tuple(_body(body) for body in entry.bodies),
        support=workpiece.stands_on,
        place_support=place.stands_on,
        workpiece=workpiece_of(
            workpiece, solid, pose=supports.poses[workpiece.id], colour=object_colour(workpiece.colour, 0)
        ),
        place=supports.region(place),
        others=other_objects(entry, others, supports),
        places=named_places(entry, supports),
        task=Task(
            approach_height_m=entry.task.approach_height,
            lift_height_m=entry.task.lift_height,
            departure_height_m=entry.task.departure_height,
            place_approach_height_m=entry.task.place_approach_height,
            place_clearance_m=entry.task.place_clearance,
            largest_carry_tilt_rad=entry.task.largest_carry_tilt,
            grasp_yaw_rad=entry.task.grasp_yaw,
            place_yaw_rad=entry.task.place_yaw,
            candidates=candidates_of(entry.task.grasp),
            is_yaw_free=entry.task.free_yaw,
        ),
        uncertainty=uncertainty,
        frames=frames,
    )


def _frames(
    entry: SceneDocument, document: Document, findings: list[Finding], robot: Robot | None
) -> tuple[NamedFrame, ...]:
    """Frames of robot and scene; none if the robot is invalid."""
    if robot is None:
        return ()
    own = {one.id: replace(one, pose=robot.base @ one.pose, is_on_robot=True) for one in robot.frames}
    roots = {
        WORLD: NamedFrame(id=WORLD, pose=Pose()),
        ROBOT: NamedFrame(id=ROBOT, pose=robot.base, is_on_robot=True),
        **{name: NamedFrame(id=name, pose=Pose(), object=name) for name in _object_ids(entry)},
        **own,
    }
    return (*own.values(), *frames_of(entry.frames, roots, document, findings, default=WORLD))


def _object_ids(entry: SceneDocument) -> tuple[str, ...]:
    return (entry.workpiece.id, *(one.id for one in entry.workpieces))


def _robot(
    path: Path, entry: SceneDocument, document: Document, findings: list[Finding], project: Path
) -> Robot | None:
    """Robot of a scene; None if it is invalid, with findings added."""
    placement = entry.robot
    location = ("robot", "description")
    problems = list(named_file_findings(document, placement.description, location, folder=path.parent, project=project))
    if problems:
        findings.extend(problems)
        return None
    label = (Path(document.label).parent / placement.description).as_posix()
    return _read_robot(path.parent / placement.description, label, entry, findings, project)


def _read_robot(path: Path, label: str, entry: SceneDocument, findings: list[Finding], project: Path) -> Robot | None:
    """Robot at the base of the scene; None if it is invalid, with findings added."""
    placement = entry.robot
    base = Pose.from_roll_pitch_yaw(placement.base, (placement.roll, placement.pitch, placement.yaw))
    try:
        return load_robot(path, base=base, label=label, project=project)
    except DocumentError as error:
        findings.extend(error.findings)
        return None


def _body_findings(entry: SceneDocument, document: Document) -> Iterable[Finding]:
    seen: set[str] = set()
    for index, body in enumerate(entry.bodies):
        if body.id in seen:
            yield document.finding(
                "scene.duplicate-id", f"id {body.id!r} is taken by an earlier body", ("bodies", index, "id")
            )
        seen.add(body.id)
        if (body.box is None) == (body.cylinder is None):
            yield document.finding(
                "scene.shape", f"body {body.id!r} needs exactly one of 'box' and 'cylinder'", ("bodies", index)
            )


def _workpiece_findings(entry: SceneDocument, document: Document) -> Iterable[Finding]:
    bodies = list(dict.fromkeys(body.id for body in entry.bodies))
    if entry.workpiece.id in bodies:
        yield document.finding(
            "scene.duplicate-id", f"id {entry.workpiece.id!r} is taken by a body", ("workpiece", "id")
        )


def _drop_findings(entry: SceneDocument, document: Document) -> Iterable[Finding]:
    clearance, largest = entry.task.place_clearance, entry.place_region.largest_drop
    if clearance > largest >= 0.0:
        yield document.finding(
            "scene.drop",
            f"a place_clearance of {clearance * 1e3:g} mm drops the object from more than {largest * 1e3:g} mm",
            ("task", "place_clearance"),
            hint="release it lower, or increase largest_drop of place_region",
        )
    speed, limit = math.sqrt(2.0 * max(0.0, entry.gravity * clearance)), entry.workpiece.landing_limit
    if speed > limit > 0.0:
        yield document.finding(
            "scene.landing",
            f"a place_clearance of {clearance * 1e3:g} mm lands the object with {speed:.2f} m/s, "
            f"above its limit of {limit:g} m/s",
            ("task", "place_clearance"),
            hint="release it lower, or increase landing_limit of the workpiece",
        )


def _free_yaw_findings(entry: SceneDocument, document: Document) -> Iterable[Finding]:
    if not entry.task.free_yaw:
        return
    is_round = all(
        one.box is None and one.mesh is None and one.rests is Rest.UPRIGHT
        for one in (entry.workpiece, *entry.workpieces)
    )
    if not is_round or entry.task.grasp is not GraspRule.AS_STATED:
        message = "free_yaw requires that every object is an upright cylinder gripped from above"
        hint = "remove free_yaw, or set grasp to as_stated"
        yield document.finding("scene.free-yaw", message, ("task", "free_yaw"), hint=hint)


def _positive_values(entry: SceneDocument) -> Iterable[tuple[Location, float]]:
    for index, body in enumerate(entry.bodies):
        if body.box is not None:
            for axis, length in enumerate(body.box):
                yield ("bodies", index, "box", axis), length
        if body.cylinder is not None:
            yield ("bodies", index, "cylinder", "radius"), body.cylinder.radius
            yield ("bodies", index, "cylinder", "height"), body.cylinder.height
    work, place, task = entry.workpiece, entry.place_region, entry.task
    yield ("gravity",), entry.gravity
    yield from object_lengths(work)
    # What nothing can grip needs no study; a body may be smooth.
    yield ("workpiece", "friction"), work.friction
    yield ("workpiece", "force_limit"), work.force_limit
    yield ("workpiece", "force_window"), work.force_window
    yield ("workpiece", "landing_limit"), work.landing_limit
    yield from place_limits(place, at=("place_region",))
    yield ("task", "approach_height"), task.approach_height
    yield ("task", "lift_height"), task.lift_height
    yield ("task", "departure_height"), task.departure_height
    yield ("task", "place_approach_height"), task.place_approach_height
    yield ("task", "largest_carry_tilt"), task.largest_carry_tilt


def _values_from_zero(entry: SceneDocument) -> Iterable[tuple[Location, float]]:
    for index, body in enumerate(entry.bodies):
        yield ("bodies", index, "friction"), body.friction
    yield ("place_region", "largest_drop"), entry.place_region.largest_drop
    yield ("task", "place_clearance"), entry.task.place_clearance


def _top(body: BodyEntry) -> float:
    return body.foot[2] + 2 * _shape(body).half_height_m


def _shape(body: BodyEntry) -> Shape:
    if body.box is not None:
        return Box(size_m=body.box)
    if body.cylinder is None:
        raise AssertionError("checked before: a body has a box or a cylinder")
    return Cylinder(radius_m=body.cylinder.radius, height_m=body.cylinder.height)


def _body(body: BodyEntry) -> SceneBody:
    shape = _shape(body)
    x, y, z = body.foot
    return SceneBody(
        id=body.id,
        shape=shape,
        pose=Pose.from_roll_pitch_yaw((x, y, z + shape.half_height_m), (0.0, 0.0, body.yaw)),
        friction=body.friction,
        colour=colour_of(body.colour),
        moves_with_robot=body.moves_with_robot,
    )
