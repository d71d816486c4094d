"""Weights that the joints of an arm hold at rest, in the worst of its sampled configurations."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rgss.kinematics import ArmDynamics, Load
from rgss.scenes import JointKind, Pose, Robot
from rgss.studies.robot_project.reach import sampled_configurations

Array = NDArray[np.float64]

_GRAVITY_M_S2 = 9.81
# Of a kilogram, in N·m or N: a joint with less carries no weight but that of a rounded angle, a lever of 1 mm.
_LEAST_PER_KG = 0.01


@dataclass(frozen=True, slots=True, kw_only=True)
class WeakJoint:
    """A joint whose effort does not hold the arm itself.

    Attributes:
        name: The joint.
        effort: Its torque in N·m, or its force in N.
        needed: The greatest that the arm's weight requires of it.
        unit: The unit of both.
    """

    name: str
    effort: float
    needed: float
    unit: str


def payload_kg(robot: Robot) -> float:
    """Greatest mass at the flange that the efforts of the joints hold in every sampled configuration.

    Args:
        robot: The arm, with its base as it is mounted.

    Returns:
        The mass, rounded down to 0.1 kg, below 1 kg to 0.01 kg; 0 if the joints do not hold the arm itself, infinite
        if no joint carries weight.
    """
    own, per_kg = _weights(robot)
    efforts = np.array([one.effort for one in _carriers(robot)])
    if np.any(np.abs(own) > efforts):
        return 0.0
    carried = np.abs(per_kg) > _LEAST_PER_KG
    if not np.any(carried):
        return math.inf
    # Each joint gives its effort in the direction in which the payload loads it; the arm may be balanced.
    margins = (efforts - np.sign(per_kg) * own)[carried] / np.abs(per_kg)[carried]
    held = float(np.min(margins))
    steps = 10 if held >= 1.0 else 100
    return math.floor(steps * held) / steps


def weak_joints(robot: Robot) -> tuple[WeakJoint, ...]:
    """Joints whose effort does not hold the arm itself in a sampled configuration."""
    own, _ = _weights(robot)
    return tuple(
        WeakJoint(
            name=one.name,
            effort=one.effort,
            needed=float(needed),
            unit="N" if one.kind is JointKind.PRISMATIC else "N*m",
        )
        for one, needed in zip(_carriers(robot), np.max(np.abs(own), axis=0), strict=True)
        if float(needed) > one.effort
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class _Carrier:
    """A joint with its greatest effort in N·m or N."""

    name: str
    kind: JointKind
    effort: float


def _carriers(robot: Robot) -> tuple[_Carrier, ...]:
    """The driven joints, then the followers, whose efforts the coupling transmits."""
    driven = (_Carrier(name=one.name, kind=one.kind, effort=one.torque_n_m) for one in robot.joints)
    return (*driven, *(_Carrier(name=one.name, kind=one.kind, effort=one.effort) for one in robot.followers))


def _weights(robot: Robot) -> tuple[Array, Array]:
    """Torques of the joints at rest, of the arm itself and of a kilogram at the flange, in the order of `_carriers`."""
    samples = sampled_configurations(robot)
    still = np.zeros(len(robot.joints))
    kilogram = Load(mass_kg=1.0, moments_kg_m2=(0.0, 0.0, 0.0), pose=Pose())
    empty = ArmDynamics(robot, (), gravity_m_s2=_GRAVITY_M_S2)
    loaded = ArmDynamics(robot, (kilogram,), gravity_m_s2=_GRAVITY_M_S2)
    own = np.array([_torques(empty, q, still) for q in samples])
    return own, np.array([_torques(loaded, q, still) for q in samples]) - own


def _torques(dynamics: ArmDynamics, q: Array, still: Array) -> Array:
    return np.concatenate([dynamics.torques(q, still, still), dynamics.follower_torques(q, still, still)])
