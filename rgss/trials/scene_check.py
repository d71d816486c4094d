"""Checks of a scene: overlapping bodies, unsupported objects, unreachable waypoints."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from enum import Enum

from rgss.kinematics import CLOSING_ROOM_M, ClosingLinks, Overlap, Solid, overlaps
from rgss.scenes import (
    Box,
    Cylinder,
    GripperGeometry,
    ObjectShape,
    Pose,
    Scene,
    corners_of,
    foot_of,
    half_extents_m,
    initial_placements,
    misfit,
    scene_about,
)
from rgss.tasks import TaskProgram
from rgss.trials.grasp_choice import GraspSearch, with_stated_suction
from rgss.trials.planning import GoalReason, infeasible_waypoints, objects_served_turned, serving_place_yaw
from rgss.trials.workcell import Workcell, grasp_searches_of

TOUCHING_M = 1e-3
"""Tolerance in m of overlaps between touching bodies, since sizes in files are rounded to millimetres."""

OBJECT_TOUCHING_M = 1e-4
"""Tolerance in m of overlaps of the object, which the physics would eject from an overlap."""

DEEP = 0.5
"""Tolerance of overlaps between fixed bodies, as a share of the thinner body; more counts as an error."""

_RIM = 16


class SceneProblemKind(str, Enum):
    """Kind of a scene problem."""

    OVERLAP = "overlap"
    INSIDE = "inside"
    OBJECT_OVERLAP = "object_overlap"
    PLACE_OVERLAP = "place_overlap"
    OBJECT_UNSUPPORTED = "object_unsupported"
    PLACE_UNSUPPORTED = "place_unsupported"
    OBJECT_UNSTABLE = "object_unstable"
    HOME_COLLISION = "home_collision"
    UNSERVED = "unserved"
    NO_GRASP = "no_grasp"
    CLOSING = "closing"


@dataclass(frozen=True, slots=True, kw_only=True)
class SceneProblem:
    """Problem of a scene.

    Attributes:
        kind: Kind of the problem.
        first: The body, or the robot's link.
        second: The other body; empty if there is none.
        distance_m: Penetration depth of an overlap, or of a closing hand (negative if it only comes near it), or
        distance of the object's centre of mass beyond the edge of its support, or outside its foot; NaN for other
        problems.
        waypoint: The waypoint without a configuration, of the best candidate if no grasp can be carried out; None for
        other problems.
        is_at_place: True if it is a waypoint at the place, of which `second` is the name, if it has one.
        reason: The reason; None for other problems.
        serves_turned: True if the hand turned by 180 deg, which holds the object alike, has no unserved waypoint of it.
        is_yaw_stated: True if the task states the yaw of the hand there, and neither chooses it nor leaves it free.
        place_yaw_rad: Yaw at the place with which the arm would serve every waypoint; None if it is unknown.
        detail: Numbers of grasp candidates rejected by each filter, or the kind of a foot; empty for other problems.
    """

    kind: SceneProblemKind
    first: str
    second: str = ""
    distance_m: float = math.nan
    waypoint: str | None = None
    is_at_place: bool = False
    reason: GoalReason | None = None
    detail: str = ""
    serves_turned: bool = False
    is_yaw_stated: bool = False
    place_yaw_rad: float | None = None


def scene_problems(scene: Scene) -> tuple[SceneProblem, ...]:
    """Problems of the bodies of a scene, independent of the gripper."""
    return (*_furniture(scene), *_objects(scene))


def reach_problems(
    scene: Scene, geometry: GripperGeometry, *, clearance_m: float, task: TaskProgram, friction: float = 0.0
) -> tuple[SceneProblem, ...]:
    """Problems of the arm with a gripper: a collision at home, or a waypoint without a valid configuration.

    Args:
        scene: The scene.
        geometry: The gripper's shape.
        clearance_m: Clearance of planned paths.
        friction: Coefficient of the pads for the choice of grasp candidates; unused for a stated grasp.
        task: The task.

    Raises:
        DefinitionError: The robot is ill defined.
    """
    found: list[SceneProblem] = []
    ungrasped: list[GraspSearch] = []
    if scene.task.candidates is not None:
        searches = grasp_searches_of(scene, geometry, friction=friction, clearance_m=clearance_m, task=task)
        scene = searches[-1].scene
        ungrasped = [search for search in searches if search.taken is None]
    stated, scene = scene, with_stated_suction(scene, geometry)
    cell = Workcell(scene, geometry, clearance_m=clearance_m, task=task)
    pair = next(iter(cell.planning.values())).nearest_pair(scene.robot.home_rad)
    if pair is not None and pair.distance_m < 0.0:
        found.append(
            SceneProblem(
                kind=SceneProblemKind.HOME_COLLISION, first=pair.first, second=pair.second, distance_m=-pair.distance_m
            )
        )
    if ungrasped:
        return (*found, *_without_grasp(ungrasped, cell))
    found += _closing_contacts(scene, geometry)
    unserved = infeasible_waypoints(cell)
    turned = objects_served_turned(scene, geometry, unserved, clearance_m=clearance_m, task=task)
    yaw_rad = None if turned else serving_place_yaw(stated, geometry, unserved, clearance_m=clearance_m, task=task)
    found += [
        SceneProblem(
            kind=SceneProblemKind.UNSERVED,
            first=stop.object or scene.workpiece.id,
            second=stop.place if stop.is_at_place else "",
            waypoint=stop.name,
            is_at_place=stop.is_at_place,
            reason=reason,
            serves_turned=(stop.object or scene.workpiece.id) in turned,
            is_yaw_stated=scene.task.candidates is None and bool(stop.object) and not stop.is_turn_free,
            place_yaw_rad=yaw_rad,
        )
        for stop, reason in unserved.items()
    ]
    return tuple(found)


def _closing_contacts(scene: Scene, geometry: GripperGeometry) -> Iterator[SceneProblem]:
    """Objects that a link of the hand meets before the pads do; a chosen grasp has none."""
    placements, links = initial_placements(scene), ClosingLinks(geometry)
    for one in scene.objects:
        name = one.workpiece.id
        view = scene_about(scene, name, place="", placements=placements)
        contact = None if misfit(geometry, view) else links.contact(view, clearance_m=CLOSING_ROOM_M)
        if contact is not None:
            yield SceneProblem(
                kind=SceneProblemKind.CLOSING, first=name, second=contact.link, distance_m=-contact.distance_m
            )


def _without_grasp(searches: Sequence[GraspSearch], cell: Workcell) -> Iterator[SceneProblem]:
    """Objects of which every candidate was rejected, with the first waypoint that the best of them does not serve."""
    unserved = infeasible_waypoints(cell) if any(search.has_best for search in searches) else {}
    for search in searches:
        problem = SceneProblem(kind=SceneProblemKind.NO_GRASP, first=search.object, detail=search.reasons)
        stops = [stop for stop in unserved if stop.object == search.object]
        if search.has_best and stops:
            problem = replace(problem, waypoint=stops[0].name, reason=unserved[stops[0]])
        yield problem


def _furniture(scene: Scene) -> Iterator[SceneProblem]:
    solids = {body.id: Solid(name=body.id, shape=body.shape, pose=body.pose) for body in scene.bodies}
    for one in overlaps(tuple(solids.values()), deeper_than_m=TOUCHING_M):
        first, second = solids[one.first], solids[one.second]
        if _holds(second, first):
            yield _of(SceneProblemKind.INSIDE, one)
        elif _holds(first, second):
            yield SceneProblem(kind=SceneProblemKind.INSIDE, first=one.second, second=one.first, distance_m=one.depth_m)
        else:
            thinner = min(_least_extent(first.shape), _least_extent(second.shape))
            if one.depth_m > DEEP * thinner:
                yield _of(SceneProblemKind.OVERLAP, one)


def _objects(scene: Scene) -> Iterator[SceneProblem]:
    bodies = [Solid(name=body.id, shape=body.shape, pose=body.pose) for body in scene.bodies]
    placements = initial_placements(scene)
    standing: list[Solid] = []
    for one in scene.objects:
        name = one.workpiece.id
        around = [
            Solid(name=other.workpiece.id, shape=other.workpiece.shape, pose=other.workpiece.pose)
            for other in scene.objects
            if other.workpiece.id != name
        ]
        yield from _object(scene_about(scene, name, place="", placements=placements), bodies, [*bodies, *around])
        solid = Solid(name=name, shape=one.workpiece.shape, pose=one.workpiece.pose)
        for other in standing:
            for found in overlaps((solid, other), deeper_than_m=OBJECT_TOUCHING_M):
                yield _of(SceneProblemKind.OBJECT_OVERLAP, found)
        standing.append(solid)


def _object(scene: Scene, bodies: Sequence[Solid], supports: Sequence[Solid]) -> Iterator[SceneProblem]:
    """Problems of the workpiece of a scene with fixed bodies, at the start and in its place.

    A place on another object is where that object is when the task comes to it: plans check it against the bodies.
    """
    workpiece = scene.workpiece
    x, y, z = scene.place.centre_m
    placed = scene.placed_object
    if isinstance(workpiece.shape, Cylinder):
        placed = Pose(position_m=(x, y, z + workpiece.shape.half_height_m))
    foot = foot_of(workpiece)
    if not foot.is_stable:
        yield SceneProblem(
            kind=SceneProblemKind.OBJECT_UNSTABLE,
            first=workpiece.id,
            second=scene.support,
            distance_m=foot.outside_m,
            detail=foot.kind.value,
        )
    ends = (
        (workpiece.pose, scene.support, SceneProblemKind.OBJECT_OVERLAP, SceneProblemKind.OBJECT_UNSUPPORTED),
        (
            placed,
            scene.place_support,
            SceneProblemKind.PLACE_OVERLAP,
            SceneProblemKind.PLACE_UNSUPPORTED,
        ),
    )
    for pose, support, overlap, unsupported in ends:
        solid = Solid(name=workpiece.id, shape=workpiece.shape, pose=pose)
        is_stacked = overlap is SceneProblemKind.PLACE_OVERLAP and scene.place.offset_m is not None
        for body in () if is_stacked else bodies:
            for one in overlaps((solid, body), deeper_than_m=OBJECT_TOUCHING_M):
                yield _of(overlap, one)
        bearing = next(one for one in supports if one.name == support)
        resting = pose if overlap is SceneProblemKind.OBJECT_OVERLAP else scene.placed_object
        # A place that leaves open how the object is turned leaves open where its centre of mass comes to be.
        is_open = scene.task.is_yaw_free and pose is not workpiece.pose
        x, y = (0.0, 0.0) if is_open else workpiece.centre_of_mass_across_m
        beyond = beyond_edge(bearing, resting @ Pose(position_m=(x, y, 0.0)))
        if beyond > 0.0:
            yield SceneProblem(kind=unsupported, first=workpiece.id, second=support, distance_m=beyond)


def _of(kind: SceneProblemKind, one: Overlap) -> SceneProblem:
    return SceneProblem(kind=kind, first=one.first, second=one.second, distance_m=one.depth_m)


def beyond_edge(support: Solid, centre: Pose) -> float:
    """Distance in m of a centre of mass outside the top face of its support; 0 where it is above the face.

    Args:
        support: The support.
        centre: Pose in the world with that position.
    """
    x, y, _ = (support.pose.inverse() @ centre).position_m
    half_x_m, half_y_m, _ = half_extents_m(support.shape)
    if isinstance(support.shape, Cylinder):
        return max(0.0, math.hypot(x, y) - half_x_m)
    return math.hypot(max(0.0, abs(x) - half_x_m), max(0.0, abs(y) - half_y_m))


def _least_extent(shape: ObjectShape) -> float:
    return 2.0 * min(half_extents_m(shape))


def _holds(outer: Solid, inner: Solid) -> bool:
    """True if a solid is inside another, convex one: by its extreme points."""
    to_outer = outer.pose.inverse() @ inner.pose
    for point in _extreme_points(inner.shape):
        x, y, z = (to_outer @ Pose(position_m=point)).position_m
        if isinstance(outer.shape, Box):
            half = [size / 2 + TOUCHING_M for size in outer.shape.size_m]
            inside = abs(x) <= half[0] and abs(y) <= half[1] and abs(z) <= half[2]
        else:
            inside = math.hypot(x, y) <= half_extents_m(outer.shape)[0] + TOUCHING_M
            inside = inside and abs(z) <= outer.shape.half_height_m + TOUCHING_M
        if not inside:
            return False
    return True


def _extreme_points(shape: ObjectShape) -> list[tuple[float, float, float]]:
    """Corners of a box, or points on the rims of a cylinder."""
    if not isinstance(shape, Cylinder):
        return [corner for part in corners_of(shape) for corner in part]
    turns = [2.0 * math.pi * place / _RIM for place in range(_RIM)]
    radius, half = shape.radius_m, shape.half_height_m
    return [(radius * math.cos(t), radius * math.sin(t), z) for t in turns for z in (-half, half)]
