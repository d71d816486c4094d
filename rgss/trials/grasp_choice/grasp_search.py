"""Search for the best grasp candidate that the arm can reach at every waypoint without collision."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from enum import Enum
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from rgss.grasping.candidates import RankedGrasp, RankedGrasps, ranked_grasps, ranked_suction, symmetric_turns
from rgss.kinematics import Arm, CollisionModel, inverse_kinematics, straight_line
from rgss.scenes import ChosenGrasp, GraspCandidates, GripperGeometry, Scene, Waypoint, waypoint_poses
from rgss.tasks import MoveKind
from rgss.trials.route import Route, Stop

Vector = NDArray[np.float64]


class Rejection(str, Enum):
    """Filter that rejected a candidate."""

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
class GraspSearch:
    """Result of a search for a grasp.

    Attributes:
        scene: The scene with the chosen grasp; with the best candidate if none is reachable, so that a plan reports the
        reason; unchanged without candidates.
        taken: The chosen grasp; None if none is reachable.
        ranked: The candidates and the rejected tool frames.
        rejected: Number of candidates rejected by each filter before the chosen one.
    """

    scene: Scene
    taken: ChosenGrasp | None
    ranked: RankedGrasps
    rejected: Mapping[Rejection, int]

    @property
    def reasons(self) -> str:
        """Numbers of rejections by filter, in one line."""
        counts = [(reason.value, count) for reason, count in self.ranked.rejected_frames.items()]
        counts += [(reason.value, count) for reason, count in self.rejected.items()]
        return ", ".join(f"{reason}: {count}" for reason, count in counts)


def search_grasp(
    scene: Scene,
    geometry: GripperGeometry,
    options: GraspCandidates,
    *,
    friction: float,
    build: Callable[[Scene], Cell],
) -> GraspSearch:
    """First reachable candidate in their order, each with the symmetric rotations of the object at its place.

    Args:
        scene: The perceived scene.
        geometry: The gripper's shape.
        options: Specification of the candidates.
        friction: Coefficient of the pads; the contact's is the product with the object's. For a cup, its greatest
            tangential divided by its greatest normal force.
        build: Factory of arm and collision models of a scene.
    """
    if geometry.cup is not None:
        ranked = ranked_suction(scene.workpiece, geometry, options, tangential_1=friction)
    else:
        ranked = ranked_grasps(scene.workpiece, geometry, options, friction=friction * scene.workpiece.friction)
    turns = symmetric_turns(scene.workpiece.shape, options.yaws)
    rejected: Counter[Rejection] = Counter()
    first: Scene | None = None
    arm: Arm | None = None
    for number, grasp in enumerate(ranked.grasps):
        why: list[Rejection] = []
        for turn in turns:
            tried = _with_grasp(scene, _taken(scene, grasp, turn, len(ranked.grasps), number))
            first = first or tried
            if arm is not None and (missing := _unreached(arm, tried)):
                why.append(Rejection.REACH)
                if missing in _AT_GRASP:
                    break
                continue
            cell = build(tried)
            arm = cell.arm
            found = _obstacle(cell)
            if found is None:
                return GraspSearch(scene=tried, taken=tried.task.grasp, ranked=ranked, rejected=dict(rejected))
            why.append(found[0])
            if found[1]:
                break
        rejected[_last(why)] += 1
    return GraspSearch(scene=first or scene, taken=None, ranked=ranked, rejected=dict(rejected))


_AT_GRASP = (Waypoint.GRASP_APPROACH, Waypoint.GRASP, Waypoint.LIFT, Waypoint.GRASP_DEPARTURE)
_AT_PLACE = (Waypoint.PLACE_APPROACH, Waypoint.PLACE)
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


def _with_grasp(scene: Scene, grasp: ChosenGrasp) -> Scene:
    return replace(scene, task=replace(scene.task, grasp=grasp))


def _unreached(arm: Arm, scene: Scene) -> Waypoint | None:
    """First unreachable waypoint."""
    inverse = inverse_kinematics(arm)
    return next((waypoint for waypoint, pose in waypoint_poses(scene).items() if not inverse.solve(pose)), None)


def _obstacle(cell: Cell) -> tuple[Rejection, bool] | None:
    """Filter that rejects a grasp, and True if it does for any rotation of the object at its place; None if none."""
    inverse, route = inverse_kinematics(cell.arm), cell.route
    valid: dict[int, list[Vector]] = {}
    for index, stop in enumerate(route.stops):
        if stop.pose is None:
            continue
        reached = inverse.solve(stop.pose)
        if not reached:
            return Rejection.REACH, _is_before_place(stop)
        models = [cell.planning[leg.step.name] for leg in route.legs if index in (leg.start, leg.goal)]
        valid[index] = [q for q in reached if all(model.is_valid(q) for model in models)]
        if not valid[index]:
            return Rejection.COLLISION, _is_before_place(stop)
    for leg in route.legs:
        goal = route.stops[leg.goal]
        if leg.step.mode is not MoveKind.STRAIGHT or goal.pose is None or leg.start not in valid:
            continue
        model = cell.planning[leg.step.name]
        lines = (straight_line(inverse, q, goal.pose) for q in valid[leg.start])
        if not any(line is not None and all(model.is_valid(state) for state in line) for line in lines):
            return Rejection.LIFT, _is_before_place(goal)
    return None


def _is_before_place(stop: Stop) -> bool:
    """True if a stop is not at the place, so that the object's rotation there does not affect it."""
    return not any(stop.name.startswith(waypoint.value) for waypoint in _AT_PLACE)
