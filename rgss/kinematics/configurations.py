"""Configurations that reach a pose: whole turns within the joints' ranges, their order, and excesses of the ranges."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rgss.scenes import Joint, JointKind

Vector = NDArray[np.float64]

TOLERANCE = 1e-6
"""Greatest deviation, in m and in the entries of the rotation matrix, of a configuration that is kept."""


@dataclass(frozen=True, slots=True, kw_only=True)
class RangeExcess:
    """A joint outside its planning range.

    Attributes:
        joint: The joint's name.
        beyond_rad: How far its angle lies beyond the nearer end, whole turns considered; in m for a prismatic joint.
        kind: What the joint's position is.
    """

    joint: str
    beyond_rad: float
    kind: JointKind = JointKind.REVOLUTE


def excesses_of(configurations: Iterable[Vector], joints: Sequence[Joint]) -> tuple[RangeExcess, ...]:
    """For each configuration, the joint that is farthest outside its planning range.

    Args:
        configurations: Joint positions, each of shape (n,).
        joints: The joints.

    Returns:
        The least excess first, without the configurations that keep all ranges.
    """
    found = []
    for q in configurations:
        excesses = []
        for joint, position in zip(joints, q.tolist(), strict=True):
            turns = [position + turn * 2 * math.pi for turn in (-1, 0, 1)]
            if joint.kind is JointKind.PRISMATIC:
                turns = [position]
            beyond = min(max(joint.lower_rad - one, one - joint.upper_rad) for one in turns)
            excesses.append(RangeExcess(joint=joint.name, beyond_rad=beyond, kind=joint.kind))
        worst = max(excesses, key=lambda one: one.beyond_rad)
        if worst.beyond_rad > 0.0:
            found.append(worst)
    return tuple(sorted(found, key=lambda one: (one.beyond_rad, one.joint)))


def whole_turns(angle: float, lower: float, upper: float) -> list[float]:
    """The same direction as often as it fits between two limits, ascending."""
    turn = 2 * math.pi
    first = math.ceil((lower - angle) / turn - 1e-12)
    last = math.floor((upper - angle) / turn + 1e-12)
    return [min(max(angle + turn * count, lower), upper) for count in range(first, last + 1)]


def sorted_distinct(configurations: list[Vector]) -> tuple[Vector, ...]:
    """Order configurations so that rounding noise cannot reorder them, and drop repetitions."""
    ordered: dict[tuple[float, ...], Vector] = {}
    for q in configurations:
        ordered.setdefault(tuple(round(float(angle), 6) + 0.0 for angle in q), q)
    return tuple(ordered[key] for key in sorted(ordered))
