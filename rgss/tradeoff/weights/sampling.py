"""Weights drawn uniformly from those that are admitted."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

import numpy as np

from rgss.tradeoff.weights.hit_and_run import walked_weights
from rgss.tradeoff.weights.polytope import Polytope, triangulation
from rgss.tradeoff.weights.weight_set import Array, WeightSet

MOST_TRIES = 40
"""So many points of the simplex are drawn at most for each that is kept; beyond, a walk is faster."""


class Drawing(str, Enum):
    """Method by which weights were drawn."""

    INDEPENDENT = "independent"
    HIT_AND_RUN = "hit_and_run"


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class DrawnWeights:
    """Weights and how they were drawn.

    Attributes:
        weights: The weights, shape (count, m); each row is exactly non-negative.
        drawn_by: Whether they are exactly uniform, or the ends of random walks that are nearly so.
    """

    weights: Array
    drawn_by: Drawing


def sample_weights(
    weights: WeightSet, count: int, generator: np.random.Generator, *, most_walks: int | None = None
) -> DrawnWeights:
    """Draw weights, independently and uniformly.

    The simplex is drawn from directly (Rubinstein, "Generating random vectors uniformly
    distributed inside and on the surface of different regions", 1982). A set that was cut is
    triangulated; a simplex of the triangulation is drawn by its volume, and a point from it. Where
    there are too many weights for that, points of the simplex outside the set are rejected; where
    nearly all are, or a weight is fixed, each weight is the end of a random walk of its own
    (see `walked_weights`).

    Args:
        weights: The admitted weights.
        count: Number of draws.
        generator: Source of randomness.
        most_walks: Largest number of draws where they are ends of walks, which take longer.

    Raises:
        TradeoffError: The set has no interior.
    """
    if weights.is_simplex:
        return DrawnWeights(weights=_from_simplex(weights.size, count, generator), drawn_by=Drawing.INDEPENDENT)
    polytope = Polytope.of(weights)
    inside = polytope.interior_point()
    if not weights.directions().shape[1]:
        return DrawnWeights(weights=np.tile(inside, (count, 1)), drawn_by=Drawing.INDEPENDENT)
    vertices = polytope.vertices(inside)
    drawn = None if vertices is None else _from_vertices(vertices, weights.directions(), count, generator)
    if drawn is not None:
        return DrawnWeights(weights=np.maximum(drawn, 0.0), drawn_by=Drawing.INDEPENDENT)
    kept = None if vertices is not None or len(weights.equals) else _rejected(polytope, count, generator)
    if kept is not None:
        return DrawnWeights(weights=kept, drawn_by=Drawing.INDEPENDENT)
    walks = count if most_walks is None else min(count, most_walks)
    return DrawnWeights(weights=walked_weights(polytope, inside, walks, generator), drawn_by=Drawing.HIT_AND_RUN)


def _from_simplex(size: int, count: int, generator: np.random.Generator) -> Array:
    spacings = generator.standard_exponential((count, size))
    return np.asarray(spacings / spacings.sum(axis=1, keepdims=True), dtype=np.float64)


def _from_vertices(vertices: Array, directions: Array, count: int, generator: np.random.Generator) -> Array | None:
    """Points of a triangulated polytope; None where Qhull gives up."""
    flat = (vertices - vertices[0]) @ directions
    if flat.shape[1] == 1:
        ends = vertices[[int(flat.argmin()), int(flat.argmax())]]
        share = generator.random((count, 1))
        return np.asarray(share * ends[0] + (1.0 - share) * ends[1], dtype=np.float64)
    found = triangulation(flat)
    if found is None:
        return None
    cells, volumes = found
    chosen = generator.choice(len(cells), size=count, p=volumes / volumes.sum())
    shares = _from_simplex(cells.shape[1], count, generator)
    return np.asarray(np.einsum("nk,nkm->nm", shares, vertices[cells[chosen]]), dtype=np.float64)


def _rejected(polytope: Polytope, count: int, generator: np.random.Generator) -> Array | None:
    """Points of the simplex that lie in the set; None where too few do."""
    kept: list[Array] = []
    missing = count
    for tried in range(1, MOST_TRIES + 1):
        drawn = _from_simplex(polytope.weights.size, count, generator)
        kept.append(drawn[(drawn @ polytope.rows.T <= polytope.limits).all(axis=1)][:missing])
        missing -= len(kept[-1])
        if not missing:
            return np.vstack(kept)
        if (count - missing) * MOST_TRIES < tried * count // 2:
            return None
    return None
