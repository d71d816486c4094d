"""Permanent contacts of an arm's links, which collision checking ignores."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rgss.kinematics.coupling import Coupling
from rgss.kinematics.description import build_model
from rgss.kinematics.geometry import arm_parts
from rgss.kinematics.sobol_points import sobol_points
from rgss.scenes import Robot

Vector = NDArray[np.float64]

# The engine accepts its flag by position only.
_FIND_ALL = False

SAMPLES = 256
"""Number of sampled configurations: home, and points of a Sobol sequence over the joint ranges."""


@lru_cache(maxsize=16)
def lasting_contacts(robot: Robot) -> frozenset[frozenset[str]]:
    """Pairs of links that touch at home and in every sampled configuration.

    Convex hulls of links two joints apart often overlap in every configuration, as do links under a common cover.
    Neighbouring links are never checked.
    """
    pairs = _LinkPairs(robot)
    touching = set(pairs.names)
    for q in _sampled(robot):
        if not touching:
            break
        touching &= pairs.touching(q)
    return frozenset(touching)


def touching_links(robot: Robot, q: Sequence[float]) -> tuple[tuple[str, str], ...]:
    """Pairs of an arm's links that touch in a configuration, without neighbours.

    Args:
        robot: The arm.
        q: Joint positions, shape (n,).
    """
    found = _LinkPairs(robot).touching(np.array(q))
    return tuple(sorted((min(pair), max(pair)) for pair in found))


class _LinkPairs:
    """Checked pairs of an arm's solids."""

    def __init__(self, robot: Robot) -> None:
        import pinocchio

        self._engine: Any = pinocchio
        self._model = build_model(robot)
        self._coupling = Coupling.of(robot, self._model)
        self._data = self._model.createData()
        self._geometry = pinocchio.GeometryModel()
        parts = arm_parts(self._model, robot)
        for index, part in enumerate(parts):
            self._geometry.addGeometryObject(
                pinocchio.GeometryObject(f"{part.name}#{index}", part.joint, part.placement, part.shape)
            )
        self.names: list[frozenset[str]] = []
        for first, one in enumerate(parts):
            for second in range(first + 1, len(parts)):
                if one.can_meet(parts[second]):
                    self._geometry.addCollisionPair(pinocchio.CollisionPair(first, second))
                    self.names.append(frozenset((one.name, parts[second].name)))
        self._state = self._geometry.createData()

    def touching(self, q: Vector) -> set[frozenset[str]]:
        """Names of the pairs that touch."""
        positions = self._coupling.positions(q)
        self._engine.computeCollisions(self._model, self._data, self._geometry, self._state, positions, _FIND_ALL)
        results = self._state.collisionResults
        return {pair for pair, result in zip(self.names, results, strict=True) if result.isCollision()}


def _sampled(robot: Robot) -> Iterator[Vector]:
    yield np.array(robot.home_rad)
    lower, upper = (np.array([getattr(joint, end) for joint in robot.joints]) for end in ("lower_rad", "upper_rad"))
    yield from lower + sobol_points(len(robot.joints), SAMPLES) * (upper - lower)
