"""Coupling of an arm: positions of all joints of its model, driven and followers, from those of the driven ones."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rgss.scenes import JointKind, Robot

Vector = NDArray[np.float64]


class Coupling:
    """Constraint of the mimic joints of an arm, q = A q_d + b, eliminated from the model.

    n is the number of driven joints, m that of the model's joints, from the base to the flange. With the constraint
    substituted (R. Featherstone, "Rigid Body Dynamics Algorithms", Springer 2008, section 3.3), q̇ = A q̇_d, the
    Jacobian of the driven joints is J A, and their torques are Aᵀ τ. An arm without followers has A = 1 and b = 0, and
    its values pass through unchanged.

    Attributes:
        is_identity: True for an arm without followers.
        matrix: A, shape (m, n).
        offset: b in rad or m, shape (m,).
        follower_rows: Indices of the followers among the model's joints.
        slides: True for each prismatic joint of the model, shape (m,).
    """

    def __init__(self, robot: Robot, names: Sequence[str]) -> None:
        """Look up the joints.

        Args:
            robot: The arm.
            names: Names of the model's joints, from the base to the flange.
        """
        driven = [joint.name for joint in robot.joints]
        followers = {one.name: one for one in robot.followers}
        self.is_identity = not followers
        self.matrix, self.offset = np.zeros((len(names), len(driven))), np.zeros(len(names))
        kinds = []
        for row, name in enumerate(names):
            one = followers.get(name)
            if one is None:
                self.matrix[row, driven.index(name)] = 1.0
                kinds.append(robot.joints[driven.index(name)].kind)
            else:
                self.matrix[row, one.driver], self.offset[row] = one.multiplier, one.offset
                kinds.append(one.kind)
        self.follower_rows = [row for row, name in enumerate(names) if name in followers]
        self.slides = np.array([kind is JointKind.PRISMATIC for kind in kinds])

    @staticmethod
    def of(robot: Robot, model: Any) -> Coupling:
        """Coupling of an arm in its Pinocchio model."""
        return Coupling(robot, tuple(model.names)[1:])

    def positions(self, q: ArrayLike) -> Vector:
        """Positions of the model's joints, shape (…, m).

        Args:
            q: Positions of the driven joints, shape (…, n).
        """
        driven: Vector = np.asarray(q, dtype=float)
        return driven if self.is_identity else driven @ self.matrix.T + self.offset

    def rates(self, dq: ArrayLike) -> Vector:
        """Speeds or accelerations of the model's joints, shape (…, m).

        Args:
            dq: Those of the driven joints, shape (…, n).
        """
        driven: Vector = np.asarray(dq, dtype=float)
        return driven if self.is_identity else driven @ self.matrix.T

    def reduced(self, rows: Vector) -> Vector:
        """Torques or a Jacobian with respect to the driven joints, shape (…, n).

        Args:
            rows: Torques or a Jacobian with respect to the model's joints, shape (…, m).
        """
        return rows if self.is_identity else rows @ self.matrix
