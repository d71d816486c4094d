"""Reach of an arm over sampled configurations."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rgss.kinematics import Arm
from rgss.scenes import JointKind, Pose, Robot

Array = NDArray[np.float64]

SAMPLES = 2048
"""Number of sampled configurations."""

_TRAVEL_SAMPLES = 256


def arm_reach_m(robot: Robot) -> float:
    """Greatest distance of the flange from the line of the first axis over sampled configurations.

    A prismatic first joint has a direction, but no line: of an arm on one it is the greatest distance from the middle
    of the region of the flange.
    """
    arm = Arm(robot, Pose())
    positions = arm.tool_position(sampled_configurations(robot))
    if robot.joints[0].kind is JointKind.PRISMATIC:
        offsets = positions - (positions.min(axis=0) + positions.max(axis=0)) / 2
    else:
        axis = arm.joint_axes()[0][0]
        offsets = np.cross(positions - np.array(arm.first_axis_m), axis)
    return float(np.max(np.linalg.norm(offsets, axis=1)))


def middle_height_m(robot: Robot) -> float:
    """Height halfway between the lowest and the highest position of the flange over sampled configurations.

    Unlike the origin of the first joint's frame, which may be anywhere on its axis, it depends on the arm alone.
    """
    heights = Arm(robot, Pose()).tool_position(sampled_configurations(robot))[:, 2]
    return float(heights.min() + heights.max()) / 2


def greatest_travel_m(robot: Robot, tool: Pose) -> float:
    """Greatest distance that a tool moves for each unit of length in joint space, over sampled configurations.

    Args:
        robot: The arm.
        tool: The tool in the frame of the flange.
    """
    arm = Arm(robot, tool)
    jacobians = [arm.tool_jacobian(q)[:3] for q in sampled_configurations(robot)[:_TRAVEL_SAMPLES]]
    return float(np.max(np.linalg.norm(jacobians, ord=2, axis=(1, 2))))


def sampled_configurations(robot: Robot) -> Array:
    """Joint positions drawn evenly from the ranges, the same at every call, shape (k, n)."""
    lower, upper = (np.array([getattr(joint, end) for joint in robot.joints]) for end in ("lower_rad", "upper_rad"))
    shares = np.random.default_rng(0).random((SAMPLES, len(robot.joints)))
    samples: Array = lower + shares * (upper - lower)
    return samples
