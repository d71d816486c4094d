"""Weights that the joints of an arm hold with the arm farthest out."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rgss.kinematics import Arm, ArmDynamics, Load
from rgss.scenes import JointKind, Pose, Robot
from rgss.studies.robot_project.reach import sampled_configurations

Array = NDArray[np.float64]

_LEAST_PAYLOAD_KG, _MOST_PAYLOAD_KG = 0.1, 100.0
_LEAST_PER_KG = 1e-9


@dataclass(frozen=True, slots=True, kw_only=True)
class WeakJoint:
    """A joint whose effort does not hold the arm itself.

    Attributes:
        name: The joint.
        effort: Its torque in N·m, or its force in N.
        needed: What the arm's weight asks of it.
        unit: The unit of both.
    """

    name: str
    effort: float
    needed: float
    unit: str


def payload_at_reach_kg(robot: Robot) -> float:
    """Mass at the flange that the efforts of the joints hold with the arm farthest out; rounded down to 0.1 kg.

    Args:
        robot: The arm.

    Returns:
        The mass, at least 0.1 kg, also where the joints do not hold the arm itself (`weak_joints`).
    """
    own, per_kg = _weights(robot)
    margins = [
        (joint.torque_n_m - abs(float(mine))) / abs(float(each))
        for joint, mine, each in zip(robot.joints, own, per_kg, strict=True)
        if abs(float(each)) > _LEAST_PER_KG
    ]
    held = math.floor(10 * min(margins, default=_MOST_PAYLOAD_KG)) / 10
    return min(max(held, _LEAST_PAYLOAD_KG), _MOST_PAYLOAD_KG)


def weak_joints(robot: Robot) -> tuple[WeakJoint, ...]:
    """Joints whose effort does not hold the arm itself where it reaches farthest.

    Args:
        robot: The arm.
    """
    own, _ = _weights(robot)
    return tuple(
        WeakJoint(
            name=joint.name,
            effort=joint.torque_n_m,
            needed=abs(float(needed)),
            unit="N" if joint.kind is JointKind.PRISMATIC else "N*m",
        )
        for joint, needed in zip(robot.joints, own, strict=True)
        if abs(float(needed)) > joint.torque_n_m
    )


def _weights(robot: Robot) -> tuple[Array, Array]:
    """Torques of the joints at rest with the arm farthest out: of the arm itself, and of a kilogram at the flange."""
    arm = Arm(robot, Pose())
    samples = sampled_configurations(robot)
    offsets = (arm.tool_position(samples) - np.array(arm.first_axis_m))[:, :2]
    q = samples[int(np.argmax(np.linalg.norm(offsets, axis=1)))]
    still = np.zeros(len(robot.joints))
    kilogram = Load(mass_kg=1.0, moments_kg_m2=(0.0, 0.0, 0.0), pose=Pose())
    own = ArmDynamics(robot, (), gravity_m_s2=9.81).torques(q, still, still)
    return own, ArmDynamics(robot, (kilogram,), gravity_m_s2=9.81).torques(q, still, still) - own
