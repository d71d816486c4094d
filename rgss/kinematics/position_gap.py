"""Least distance of an arm's tool centre from a point, with any orientation of the tool."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rgss.kinematics.arm import Arm
from rgss.kinematics.sobol_points import sobol_points

Array = NDArray[np.float64]

_SAMPLES = 4096
_STARTS = 4


def position_gap_m(arm: Arm, point_m: ArrayLike) -> float:
    """Least distance in m of the tool centre from a point, over the configurations within the planning ranges.

    A bounded least-squares problem from the nearest of sampled configurations: an upper bound of the distance.

    Args:
        arm: The arm with its tool.
        point_m: The point in the world, shape (3,).
    """
    from scipy.optimize import least_squares

    point, lower = np.asarray(point_m, dtype=float), arm.lower_rad
    # The solver requires ranges of some width.
    upper = np.maximum(arm.upper_rad, lower + 1e-9)
    qs = lower + sobol_points(len(lower), _SAMPLES) * (upper - lower)
    distances = np.linalg.norm(arm.tool_position(qs) - point, axis=1)
    ends = []
    for index in np.argsort(distances, kind="stable")[:_STARTS].tolist():
        end = least_squares(
            lambda q: arm.tool_position(q)[0] - point,
            qs[index],
            jac=lambda q: arm.tool_jacobian(q)[:3],
            bounds=(lower, upper),
        )
        ends.append(math.sqrt(2.0 * float(end.cost)))
    return min(ends)
