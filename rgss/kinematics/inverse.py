"""Inverse kinematics as a strategy: analytic where a decomposition of the arm is known, numerical otherwise."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from rgss.errors import DefinitionError
from rgss.kinematics.analytic_inverse import AnalyticInverse
from rgss.kinematics.arm import Arm
from rgss.kinematics.configurations import RangeExcess
from rgss.kinematics.numerical_inverse import NumericalInverse
from rgss.scenes import Pose

Vector = NDArray[np.float64]


class InverseKinematics(Protocol):
    """Joint configurations that bring the tool centre of an arm to a pose."""

    @property
    def arm(self) -> Arm:
        """The arm with its tool."""

    @property
    def is_redundant(self) -> bool:
        """Whether the configurations of a pose form a continuum, of which a sample is found."""

    def solve(self, tool_pose_world: Pose) -> tuple[Vector, ...]:
        """Find the configurations within the planning ranges that reach a pose, in lexicographic order.

        Args:
            tool_pose_world: Transform of the tool-centre frame to the world.
        """

    def nearest(self, tool_pose_world: Pose, reference: Sequence[float] | Vector) -> Vector | None:
        """Find a configuration within the planning ranges near another; None where none is found.

        Args:
            tool_pose_world: Transform of the tool-centre frame to the world.
            reference: Joint positions, shape (n,).
        """

    def excess_of_ranges(self, tool_pose_world: Pose) -> tuple[RangeExcess, ...]:
        """For each configuration outside the ranges that reaches a pose, the joint that is farthest outside.

        Args:
            tool_pose_world: Transform of the tool-centre frame to the world.
        """


def inverse_kinematics(arm: Arm, *, is_turn_free: bool = False) -> InverseKinematics:
    """The inverse kinematics of an arm: analytic where its geometry allows, numerical otherwise.

    Args:
        arm: The arm with its tool.
        is_turn_free: Whether of a pose the position and the tool's axis alone are requested, which is numerical.
    """
    if is_turn_free:
        return NumericalInverse(arm, is_turn_free=True)
    try:
        return AnalyticInverse(arm)
    except DefinitionError:
        return NumericalInverse(arm)
