"""The grasp that is taken: the best candidate that the arm can reach at every waypoint, without a collision."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from enum import Enum
from typing import Protocol

from rgss.evidence import Phase
from rgss.grasping.candidates import RankedGrasp, RankedGrasps, ranked_grasps, symmetric_turns
from rgss.kinematics import Arm, CollisionModel, inverse_kinematics, straight_line
from rgss.scenes import GraspCandidates, GripperGeometry, Scene, TakenGrasp, Waypoint, waypoint_poses

_MEETING: Mapping[Waypoint, tuple[Phase, ...]] = {
    Waypoint.GRASP_APPROACH: (Phase.MOVE_TO_GRASP, Phase.MOVE_TO_GRASP_APPROACH),
    Waypoint.GRASP: (Phase.MOVE_TO_GRASP, Phase.LIFT),
    Waypoint.LIFT: (Phase.LIFT, Phase.MOVE_TO_GRASP_DEPARTURE),
    Waypoint.GRASP_DEPARTURE: (Phase.MOVE_TO_GRASP_DEPARTURE, Phase.MOVE_TO_PLACE_APPROACH),
    Waypoint.PLACE_APPROACH: (Phase.MOVE_TO_PLACE_APPROACH, Phase.MOVE_TO_PLACE),
    Waypoint.PLACE: (Phase.MOVE_TO_PLACE, Phase.MOVE_TO_GRASP_APPROACH),
}


class Rejection(str, Enum):
    """Filter that rejected a candidate."""

    REACH = "reach"
    COLLISION = "collision or clearance"
    LIFT = "straight lift"


class Cell(Protocol):
    """What a candidate is tried in: the arm, and a collision model for each move."""

    @property
    def arm(self) -> Arm:
        """Kinematics with the tool at the grasp centre."""
        ...

    @property
    def planning(self) -> Mapping[Phase, CollisionModel]:
        """Collision model of each move."""
        ...


@dataclass(frozen=True, slots=True, kw_only=True)
class GraspSearch:
    """Result of a search for a grasp.

    Attributes:
        scene: The scene with the grasp that is taken; with the best candidate where none can be reached, so that a
            plan says why, and as it was where there is no candidate.
        taken: The grasp; None where none can be reached.
        ranked: The candidates, and what was none.
        rejected: How many candidates each filter rejected before the one that is taken.
    """

    scene: Scene
    taken: TakenGrasp | None
    ranked: RankedGrasps
    rejected: Mapping[Rejection, int]

    @property
    def reasons(self) -> str:
        """What rejected how many, in one line."""
        counts = [(reason.value, count) for reason, count in self.ranked.unfit.items()]
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
    """Try the candidates in their order, each with the symmetric turns of the object at its place.

    Args:
        scene: The scene as it is perceived.
        geometry: The gripper's shape.
        options: Which grasps are tried.
        friction: Coefficient of the pads; the contact's is the product with the object's.
        build: Makes arm and collision models of a scene.
    """
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
            found = _obstacle(cell, tried)
            if found is None:
                return GraspSearch(scene=tried, taken=tried.task.grasp, ranked=ranked, rejected=dict(rejected))
            why.append(found[0])
            if found[1] in _AT_GRASP:
                break
        rejected[_last(why)] += 1
    return GraspSearch(scene=first or scene, taken=None, ranked=ranked, rejected=dict(rejected))


_AT_GRASP = (Waypoint.GRASP_APPROACH, Waypoint.GRASP, Waypoint.LIFT, Waypoint.GRASP_DEPARTURE)
_STAGES = tuple(Rejection)


def _last(reasons: Sequence[Rejection]) -> Rejection:
    """The filter that the best turn came to."""
    return max(reasons, key=_STAGES.index)


def _taken(scene: Scene, grasp: RankedGrasp, turn: float, candidates: int, rejected: int) -> TakenGrasp:
    task = scene.task
    return TakenGrasp(
        id=grasp.id,
        tool_in_object=grasp.tool_in_object,
        opening_m=grasp.opening_m,
        place_yaw_rad=math.remainder(task.place_yaw_rad - task.grasp_yaw_rad + turn, math.tau),
        quality_1=grasp.quality_1,
        com_distance_m=grasp.com_distance_m,
        candidates=candidates,
        rejected=rejected,
    )


def _with_grasp(scene: Scene, grasp: TakenGrasp) -> Scene:
    return replace(scene, task=replace(scene.task, grasp=grasp))


def _unreached(arm: Arm, scene: Scene) -> Waypoint | None:
    """The first waypoint that no configuration reaches."""
    inverse = inverse_kinematics(arm)
    return next((waypoint for waypoint, pose in waypoint_poses(scene).items() if not inverse.solve(pose)), None)


def _obstacle(cell: Cell, scene: Scene) -> tuple[Rejection, Waypoint] | None:
    """The filter that rejects a grasp, and the waypoint where it does; None where the grasp can be carried out."""
    inverse, poses = inverse_kinematics(cell.arm), waypoint_poses(scene)
    grasping = []
    for waypoint, pose in poses.items():
        reached = inverse.solve(pose)
        if not reached:
            return Rejection.REACH, waypoint
        models = [cell.planning[phase] for phase in _MEETING[waypoint]]
        valid = [q for q in reached if all(model.is_valid(q) for model in models)]
        if not valid:
            return Rejection.COLLISION, waypoint
        if waypoint is Waypoint.GRASP:
            grasping = valid
    model = cell.planning[Phase.LIFT]
    for q in grasping:
        line = straight_line(inverse, q, poses[Waypoint.LIFT])
        if line is not None and all(model.is_valid(state) for state in line):
            return None
    return Rejection.LIFT, Waypoint.LIFT
