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
    """Inverse kinematics of an arm's tool centre."""

    @property
    def arm(self) -> Arm:
        """The arm with its tool."""

    @property
    def is_redundant(self) -> bool:
        """True if the configurations of a pose form a continuum, of which a sample is returned."""

    def solve(self, tool_pose_world: Pose) -> tuple[Vector, ...]:
        """Find the configurations within the planning ranges that reach a pose, in lexicographic order.

        Args:
            tool_pose_world: Transform of the tool-centre frame to the world.
        """

    def nearest(self, tool_pose_world: Pose, reference: Sequence[float] | Vector) -> Vector | None:
        """Find a configuration within the planning ranges near another; None if none is found.

        Args:
            tool_pose_world: Transform of the tool-centre frame to the world.
            reference: Joint positions, shape (n,).
        """

    def excess_of_ranges(self, tool_pose_world: Pose) -> tuple[RangeExcess, ...]:
        """Greatest violation of a planning range in each configuration that reaches a pose and leaves a range.

        Args:
            tool_pose_world: Transform of the tool-centre frame to the world.
        """


def inverse_kinematics(arm: Arm, *, is_turn_free: bool = False) -> InverseKinematics:
    """The inverse kinematics of an arm: analytic where its geometry allows, numerical otherwise.

    Args:
        arm: The arm with its tool.
        is_turn_free: True to request only the position and the tool's axis of a pose; solved numerically.
    """
    if is_turn_free:
        return NumericalInverse(arm, is_turn_free=True)
    try:
        return AnalyticInverse(arm)
    except DefinitionError:
        return NumericalInverse(arm)
