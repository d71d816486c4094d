"""Search for the best grasp candidate of each object that the arm can reach at every waypoint without collision."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from enum import Enum
from functools import partial
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from rgss.grasping.candidates import (
    OPEN_GAP_M,
    FrameRejection,
    RankedGrasp,
    RankedGrasps,
    ranked_grasps,
    ranked_suction,
    symmetric_turns,
)
from rgss.kinematics import CLOSING_ROOM_M, Arm, ClosingLinks, CollisionModel, inverse_kinematics, straight_line
from rgss.scenes import ChosenGrasp, GraspCandidates, GripperGeometry, Scene, initial_placements, scene_about
from rgss.tasks import MoveKind, TaskProgram, stages_of
from rgss.trials.route import Leg, Route, route_of

Vector = NDArray[np.float64]


class Rejection(str, Enum):
    """Filter that rejected a candidate."""

    CLOSING = "a link of the hand while it closes"
    REACH = "reach"
    COLLISION = "collision or clearance"
    LIFT = "straight lift"


class Cell(Protocol):
    """Arm and collision models of the moves, for checks of a candidate."""

    @property
    def arm(self) -> Arm:
        """Kinematics with the tool at the grasp centre."""
        ...

    @property
    def planning(self) -> Mapping[str, CollisionModel]:
        """Collision model of each move by its name."""
        ...

    @property
    def route(self) -> Route:
        """Stops of the task and the moves between them."""
        ...


@dataclass(frozen=True, slots=True, kw_only=True)
class NoGrasp:
    """An object of which no grasp candidate can be carried out.

    Attributes:
        object: The object.
        reasons: Numbers of rejections by filter.
        has_best: True if there is a best candidate, for which a task is planned.
    """

    object: str
    reasons: str
    has_best: bool

    def detail(self, of_best: str) -> str:
        """Reason why the object's first move is not planned.

        Args:
            of_best: The same for the best candidate.
        """
        text = f"no grasp candidate of {self.object} can be carried out: {self.reasons}"
        return f"{text}; of the best one, {of_best}" if self.has_best else text


@dataclass(frozen=True, slots=True, kw_only=True)
class GraspSearch:
    """Result of a search for a grasp.

    Attributes:
        object: The object.
        scene: The scene with the chosen grasp; with the best candidate if none is reachable, so that a plan reports the
        reason; unchanged if there is none on which the hand can close.
        taken: The chosen grasp; None if none is reachable.
        has_best: True if the scene has a candidate, chosen or not.
        ranked: The candidates and the rejected tool frames.
        rejected: Number of candidates rejected by each filter before the chosen one.
        geometry: The gripper's shape.
    """

    object: str
    scene: Scene
    taken: ChosenGrasp | None
    has_best: bool
    ranked: RankedGrasps
    rejected: Mapping[Rejection, int]
    geometry: GripperGeometry

    @property
    def reasons(self) -> str:
        """Numbers of rejections by filter in one line, with the widths or the height of the object that did not fit."""
        counts = [(reason.value, count) for reason, count in self.ranked.rejected_frames.items()]
        counts += [(reason.value, count) for reason, count in self.rejected.items()]
        if not counts and not self.ranked.grasps:
            if self.geometry.cup is not None:
                return "its shape has no flat face for the cup"
            return "its shape has no two surfaces that face each other within the friction of the pads"
        text = ", ".join(f"{reason}: {count}" for reason, count in counts)
        low = f"; {self.ranked.too_low}" if self.ranked.too_low and Rejection.COLLISION in self.rejected else ""
        return text + (low if self.ranked.grasps else self._widths())

    @property
    def no_grasp(self) -> NoGrasp | None:
        """The object and the reasons, if no candidate can be carried out."""
        if self.taken is not None:
            return None
        return NoGrasp(object=self.object, reasons=self.reasons, has_best=self.has_best)

    def _widths(self) -> str:
        """Width of the object, where it is nearest to what the gripper takes, and the end of the gripper's range."""
        texts = []
        for why, opening_m in self.ranked.nearest_opening_m.items():
            if why is FrameRejection.TOO_WIDE:
                end_m = self.geometry.largest_opening_m
                gripper = (
                    f"opens to {2e3 * end_m:.4g} mm, which leaves room for {2e3 * (end_m - OPEN_GAP_M):.4g} mm at most"
                )
            else:
                gripper = f"closes to {2e3 * self.geometry.least_opening_m:.4g} mm"
            texts.append(f"; {2e3 * opening_m:.4g} mm across at best, and the gripper {gripper}")
        return "".join(texts)


def search_grasps(
    scene: Scene,
    geometry: GripperGeometry,
    options: GraspCandidates,
    *,
    friction: float,
    clearance_m: float,
    task: TaskProgram,
    build: Callable[[Scene], Cell],
) -> tuple[GraspSearch, ...]:
    """Search for a grasp of each object of a task, in the order in which the task comes to them.

    The grasp of an object affects the stops of the others only by its pose after its release, so that each search
    continues from the scene of the one before it.

    Args:
        scene: The perceived scene.
        geometry: The gripper's shape.
        options: Specification of the candidates.
        friction: Coefficient of the pads; the contact's is the product with the object's. For a cup, its greatest
            tangential divided by its greatest normal force.
        clearance_m: Clearance of planned paths.
        task: The task.
        build: Factory of arm and collision models of a scene.
    """
    found: list[GraspSearch] = []
    for name in dict.fromkeys(stage.object for stage in stages_of(task, scene.workpiece.id)):
        found.append(
            _search(scene, name, geometry, options, friction=friction, clearance_m=clearance_m, task=task, build=build)
        )
        scene = found[-1].scene
    return tuple(found)


