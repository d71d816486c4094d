"""Steps of a task that cannot succeed by its geometry: grips beside the object, releases beside or above the place."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

from rgss.scenes import GripperGeometry, Pose, Scene, Workpiece, corners_of, least_height_m, suction_point_of
from rgss.tasks import HandAction, MoveStep, TaskProgram, stages_of
from rgss.trials.grasp_choice import with_stated_suction
from rgss.trials.route import Leg, Route, route_of
from rgss.trials.workcell import grasp_searches_of

_EXACT_M = 1e-6


@dataclass(frozen=True, slots=True, kw_only=True)
class HandStepProblem:
    """Step that closes or opens the hand where it cannot succeed.

    Attributes:
        step: Index of the step.
        hand: Whether the step closes or opens the hand.
        object: The object.
        support: The body below the place of a release; empty for a grip.
        distance_m: Distance of the ends of the fingers from the object along the tool's axis, or of the lip of the cup
        from its place there; distance of the released object from its place, or its height above it.
        has_cup: True if the hand has a suction cup.
        is_aside: True for a release beside the place, False for one above it.
        most_m: Greatest distance or height of a release; 0 for a grip.
    """

    step: int
    hand: HandAction
    object: str
    support: str = ""
    distance_m: float
    has_cup: bool = False
    is_aside: bool = False
    most_m: float = 0.0


def hand_step_problems(
    scene: Scene, geometry: GripperGeometry, *, clearance_m: float, task: TaskProgram, friction: float = 0.0
) -> tuple[HandStepProblem, ...]:
    """Grips with the object out of reach of the hand, and releases beside the place or from more than the largest drop.

    Steps after a move to a configuration are not checked.

    Args:
        scene: The scene.
        geometry: The gripper's shape.
        clearance_m: Clearance of planned paths.
        task: The task.
        friction: Coefficient of the pads for the choice of grasp candidates; unused for a stated grasp.
    """
    if scene.task.candidates is not None:
        searches = grasp_searches_of(scene, geometry, friction=friction, clearance_m=clearance_m, task=task)
        if any(search.taken is None for search in searches):
            return ()
        scene = searches[-1].scene
    scene = with_stated_suction(scene, geometry)
    return tuple(_problems(route_of(scene, geometry, task), geometry, task, scene.workpiece))


def _problems(
    route: Route, geometry: GripperGeometry, task: TaskProgram, first: Workpiece
) -> Iterator[HandStepProblem]:
    legs, last, place_of_last = iter(route.legs), None, ""
    for index, stage in enumerate(stages_of(task, first.id)):
        if isinstance(stage.step, MoveStep):
            last, place_of_last = next(legs), stage.place
            continue
        if last is None or last.scene.workpiece.id != stage.object:
            continue
        stop = route.stops[last.goal]
        if stop.pose is None:
            continue
        if stage.step.hand is HandAction.CLOSES:
            cup, at = geometry.cup is not None, (last.scene, stop.pose, geometry)
            beside_m = _unsealed(*at, first) if cup else _beside(*at)
            if beside_m > _EXACT_M:
                yield HandStepProblem(
                    step=index, hand=stage.step.hand, object=stage.object, distance_m=beside_m, has_cup=cup
                )
        elif stage.step.hand is HandAction.OPENS:
            if stage.is_standing and stage.place != place_of_last:
                continue
            place = last.scene.place
            released = last.scene.workpiece.pose if stage.is_standing else _released(last, stop.pose)
            aside_m, height_m = _aside(last, released), _height(last, released)
            is_aside = aside_m > place.radius_m + _EXACT_M
            if is_aside or height_m > place.largest_drop_m + _EXACT_M:
                yield HandStepProblem(
                    step=index,
                    hand=stage.step.hand,
                    object=stage.object,
                    support=last.scene.place_support,
                    distance_m=aside_m if is_aside else height_m,
                    is_aside=is_aside,
                    most_m=place.radius_m if is_aside else place.largest_drop_m,
                )


def _beside(scene: Scene, tool: Pose, geometry: GripperGeometry) -> float:
    """Distance of the object beyond the ends of the fingers, along the tool's axis; negative where they reach it."""
    in_tool = tool.inverse() @ scene.workpiece.pose
    corners = (corner for part in corners_of(scene.workpiece.shape) for corner in part)
    nearest_m = min((in_tool @ Pose(position_m=corner)).position_m[2] for corner in corners)
    return nearest_m - (geometry.tip_height_m - geometry.grasp_depth_m)


def _unsealed(scene: Scene, tool: Pose, geometry: GripperGeometry, first: Workpiece) -> float:
    """Distance of a cup's lip from its place on the object along the tool's axis; 0 where it seals.

    The grasp centre is half of the largest gap and half of the first object's height below the lip.
    """
    below_m = geometry.grasp_depth_m - geometry.lip.position_m[2]
    place = scene.workpiece.pose @ Pose(position_m=suction_point_of(scene).position_m)
    gap_m = abs((tool.inverse() @ place).position_m[2] + below_m)
    largest_gap_m = 2.0 * (below_m - first.shape.half_height_m)
    return 0.0 if gap_m <= largest_gap_m + _EXACT_M else gap_m


def _released(leg: Leg, tool: Pose) -> Pose | None:
    """Pose of a carried object at the end of a move; None if it is not carried."""
    return None if leg.context.carried is None else tool @ leg.context.carried


def _height(leg: Leg, released: Pose | None) -> float:
    """Height in m of an object above its place; 0 if it is not carried."""
    if released is None:
        return 0.0
    lowest_m = least_height_m(leg.scene.workpiece.shape, released.inverse_rotate((0.0, 0.0, 1.0)))
    return released.position_m[2] + lowest_m - leg.scene.place.centre_m[2]


def _aside(leg: Leg, released: Pose | None) -> float:
    """Horizontal distance in m of an object from its place; 0 if it is not carried."""
    return 0.0 if released is None else math.dist(released.position_m[:2], leg.scene.place.centre_m[:2])
