"""Overlaps between the fixed solids of a scene."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import dataclass

from rgss.kinematics.description import transform
from rgss.kinematics.geometry import object_solids
from rgss.scenes import ObjectShape, Pose


@dataclass(frozen=True, slots=True, kw_only=True)
class Solid:
    """A named solid in the world.

    Attributes:
        name: Name of its body.
        shape: Its shape.
        pose: Transform of the shape's frame to the world.
    """

    name: str
    shape: ObjectShape
    pose: Pose


@dataclass(frozen=True, slots=True, kw_only=True)
class Overlap:
    """Two solids that overlap.

    Attributes:
        first: Name of the first.
        second: Name of the second.
        depth_m: Penetration depth: the least translation after which they only touch.
    """

    first: str
    second: str
    depth_m: float


def overlaps(solids: Sequence[Solid], *, deeper_than_m: float) -> tuple[Overlap, ...]:
    """Pairs of solids that overlap, in the order of the solids.

    Args:
        solids: The solids.
        deeper_than_m: Least penetration depth of a reported pair in m; solids in contact have depth 0.
    """
    import coal

    placed = []
    for one in solids:
        for solid, at in object_solids(one.shape):
            placement = transform(one.pose @ at)
            placed.append((one.name, solid, coal.Transform3s(placement.rotation, placement.translation)))
    found = []
    for (first, shape, place), (second, other, there) in itertools.combinations(placed, 2):
        if first == second:
            continue
        result = coal.DistanceResult()
        depth = -float(coal.distance(shape, place, other, there, coal.DistanceRequest(), result))
        if depth > deeper_than_m:
            found.append(Overlap(first=first, second=second, depth_m=depth))
    return tuple(found)
