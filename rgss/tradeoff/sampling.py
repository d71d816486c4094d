"""Weights drawn uniformly from those that are admitted."""

from __future__ import annotations

import numpy as np

from rgss.errors import TradeoffError
from rgss.tradeoff.polytope import THINNEST, Polytope
from rgss.tradeoff.weight_set import Array, WeightSet

MOST_TRIES = 400
"""Rounds of rejection before it is given up."""


def sample_weights(weights: WeightSet, count: int, generator: np.random.Generator) -> Array:
    """Draw weights, independently and uniformly.

    The simplex is drawn from directly (Rubinstein, "Generating random vectors uniformly
    distributed inside and on the surface of different regions", 1982). A set that was cut is
    triangulated; a simplex of the triangulation is drawn by its volume, and a point from it. Where
    there are too many weights for that, points of the simplex outside the set are rejected.

    Args:
        weights: The admitted weights.
        count: How many are drawn.
        generator: Where randomness comes from.

    Returns:
        The weights, shape (count, m); each row is exactly non-negative.

    Raises:
        TradeoffError: The set has no interior, or is so thin that rejection does not end.
    """
    if weights.is_simplex:
        return _from_simplex(weights.size, count, generator)
    polytope = Polytope.of(weights)
    ball = polytope.largest_ball()
    dimension = weights.directions().shape[1]
    if ball is None or (ball[1] <= THINNEST and dimension):
        raise TradeoffError(
            "the elicited bounds and orders leave no room for weights",
            hint="widen a bound, or drop an order",
        )
    if dimension == 0:
        return np.tile(ball[0], (count, 1))
    vertices = polytope.vertices(ball[0])
    if vertices is None:
        return _rejected(polytope, count, generator)
    drawn = _from_vertices(vertices, weights.directions(), count, generator)
    return np.asarray(np.maximum(drawn, 0.0), dtype=np.float64)


def _from_simplex(size: int, count: int, generator: np.random.Generator) -> Array:
    spacings = generator.standard_exponential((count, size))
    return np.asarray(spacings / spacings.sum(axis=1, keepdims=True), dtype=np.float64)


def _from_vertices(vertices: Array, directions: Array, count: int, generator: np.random.Generator) -> Array:
    flat = (vertices - vertices[0]) @ directions
    if flat.shape[1] == 1:
        ends = vertices[[int(flat.argmin()), int(flat.argmax())]]
        share = generator.random((count, 1))
        return np.asarray(share * ends[0] + (1.0 - share) * ends[1], dtype=np.float64)
    from scipy.spatial import Delaunay

    cells = Delaunay(flat).simplices
    corners = flat[cells]
    volumes = np.abs(np.linalg.det(corners[:, 1:] - corners[:, :1]))
    chosen = generator.choice(len(cells), size=count, p=volumes / volumes.sum())
    shares = _from_simplex(cells.shape[1], count, generator)
    return np.asarray(np.einsum("nk,nkm->nm", shares, vertices[cells[chosen]]), dtype=np.float64)


def _rejected(polytope: Polytope, count: int, generator: np.random.Generator) -> Array:
    if len(polytope.weights.equals):
        raise TradeoffError(
            "weights of more than six measures cannot be drawn while one is fixed",
            hint="give the fixed weight a small range, or fix none",
        )
    kept: list[Array] = []
    missing = count
    for _ in range(MOST_TRIES):
        drawn = _from_simplex(polytope.weights.size, count, generator)
        kept.append(drawn[(drawn @ polytope.rows.T <= polytope.limits).all(axis=1)][:missing])
        missing -= len(kept[-1])
        if not missing:
            return np.vstack(kept)
    raise TradeoffError(
        f"the elicited bounds and orders leave less than one weight in {MOST_TRIES}",
        hint="widen a bound, or fix the weights that are known",
    )
