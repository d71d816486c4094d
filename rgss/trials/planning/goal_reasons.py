"""Reasons why a waypoint has no valid configuration: reach, joint range, collision, clearance or tilt."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum

import numpy as np
from numpy.typing import NDArray

from rgss.kinematics import CollisionModel, InverseKinematics, NearestPair, position_gap_m
from rgss.scenes import JointKind, Pose

Array = NDArray[np.float64]

_AT_POSITION_M = 1e-3


class Obstacle(str, Enum):
    """Kind of obstacle to every configuration."""

    OUT_OF_REACH = "out_of_reach"
    ORIENTATION = "orientation"
    JOINT_RANGE = "joint_range"
    COLLISION = "collision"
    CLEARANCE = "clearance"
    TILT = "tilt"


@dataclass(frozen=True, slots=True, kw_only=True)
class GoalReason:
    """Reason why a pose has no valid configuration, for the configuration nearest to validity.

    Attributes:
        obstacle: Kind of the obstacle.
        configurations: Number of configurations that reach the pose within the joint ranges.
        pair: The two bodies of a collision or a clearance; None for other obstacles.
        distance_m: Distance of the pose from the origin of the first joint, or of the two bodies (negative for a
        penetration); NaN for other obstacles.
        limit_m: The arm's reach from there, or the required clearance; NaN for other obstacles.
        gap_m: Least distance of the tool centre from the position with any orientation; NaN unless no configuration has
        position and orientation within the reach.
        joint: The joint out of its range; empty for other obstacles.
        angle_rad: Its excess, or the tilt of the carried object; NaN for other obstacles.
        is_slide: True if that joint is prismatic; the excess is then `distance_m`.
    """

    obstacle: Obstacle
    configurations: int = 0
    pair: tuple[str, str] | None = None
    distance_m: float = math.nan
    limit_m: float = math.nan
    joint: str = ""
    angle_rad: float = math.nan
    is_slide: bool = False
    gap_m: float = math.nan

    def __str__(self) -> str:
        best = f"in the best of {self.configurations} configurations" if self.configurations > 1 else "in the only one"
        first, second = self.pair or ("", "")
        if self.obstacle is Obstacle.OUT_OF_REACH:
            return f"out of reach: {self._from_first_joint}"
        if self.obstacle is Obstacle.ORIENTATION:
            with_any = (
                "the tool comes to this position in other orientations alone"
                if self.gap_m < _AT_POSITION_M
                else f"the tool comes no nearer to this position than {_millimetres(self.gap_m)} in any orientation"
            )
            return f"no configuration has this position and orientation: {with_any}, {self._from_first_joint}"
        if self.obstacle is Obstacle.JOINT_RANGE:
            beyond = _millimetres(self.distance_m) if self.is_slide else f"{math.degrees(self.angle_rad):.1f}°"
            return f"joint range: {self.joint} would be {beyond} outside its range at best"
        if self.obstacle is Obstacle.COLLISION:
            return f"collision of {first} with {second}, {_millimetres(-self.distance_m)} deep, {best}"
        if self.obstacle is Obstacle.CLEARANCE:
            distance, limit = _millimetres(self.distance_m), _millimetres(self.limit_m)
            more = "more than " if distance == limit else ""
            return f"clearance: {first} is {distance} from {second}, {more}{limit} must be kept, {best}"
        return f"the object would be tilted by {math.degrees(self.angle_rad):.0f}°, {best}"

    @property
    def _from_first_joint(self) -> str:
        # A joint's frame may be anywhere on its axis: the origin is that in the URDF.
        return (
            f"{self.distance_m:.2f} m from the origin of the arm's first joint, reach {self.limit_m:.2f} m from there "
            "with the gripper"
        )


def infeasibility_reason(
    inverse: InverseKinematics, models: Sequence[CollisionModel], pose: Pose, candidates: Sequence[Array]
) -> GoalReason:
    """Reason why no configuration of a pose is valid in all adjoining moves.

    Args:
        inverse: The arm's inverse kinematics.
        models: The collision models of these moves.
        pose: Transform of the tool-centre frame to the world.
        candidates: The configurations that reach it within the joints' ranges.
    """
    if not candidates:
        return _unreached(inverse, pose)
    best: NearestPair | None = None
    tilts: list[float] = []
    for q in candidates:
        pairs = [pair for pair in (model.nearest_pair(q) for model in models) if pair is not None]
        worst = min(pairs, key=lambda pair: pair.room_m, default=None)
        if worst is None or worst.room_m > 0.0:
            tilts += [tilt for tilt in (excessive_tilt_rad(model, q) for model in models) if tilt is not None]
        # Of equally near configurations the first, so that rounding does not decide.
        if worst is not None and (best is None or worst.room_m > best.room_m + 1e-9):
            best = worst
    if tilts or best is None:
        return GoalReason(
            obstacle=Obstacle.TILT, configurations=len(candidates), angle_rad=min(tilts, default=math.nan)
        )
    # A pair exactly at the clearance, whose distance rounding may put above it, violates it.
    return GoalReason(
        obstacle=Obstacle.COLLISION if best.distance_m <= 0.0 else Obstacle.CLEARANCE,
        configurations=len(candidates),
        pair=(best.first, best.second),
        distance_m=best.distance_m,
        limit_m=best.clearance_m,
    )


def excessive_tilt_rad(model: CollisionModel, q: Array) -> float | None:
    """Tilt in rad of the carried object in a configuration if it exceeds the limit of the move, else None.

    Args:
        model: The collision model of the move.
        q: Joint positions, shape (n,).
    """
    tilt, limit = model.carried_tilt_rad(q), model.situation.largest_tilt_rad
    return tilt if tilt is not None and limit is not None and tilt > limit else None


def _unreached(inverse: InverseKinematics, pose: Pose) -> GoalReason:
    excesses = inverse.excess_of_ranges(pose)
    if excesses:
        first = excesses[0]
        if first.kind is JointKind.PRISMATIC:
            return GoalReason(
                obstacle=Obstacle.JOINT_RANGE, joint=first.joint, distance_m=first.beyond_rad, is_slide=True
            )
        return GoalReason(obstacle=Obstacle.JOINT_RANGE, joint=first.joint, angle_rad=first.beyond_rad)
    distance = math.dist(pose.position_m, inverse.arm.first_axis_m)
    reach = inverse.arm.reach_m
    if distance > reach:
        return GoalReason(obstacle=Obstacle.OUT_OF_REACH, distance_m=distance, limit_m=reach)
    gap = position_gap_m(inverse.arm, pose.position_m)
    return GoalReason(obstacle=Obstacle.ORIENTATION, distance_m=distance, limit_m=reach, gap_m=gap)


def _millimetres(metres: float) -> str:
    return f"{max(0.0, metres) * 1e3:.0f} mm" if metres >= 0.01 else f"{max(0.0, metres) * 1e3:.1f} mm"
