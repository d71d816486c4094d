"""Analytic inverse kinematics: every joint configuration that brings the tool centre to a pose."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rgss.errors import DefinitionError
from rgss.kinematics.arm import Arm
from rgss.kinematics.configurations import TOLERANCE, RangeExcess, excesses_of, sorted_distinct, whole_turns
from rgss.kinematics.description import transform
from rgss.scenes import JointKind, Pose

Vector = NDArray[np.float64]

# The chains for which the solver finds every branch.
_JOINTS = 6


class AnalyticInverse:
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
        self.arm = arm
        self._solver = _decomposition(arm)
        if self._solver is None:
            raise DefinitionError(
                f"the robot {arm.robot.id} has no known analytic inverse kinematics",
                hint="use an arm with a spherical wrist or three parallel axes, or the numerical one",
            )
        self._rotation_at_zero = arm.tool_rotation_at_zero()

    @property
    def is_redundant(self) -> bool:
        """True if the configurations of a pose form a continuum; an arm of six joints has isolated ones."""
        return False

    def solve(self, tool_pose_world: Pose) -> tuple[Vector, ...]:
        """Find every configuration within the planning ranges that reaches a pose.

        Args:
            tool_pose_world: Transform of the tool-centre frame to the world.

        Returns:
            Joint angles in rad, each of shape (n,): all branches, with all whole turns that stay within
            the joints' planning ranges, in lexicographic order. Empty when the pose is out of reach.
        """
        found = [np.array(q) for choices in self._choices(tool_pose_world) for q in itertools.product(*choices)]
        return sorted_distinct(found)

    def nearest(self, tool_pose_world: Pose, reference: Sequence[float] | Vector) -> Vector | None:
        """Find the configuration within the planning ranges that is nearest to another.

        Args:
            tool_pose_world: Transform of the tool-centre frame to the world.
            reference: Joint angles in rad, shape (n,).

        Returns:
            Joint angles in rad, shape (n,), with the smallest greatest joint difference; None when the
            pose is out of reach.
        """
        near = np.asarray(reference, dtype=float)
        found = [
            np.array([_nearest(choice, angle) for choice, angle in zip(choices, near, strict=True)])
            for choices in self._choices(tool_pose_world)
            if all(choices)
        ]
        return min(sorted_distinct(found), key=lambda q: float(np.max(np.abs(q - near))), default=None)

    def excess_of_ranges(self, tool_pose_world: Pose) -> tuple[RangeExcess, ...]:
        """Greatest violation of a planning range in each branch that reaches a pose.

        Args:
            tool_pose_world: Transform of the tool-centre frame to the world.

        Returns:
            One entry a branch, the least excess first, without the branches within all ranges; empty when the pose is
            out of reach.
        """
        return excesses_of(self._branches(tool_pose_world), self.arm.robot)

    def _choices(self, pose: Pose) -> list[list[list[float]]]:
        """Angles within the planning range for each branch and joint; empty if the joint has none."""
        ranges = [(joint.lower_rad, joint.upper_rad) for joint in self.arm.robot.joints]
        return [
            [whole_turns(float(angle), lower, upper) for angle, (lower, upper) in zip(branch, ranges, strict=True)]
            for branch in self._branches(pose)
        ]

    def _branches(self, pose: Pose) -> list[Vector]:
        target = transform(pose).homogeneous
        # The solver's tool frame is parallel to the world at the zero configuration; ours differs by a constant
        # rotation.
        asked = target.copy()
        asked[:3, :3] = target[:3, :3] @ self._rotation_at_zero.T
        return [
            np.array(q, dtype=float)
            for q in self._solver.IK(asked).Q
            if np.all(np.isfinite(q)) and np.max(np.abs(self.arm.tool_matrix(q) - target)) < TOLERANCE
        ]


def _nearest(choices: list[float], angle: float) -> float:
    return min(choices, key=lambda choice: abs(choice - angle))


def _decomposition(arm: Arm) -> Any:
    """Solver for an arm's geometry; None if no decomposition is known."""
    from eaik.IK_HP import HPRobot

    if (
        not arm.coupling.is_identity
        or len(arm.robot.joints) != _JOINTS
        or any(joint.kind is not JointKind.REVOLUTE for joint in arm.robot.joints)
    ):
        return None
    try:
        solver = HPRobot(*arm.joint_axes())
    except RuntimeError:
        return None
    return solver if solver.hasKnownDecomposition() else None
