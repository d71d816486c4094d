"""Derivatives of joint angles and tool centre with respect to the path parameter."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rgss.motion.blending import SmoothPath
from rgss.motion.validity import ToolKinematics

Vector = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PathDerivatives:
    """First and second derivatives at n points of a path.

    Attributes:
        first: Of the joint angles q, shape (n, joints).
        second: Of the joint angles, shape (n, joints).
        tool_first: Of the tool centre in m, shape (n, 3).
        tool_second: Of the tool centre in m, shape (n, 3).
    """

    first: Vector
    second: Vector
    tool_first: Vector
    tool_second: Vector

    def every(self, stride: int) -> PathDerivatives:
        """Derivatives at every stride-th point, from the first on."""
        return PathDerivatives(
            first=self.first[::stride],
            second=self.second[::stride],
            tool_first=self.tool_first[::stride],
            tool_second=self.tool_second[::stride],
        )


def path_derivatives(path: SmoothPath, parameters: Vector, tool: ToolKinematics) -> PathDerivatives:
    """Derivatives in closed form.

    Difference quotients have errors of 10 % where the path bends sharply. With p' = Σ_i v_i q'_i from the columns (v_i,
    ω_i) of the Jacobian in the order of the joints along the arm,

        p'' = Σ_i v_i q''_i + Σ_i Σ_k ω_min(i,k) × v_max(i,k) q'_i q'_k,

    since a joint turns the axes of all joints beyond it (the Hessian of the geometric Jacobian;
    J. Haviland, P. Corke, "Manipulator Differential Kinematics, part 2: acceleration and advanced applications", 2023).

    Args:
        path: The path.
        parameters: Path parameters s, shape (n,).
        tool: Kinematics of the tool centre.
    """
    first, second = path(parameters, 1), path(parameters, 2)
    jacobians = np.array([tool.tool_jacobian(q) for q in path(parameters)])
    shifts, spins = jacobians[:, :3] * first[:, None, :], jacobians[:, 3:] * first[:, None, :]
    # The angular velocity of the joints before each one, and half of its own: the double sum has each pair twice.
    carrying = np.cumsum(spins, axis=2) - 0.5 * spins
    bending = 2.0 * np.sum(np.cross(carrying, shifts, axis=1), axis=2)
    return PathDerivatives(
        first=first,
        second=second,
        tool_first=np.sum(shifts, axis=2),
        tool_second=np.einsum("nij,nj->ni", jacobians[:, :3], second) + bending,
    )
