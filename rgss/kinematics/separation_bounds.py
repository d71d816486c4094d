"""Cheap lower bounds of the distance of two parts: a bounding sphere of one, a bounding box of the other."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

_ROUNDING_M = 1e-9
_ENDLESS_M = 1e6


@dataclass(frozen=True, slots=True, eq=False)
class SeparationBounds:
    """Bounds of the distances of k pairs of m parts, from boxes and spheres in the frame of each part.

    Attributes:
        pairs: Indices of the two parts of each pair, shape (k, 2).
        centres_m: Centre of the box of each part, shape (m, 3).
        halves_m: Half its edges, shape (m, 3); infinite where the part is unbounded.
        radii_m: Radius of the bounding sphere about that centre, shape (m,).
    """

    pairs: NDArray[np.intp]
    centres_m: NDArray[np.float64]
    halves_m: NDArray[np.float64]
    radii_m: NDArray[np.float64]

    @classmethod
    def of(cls, geometry: Any, indices: Sequence[int]) -> SeparationBounds:
        """Bounds for selected pairs of a geometry model.

        Args:
            geometry: Pinocchio's geometry model.
            indices: Indices of its collision pairs.
        """
        pairs = [(geometry.collisionPairs[each].first, geometry.collisionPairs[each].second) for each in indices]
        centres, halves = [], []
        for part in geometry.geometryObjects:
            part.geometry.computeLocalAABB()
            box = part.geometry.aabb_local
            low, high = np.array(box.min_, dtype=float), np.array(box.max_, dtype=float)
            bounded = bool((np.abs(low) < _ENDLESS_M).all() and (np.abs(high) < _ENDLESS_M).all())
            centres.append((low + high) / 2.0 if bounded else np.zeros(3))
            halves.append((high - low) / 2.0 if bounded else np.full(3, math.inf))
        half_edges = np.array(halves, dtype=float).reshape(-1, 3)
        return cls(
            pairs=np.array(pairs, dtype=np.intp).reshape(-1, 2),
            centres_m=np.array(centres, dtype=float).reshape(-1, 3),
            halves_m=half_edges,
            radii_m=np.linalg.norm(half_edges, axis=1),
        )

    def least_distances_m(self, placements: Sequence[Any]) -> NDArray[np.float64]:
        """Lower bound of the distance of each pair; minus infinity if the parts may overlap.

        Args:
            placements: Pose of each part in the world, as Pinocchio's SE3.

        Returns:
            The bounds in m, shape (k,).
        """
        turns = np.array([each.rotation for each in placements]).reshape(-1, 3, 3)
        centres = np.array([each.translation for each in placements]).reshape(-1, 3)
        centres = centres + np.einsum("mij,mj->mi", turns, self.centres_m)
        first, second = self.pairs.T
        return np.maximum(self._from(centres, turns, first, second), self._from(centres, turns, second, first))

    def _from(
        self,
        centres: NDArray[np.float64],
        turns: NDArray[np.float64],
        boxes: NDArray[np.intp],
        spheres: NDArray[np.intp],
    ) -> NDArray[np.float64]:
        """Signed distance from the box of one part to the sphere of the other."""
        offsets = np.einsum("kji,kj->ki", turns[boxes], centres[spheres] - centres[boxes])
        beyond = np.linalg.norm(np.maximum(np.abs(offsets) - self.halves_m[boxes], 0.0), axis=1)
        # An overlap is measured by its depth, which the distance of a sphere from a box does not bound.
        apart = beyond - self.radii_m[spheres] - _ROUNDING_M
        return np.where(apart > 0.0, apart, -math.inf)