def _search(
    scene: Scene,
    name: str,
    geometry: GripperGeometry,
    options: GraspCandidates,
    *,
    friction: float,
    clearance_m: float,
    task: TaskProgram,
    build: Callable[[Scene], Cell],
) -> GraspSearch:
    """First reachable candidate in their order, each with the symmetric rotations of the object at its place."""
    workpiece = next(one.workpiece for one in scene.objects if one.workpiece.id == name)
    if geometry.cup is not None:
        # The grasp centre of a cup is fitted to the height of the first object.
        depth_m = scene.workpiece.shape.half_height_m
        ranked = ranked_suction(workpiece, geometry, options, tangential_1=friction, depth_m=depth_m)
    else:
        contact = friction * workpiece.friction
        ranked = ranked_grasps(workpiece, geometry, options, friction=contact, clearance_m=clearance_m)
    found = partial(GraspSearch, object=name, ranked=ranked, geometry=geometry)
    turns = symmetric_turns(workpiece.shape, options.yaws)
    placements, links = initial_placements(scene), ClosingLinks(geometry)
    rejected: Counter[Rejection] = Counter()
    first: Scene | None = None
    arm: Arm | None = None
    for number, grasp in enumerate(ranked.grasps):
        why: list[Rejection] = []
        for turn in turns:
            taken = _taken(scene, grasp, turn, len(ranked.grasps), number)
            tried = scene.with_grasps({name: taken})
            # The rotation at the place does not change the object's pose in the hand.
            if not why and _is_met(links, scene_about(tried, name, place="", placements=placements)):
                why.append(Rejection.CLOSING)
                break
            first = first or tried
            # Inverse kinematics is solved before the collision models are built, which takes longer.
            reason = None if arm is None else _unreached(arm, route_of(tried, geometry, task), name)
            if reason is None:
                cell = build(tried)
                arm = cell.arm
                reason = _obstacle(cell, name)
            if reason is None:
                return found(scene=tried, taken=taken, has_best=True, rejected=dict(rejected))
            why.append(reason[0])
            if reason[1]:
                break
        rejected[_last(why)] += 1
    return found(scene=first or scene, taken=None, has_best=first is not None, rejected=dict(rejected))


def _is_met(links: ClosingLinks, view: Scene) -> bool:
    """True if a link of the hand comes to the object before the pads do."""
    return links.contact(view, clearance_m=CLOSING_ROOM_M) is not None


_STAGES = tuple(Rejection)


def _last(reasons: Sequence[Rejection]) -> Rejection:
    """The last filter that a rotation reached."""
    return max(reasons, key=_STAGES.index)


def _taken(scene: Scene, grasp: RankedGrasp, turn: float, candidates: int, rejected: int) -> ChosenGrasp:
    task = scene.task
    return ChosenGrasp(
        id=grasp.id,
        tool_in_object=grasp.tool_in_object,
        opening_m=grasp.opening_m,
        place_yaw_rad=math.remainder(task.place_yaw_rad - task.grasp_yaw_rad + turn, math.tau),
        quality_1=grasp.quality_1,
        com_distance_m=grasp.com_distance_m,
        candidates=candidates,
        rejected=rejected,
        suction=grasp.suction,
    )


def _legs_about(route: Route, name: str) -> list[Leg]:
    """Moves to, with and from an object."""
    return [leg for leg in route.legs if leg.scene.workpiece.id == name]


def _stops_of(legs: Sequence[Leg]) -> list[int]:
    """Indices of the stops of some moves, in the order of the route."""
    return sorted({index for leg in legs for index in (leg.start, leg.goal)})


def _unreached(arm: Arm, route: Route, name: str) -> tuple[Rejection, bool] | None:
    """As `_obstacle`, for the reach alone."""
    inverse = inverse_kinematics(arm)
    for index in _stops_of(_legs_about(route, name)):
        stop = route.stops[index]
        if stop.pose is not None and not inverse.solve(stop.pose):
            return Rejection.REACH, not stop.is_at_place
    return None


def _obstacle(cell: Cell, name: str) -> tuple[Rejection, bool] | None:
    """Filter that rejects a grasp, and True if it does for any rotation of the object at its place; None if none."""
    inverse, route = inverse_kinematics(cell.arm), cell.route
    legs = _legs_about(route, name)
    valid: dict[int, list[Vector]] = {}
    for index in _stops_of(legs):
        stop = route.stops[index]
        if stop.pose is None:
            continue
        reached = inverse.solve(stop.pose)
        if not reached:
            return Rejection.REACH, not stop.is_at_place
        models = [cell.planning[leg.step.name] for leg in legs if index in (leg.start, leg.goal)]
        valid[index] = [q for q in reached if all(model.is_valid(q) for model in models)]
        if not valid[index]:
            return Rejection.COLLISION, not stop.is_at_place
    for leg in legs:
        goal = route.stops[leg.goal]
        if leg.step.mode is not MoveKind.STRAIGHT or goal.pose is None or leg.start not in valid:
            continue
        model = cell.planning[leg.step.name]
        lines = (straight_line(inverse, q, goal.pose) for q in valid[leg.start])
        if not any(line is not None and all(model.is_valid(state) for state in line) for line in lines):
            return Rejection.LIFT, not goal.is_at_place
    return None
