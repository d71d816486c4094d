"""Inverse kinematics: every joint configuration that brings the tool centre to a pose."""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rgss.errors import DefinitionError
from rgss.kinematics.arm import Arm
from rgss.kinematics.description import transform
from rgss.scenes import Pose

Vector = NDArray[np.float64]

TOLERANCE = 1e-6
"""Greatest deviation, in m and in the entries of the rotation matrix, of a branch that is kept."""


@dataclass(frozen=True, slots=True, kw_only=True)
class RangeExcess:
    """A joint outside its planning range.

    Attributes:
        joint: The joint's name.
        beyond_rad: How far its angle lies beyond the nearer end, whole turns considered.
    """

    joint: str
    beyond_rad: float


class InverseKinematics:
    """Analytic inverse kinematics of an arm by subproblem decomposition.

    The geometry is taken from the arm's own model in product-of-exponentials form, so that forward
    and inverse kinematics cannot differ. Every branch is verified by forward kinematics.

    Source: D. Ostermeier, J. Külz, M. Althoff, "Automatic Geometric Decomposition for Analytical Inverse
    Kinematics", IEEE RA-L 2025 (EAIK).

    Args:
        arm: The arm with its tool.

    Raises:
        DefinitionError: No analytic decomposition is known for the arm's geometry.
    """

    def __init__(self, arm: Arm) -> None:
        from eaik.IK_HP import HPRobot

        self.arm = arm
        directions, steps = arm.joint_axes()
        self._solver: Any = HPRobot(directions, steps)
        if not self._solver.hasKnownDecomposition():
            raise DefinitionError(
                f"the robot {arm.robot.id} has no known analytic inverse kinematics",
                hint="use an arm with a spherical wrist or three parallel axes",
            )
        self._rotation_at_zero = arm.tool_rotation_at_zero()

    def solve(self, tool_pose_world: Pose) -> tuple[Vector, ...]:
        """Find every configuration within the planning ranges that reaches a pose.

        Args:
            tool_pose_world: Transform of the tool-centre frame to the world.

        Returns:
            Joint angles in rad, each of shape (6,): all branches, with all whole turns that stay within
            the joints' planning ranges, in lexicographic order. Empty when the pose is out of reach.
        """
        found = [np.array(q) for choices in self._choices(tool_pose_world) for q in itertools.product(*choices)]
        return _sorted_distinct(found)

    def nearest(self, tool_pose_world: Pose, reference: Sequence[float] | Vector) -> Vector | None:
        """Find the configuration within the planning ranges that is nearest to another.

        Args:
            tool_pose_world: Transform of the tool-centre frame to the world.
            reference: Joint angles in rad, shape (6,).

        Returns:
            Joint angles in rad, shape (6,), with the smallest greatest joint difference; None when the
            pose is out of reach.
        """
        near = np.asarray(reference, dtype=float)
        found = [
            np.array([_nearest(choice, angle) for choice, angle in zip(choices, near, strict=True)])
            for choices in self._choices(tool_pose_world)
            if all(choices)
        ]
        return min(_sorted_distinct(found), key=lambda q: float(np.max(np.abs(q - near))), default=None)

    def excess_of_ranges(self, tool_pose_world: Pose) -> tuple[RangeExcess, ...]:
        """For each branch that reaches a pose, the joint that is farthest outside its planning range.

        Args:
            tool_pose_world: Transform of the tool-centre frame to the world.

        Returns:
            The least excess first; empty where the pose is out of reach, and without the branches
            that keep all ranges.
        """
        found = []
        for branch in self._branches(tool_pose_world):
            excesses = []
            for joint, angle in zip(self.arm.robot.joints, branch.tolist(), strict=True):
                turns = [angle + turn * 2 * math.pi for turn in (-1, 0, 1)]
                beyond = [max(joint.lower_rad - one, one - joint.upper_rad) for one in turns]
                excesses.append(RangeExcess(joint=joint.name, beyond_rad=min(beyond)))
            worst = max(excesses, key=lambda one: one.beyond_rad)
            if worst.beyond_rad > 0.0:
                found.append(worst)
        return tuple(sorted(found, key=lambda one: (one.beyond_rad, one.joint)))

    def _choices(self, pose: Pose) -> list[list[list[float]]]:
        """For each branch and joint, the angles within the planning range; none where it has no such angle."""
        ranges = [(joint.lower_rad, joint.upper_rad) for joint in self.arm.robot.joints]
        return [
            [_whole_turns(float(angle), lower, upper) for angle, (lower, upper) in zip(branch, ranges, strict=True)]
            for branch in self._branches(pose)
        ]

    def _branches(self, pose: Pose) -> list[Vector]:
        target = transform(pose).homogeneous
        # The solver's tool frame is parallel to the world at zero; ours is turned by a constant.
        asked = target.copy()
        asked[:3, :3] = target[:3, :3] @ self._rotation_at_zero.T
        return [
            np.array(q, dtype=float)
            for q in self._solver.IK(asked).Q
            if np.all(np.isfinite(q)) and np.max(np.abs(self.arm.tool_matrix(q) - target)) < TOLERANCE
        ]


def _whole_turns(angle: float, lower: float, upper: float) -> list[float]:
    """The same direction as often as it fits between two limits, ascending."""
    turn = 2 * math.pi
    first = math.ceil((lower - angle) / turn - 1e-12)
    last = math.floor((upper - angle) / turn + 1e-12)
    return [min(max(angle + turn * count, lower), upper) for count in range(first, last + 1)]


def _nearest(choices: list[float], angle: float) -> float:
    return min(choices, key=lambda choice: abs(choice - angle))


def _sorted_distinct(configurations: list[Vector]) -> tuple[Vector, ...]:
    """Order configurations so that rounding noise cannot reorder them, and drop repetitions."""
    ordered: dict[tuple[float, ...], Vector] = {}
    for q in configurations:
        ordered.setdefault(tuple(round(float(angle), 6) + 0.0 for angle in q), q)
    return tuple(ordered[key] for key in sorted(ordered))
