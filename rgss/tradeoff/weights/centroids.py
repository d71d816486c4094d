"""Centroid of a polytope of weights."""

from __future__ import annotations

import numpy as np

from rgss.errors import TradeoffError
from rgss.tradeoff.weights.polytope import THINNEST, Polytope, triangulation
from rgss.tradeoff.weights.sampling import sample_weights
from rgss.tradeoff.weights.weight_set import Array

_DRAWN = 1 << 14
_SEED = 20_240_101
"""Of the draws for polytopes of so many weights that they cannot be triangulated: the same each time."""


def centroid(polytope: Polytope) -> Array:
    """The mean of all weights of a polytope, shape (m,).

    Exact, from a triangulation, for up to six independent weights; beyond, the mean of 16,384 draws.

    Args:
        polytope: The polytope, which is not empty.

    Raises:
        TradeoffError: It is empty.
    """
    ball = polytope.largest_ball()
    if ball is None:
        raise TradeoffError("no weights satisfy all answers", hint="withdraw one of the bounds")
    directions = polytope.weights.directions()
    if not directions.shape[1] or ball[1] <= THINNEST:
        return ball[0]
    vertices = polytope.vertices(ball[0])
    if vertices is not None and directions.shape[1] == 1:
        return np.asarray(vertices.mean(axis=0), dtype=np.float64)
    if vertices is not None:
        found = _of_cells(vertices, directions)
        if found is not None:
            return found
    drawn = sample_weights(polytope.weights, _DRAWN, np.random.default_rng(_SEED)).weights
    return np.asarray(drawn.mean(axis=0), dtype=np.float64)


def _of_cells(vertices: Array, directions: Array) -> Array | None:
    """The centroid of the cells of a triangulation, weighted by their volumes; None where Qhull gives up."""
    found = triangulation((vertices - vertices[0]) @ directions)
    if found is None:
        return None
    cells, volumes = found
    return np.asarray(volumes @ vertices[cells].mean(axis=1) / volumes.sum(), dtype=np.float64)
