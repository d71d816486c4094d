"""Post-processing of inverse kinematics solutions: whole turns within the joint ranges, order, range violations."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rgss.scenes import JointKind, Robot

Vector = NDArray[np.float64]

TOLERANCE = 1e-6
"""Greatest accepted deviation of a configuration, in m and in the entries of the rotation matrix."""


@dataclass(frozen=True, slots=True, kw_only=True)
class RangeExcess:
    """A joint outside its planning range.

    Attributes:
        joint: The joint's name.
        beyond_rad: Excess of its angle over the nearer limit, whole turns considered; in m for a prismatic joint.
        kind: Kind of the joint.
    """

    joint: str
    beyond_rad: float
    kind: JointKind = JointKind.REVOLUTE


def excesses_of(configurations: Iterable[Vector], robot: Robot) -> tuple[RangeExcess, ...]:
    """Greatest violation of a planning range in each configuration.

    Args:
        configurations: Joint positions, each of shape (n,).
        robot: The arm.

    Returns:
        One entry a configuration, the least excess first, without the configurations within all ranges.
    """
    found, periodic = [], robot.whole_turns_are_equal
    for q in configurations:
        excesses = []
        for joint, position, turns_freely in zip(robot.joints, q.tolist(), periodic, strict=True):
            turns = [position + turn * 2 * math.pi for turn in (-1, 0, 1)] if turns_freely else [position]
            beyond = min(max(joint.lower_rad - one, one - joint.upper_rad) for one in turns)
            excesses.append(RangeExcess(joint=joint.name, beyond_rad=beyond, kind=joint.kind))
        worst = max(excesses, key=lambda one: one.beyond_rad)
        if worst.beyond_rad > 0.0:
            found.append(worst)
    return tuple(sorted(found, key=lambda one: (one.beyond_rad, one.joint)))


def whole_turns(angle: float, lower: float, upper: float) -> list[float]:
    """All angles between two limits that equal an angle modulo 2π, ascending."""
    turn = 2 * math.pi
    first = math.ceil((lower - angle) / turn - 1e-12)
    last = math.floor((upper - angle) / turn + 1e-12)
    return [min(max(angle + turn * count, lower), upper) for count in range(first, last + 1)]


def sorted_distinct(configurations: list[Vector]) -> tuple[Vector, ...]:
    """Configurations in an order that rounding noise does not change, without duplicates."""
    ordered: dict[tuple[float, ...], Vector] = {}
    for q in configurations:
        ordered.setdefault(tuple(round(float(angle), 6) + 0.0 for angle in q), q)
    return tuple(ordered[key] for key in sorted(ordered))
