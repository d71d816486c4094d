"""Clearance and manipulability along a timed move."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from rgss.kinematics import Arm, CollisionModel
from rgss.trials.reference import Array, SampledTrajectory

_MANIPULABILITY_STEP_S = 0.010
_CLEARANCE_STEP_S = 0.040
_REFINED_STEP_S = 0.005


@dataclass(frozen=True, slots=True, kw_only=True)
class PathQuality:
    """Least clearance and least manipulability along a timed move.

    Attributes:
        clearance_m: Least distance of arm, gripper and carried object from the scene and the placed object, negative
        for an overlap; contacts of the object with its supports are excluded. None if the scene has no obstacle.
        manipulability_m3: Least manipulability.
    """

    clearance_m: float | None
    manipulability_m3: float


def path_quality(trajectory: SampledTrajectory, model: CollisionModel, arm: Arm) -> PathQuality:
    """Path quality of a move.

    The manipulability is sampled every 10 ms. The clearance, whose evaluation queries all pairs of bodies, is sampled
    every 40 ms, and every 5 ms on both sides of the least sample.

    Args:
        trajectory: The timed move.
        model: Collision model of the move.
        arm: Kinematics of the tool.
    """
    clearance_m = _least(trajectory, model.clearance_m)
    return PathQuality(
        clearance_m=clearance_m if math.isfinite(clearance_m) else None,
        manipulability_m3=min(
            manipulability(arm, q)
            for q in trajectory.positions(_times(0.0, trajectory.duration_s, _MANIPULABILITY_STEP_S))
        ),
    )


def manipulability(arm: Arm, q: Array) -> float:
    """Manipulability √det(J Jᵀ) of a configuration in m³ (Yoshikawa 1985); 0 at a singularity.

    J is the Jacobian at the grasp centre, of which three rows are in m/rad and three in rad/rad. For an arm of six
    joints it is square, and the value is |det J|. An arm of fewer joints moves the tool in fewer directions: the value
    is √det(Jᵀ J).

    Args:
        arm: Kinematics of the tool.
        q: Joint positions, shape (n,).
    """
    jacobian = arm.tool_jacobian(q)
    rows, columns = jacobian.shape
    if rows == columns:
        return abs(float(np.linalg.det(jacobian)))
    square = jacobian @ jacobian.T if columns > rows else jacobian.T @ jacobian
    return math.sqrt(max(0.0, float(np.linalg.det(square))))


def _least(trajectory: SampledTrajectory, value: Callable[[Array], float]) -> float:
    """Least value along a move, by coarse sampling and refinement about the least sample."""
    times = _times(0.0, trajectory.duration_s, _CLEARANCE_STEP_S)
    values = [value(q) for q in trajectory.positions(times)]
    at = int(np.argmin(values))
    start, end = float(times[max(0, at - 1)]), float(times[min(len(times) - 1, at + 1)])
    fine = trajectory.positions(_times(start, end, _REFINED_STEP_S))
    return min(values[at], *(value(q) for q in fine))


def _times(start_s: float, end_s: float, step_s: float) -> Array:
    times: Array = np.linspace(start_s, end_s, max(2, math.ceil((end_s - start_s) / step_s - 1e-9) + 1))
    return times
