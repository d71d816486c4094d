"""Cartesian straight-line motion of the tool within one branch of the inverse kinematics."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum

import numpy as np
from numpy.typing import NDArray

from rgss.kinematics.inverse import InverseKinematics
from rgss.scenes import Pose

Vector = NDArray[np.float64]
Quaternion = tuple[float, float, float, float]


class LineBreak(Enum):
    """Reason why a straight line of the tool ends early."""

    UNREACHABLE = "unreachable"
    BRANCH_ENDS = "branch_ends"


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class FollowedLine:
    """Straight line of the tool as far as the arm can follow it in one branch.

    Attributes:
        configurations_rad: Joint positions, shape (k, n), from the start on.
        fraction: Share of the line that they cover.
        broken: Reason why it ends there; None if it is complete.
    """

    configurations_rad: Vector
    fraction: float
    broken: LineBreak | None


def straight_line(
    inverse: InverseKinematics,
    start: Sequence[float] | Vector,
    goal: Pose,
    *,
    step_m: float = 0.005,
    step_rad: float = 0.02,
    largest_joint_step_rad: float = 0.2,
) -> Vector | None:
    """Move the tool centre along a straight line at constant turning rate, without changing the branch.

    Args:
        inverse: Inverse kinematics of the arm.
        start: Joint positions at the start, shape (n,).
        goal: Transform of the tool-centre frame to the world at the end.
        step_m: Greatest distance of the tool between two rows of the result.
        step_rad: Greatest turn of the tool between two rows of the result.
        largest_joint_step_rad: Greatest change of a joint between two rows; a greater one means that the branch ends,
            as at a singularity.

    Returns:
        Joint positions, shape (k, n), from the start to the goal; None if the line leaves the reach or the joint
        ranges, or the branch ends on the way.
    """
    line = follow_line(
        inverse,
        start,
        goal,
        step_m=step_m,
        step_rad=step_rad,
        largest_joint_step_rad=largest_joint_step_rad,
    )
    return line.configurations_rad if line.broken is None else None


def follow_line(
    inverse: InverseKinematics,
    start: Sequence[float] | Vector,
    goal: Pose,
    *,
    goal_configuration: Sequence[float] | Vector | None = None,
    step_m: float = 0.005,
    step_rad: float = 0.02,
    largest_joint_step_rad: float = 0.2,
) -> FollowedLine:
    """Move the tool centre along a straight line as far as the arm can follow it.

    Args:
        inverse: Inverse kinematics of the arm.
        start: Joint positions at the start, shape (n,).
        goal: Transform of the tool-centre frame to the world at the end.
        goal_configuration: Joint positions at the end, shape (n,). A redundant arm converges to them along the line;
            for other arms the branch determines the end.
        step_m: Greatest distance of the tool between two rows of the result.
        step_rad: Greatest turn of the tool between two rows of the result.
        largest_joint_step_rad: Greatest change of a joint between two rows.
    """
    rows = [np.array(start, dtype=float)]
    origin = inverse.arm.tool_pose(rows[0])
    distance = math.dist(origin.position_m, goal.position_m)
    turn = _angle(origin.quaternion_xyzw, goal.quaternion_xyzw)
    count = max(1, math.ceil(distance / step_m - 1e-9), math.ceil(turn / step_rad - 1e-9))
    for index in range(1, count + 1):
        near = rows[-1]
        if goal_configuration is not None and inverse.is_redundant:
            near = near + (np.asarray(goal_configuration, dtype=float) - near) / (count + 1 - index)
        q = inverse.nearest(_between(origin, goal, index / count), near)
        broken = LineBreak.UNREACHABLE if q is None else None
        if q is not None and np.max(np.abs(q - rows[-1])) > largest_joint_step_rad:
            broken = LineBreak.BRANCH_ENDS
        if q is None or broken is not None:
            return FollowedLine(configurations_rad=np.array(rows), fraction=(index - 1) / count, broken=broken)
        rows.append(q)
    return FollowedLine(configurations_rad=np.array(rows), fraction=1.0, broken=None)


def _between(start: Pose, goal: Pose, fraction: float) -> Pose:
    x, y, z = (a + fraction * (b - a) for a, b in zip(start.position_m, goal.position_m, strict=True))
    return Pose(position_m=(x, y, z), quaternion_xyzw=_slerp(start.quaternion_xyzw, goal.quaternion_xyzw, fraction))


def _angle(one: Quaternion, other: Quaternion) -> float:
    """Angle between two orientations, accurate near zero, where an arc cosine is not."""
    same = math.dist(one, other)
    opposite = math.dist(one, [-value for value in other])
    return 4 * math.asin(min(1.0, min(same, opposite) / 2))


def _slerp(start: Quaternion, goal: Quaternion, fraction: float) -> Quaternion:
    """Spherical linear interpolation of orientations along the shorter arc (Shoemake 1985)."""
    if math.dist(start, goal) > math.dist(start, [-value for value in goal]):
        goal = (-goal[0], -goal[1], -goal[2], -goal[3])
    half = 2 * math.asin(min(1.0, math.dist(start, goal) / 2))
    if half < 1e-9:
        first, second = 1.0 - fraction, fraction
    else:
        first = math.sin((1 - fraction) * half) / math.sin(half)
        second = math.sin(fraction * half) / math.sin(half)
    x, y, z, w = (first * a + second * b for a, b in zip(start, goal, strict=True))
    norm = math.sqrt(x * x + y * y + z * z + w * w)
    return (x / norm, y / norm, z / norm, w / norm)
