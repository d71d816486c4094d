"""Pairs of an arm's links that touch in every configuration, and so say nothing of a collision."""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from rgss.kinematics.description import build_model
from rgss.kinematics.geometry import arm_parts
from rgss.scenes import Robot

Vector = NDArray[np.float64]

# The engine takes its flag by position alone.
_FIND_ALL = False

SAMPLES = 256
"""Configurations that are looked at: the home, and points of a Sobol sequence over the joints' ranges."""


@lru_cache(maxsize=16)
def lasting_contacts(robot: Robot) -> frozenset[frozenset[str]]:
    """Pairs of links that touch at the home and in every sampled configuration.

    Hulls of neighbours but one often overlap however the arm stands; so do links that a cover joins. Neighbours are
    left out of collision checks in any case.

    Args:
        robot: The arm.
    """
    import pinocchio

    model = build_model(robot)
    data = model.createData()
    geometry = pinocchio.GeometryModel()
    parts = arm_parts(model, robot)
    for index, part in enumerate(parts):
        geometry.addGeometryObject(
            pinocchio.GeometryObject(f"{part.name}#{index}", part.joint, part.placement, part.shape)
        )
    names: list[frozenset[str]] = []
    for first, one in enumerate(parts):
        for second in range(first + 1, len(parts)):
            if one.can_meet(parts[second]):
                geometry.addCollisionPair(pinocchio.CollisionPair(first, second))
                names.append(frozenset((one.name, parts[second].name)))
    state = geometry.createData()
    touching = set(names)
    for q in _sampled(robot):
        if not touching:
            break
        pinocchio.computeCollisions(model, data, geometry, state, q, _FIND_ALL)
        touching &= {pair for pair, result in zip(names, state.collisionResults, strict=True) if result.isCollision()}
    return frozenset(touching)


def _sampled(robot: Robot) -> Iterator[Vector]:
    yield np.array(robot.home_rad)
    # Where nothing touches at the home, the next is not asked for; the import takes longer than all checks.
    from scipy.stats.qmc import Sobol

    lower, upper = (np.array([getattr(joint, end) for joint in robot.joints]) for end in ("lower_rad", "upper_rad"))
    yield from lower + Sobol(len(robot.joints), scramble=False).random(SAMPLES) * (upper - lower)
