"""Random walks in a polytope of weights, for sets that can be neither triangulated nor drawn by rejection."""

from __future__ import annotations

import numpy as np

from rgss.errors import TradeoffError
from rgss.tradeoff.weights.polytope import Polytope
from rgss.tradeoff.weights.weight_set import Array

SWEEPS = 25
"""Each walk takes so many times as many steps as weights can move independently."""

ROUNDINGS = 4
"""So often the walk's axes are fitted to the shape of the polytope before weights are drawn."""

PILOTS = 1_000
"""So many walks show that shape."""

WALKS_AT_ONCE = 1_024
"""So many walk together: their room to every condition stays in the processor's cache."""

_PARALLEL = 1e-14


def walked_weights(polytope: Polytope, inside: Array, count: int, generator: np.random.Generator) -> Array:
    """Draw weights as the ends of independent hit-and-run walks.

    A step of hit-and-run moves to a uniform point of the chord through the present point in a random
    direction; the walk's limit is the uniform distribution (Smith, "Efficient Monte Carlo procedures
    for generating points uniformly distributed over bounded regions", 1984), which suits weights
    under linear conditions (Tervonen et al., "Hit-And-Run enables efficient weight generation for
    simulation-based multiple criteria decision analysis", 2013). Long thin polytopes mix slowly, so
    the directions are those of a random orthonormal basis after the polytope was rounded by the
    covariance of pilot walks. Every weight is the end of its own walk, so that standard errors
    of independent draws hold; that the walks have forgotten their start is tested and not proven.

    Args:
        polytope: The admitted weights, of dimension 1 or more.
        inside: A point of its interior, shape (m,).
        count: Number of draws.
        generator: Source of randomness.

    Returns:
        The weights, shape (count, m); each row is exactly non-negative.

    Raises:
        TradeoffError: The polytope is too thin to be rounded.
    """
    directions = polytope.weights.directions()
    dimension = directions.shape[1]
    slopes, gaps = polytope.rows @ directions, polytope.limits - polytope.rows @ inside
    shape = np.eye(dimension)
    points = np.zeros((min(count, PILOTS), dimension))
    for _ in range(ROUNDINGS):
        points = _walked(points, slopes, gaps, shape, generator)
        try:
            shape = np.linalg.cholesky(np.atleast_2d(np.cov(points.T))) if len(points) > dimension else shape
        except np.linalg.LinAlgError as error:
            raise TradeoffError(
                "the elicited bounds and orders leave too thin a set of weights to draw from",
                hint="widen a bound, or fix the weights that are known",
            ) from error
    found = []
    for start in range(0, count, WALKS_AT_ONCE):
        size = min(WALKS_AT_ONCE, count - start)
        starts = points[np.arange(size) % len(points)]
        found.append(inside + _walked(starts, slopes, gaps, shape, generator) @ directions.T)
    return np.asarray(np.clip(np.vstack(found), 0.0, 1.0), dtype=np.float64)


def _walked(points: Array, slopes: Array, gaps: Array, shape: Array, generator: np.random.Generator) -> Array:
    """End points of walks from some points, shape (n, d).

    Args:
        points: The starts, shape (n, d).
        slopes: The conditions a x <= c, shape (k, d).
        gaps: Their right-hand sides, shape (k,).
        shape: Turns directions of a round body into those of the polytope, shape (d, d).
        generator: Source of randomness.
    """
    dimension = points.shape[1]
    # Conditions by rows, so that those that bound a direction are whole rows in memory.
    walks = points.T.copy()
    for _ in range(SWEEPS):
        basis = shape @ np.linalg.qr(generator.standard_normal((dimension, dimension)))[0]
        room = gaps[:, None] - slopes @ walks
        for direction in basis.T:
            rates = slopes @ direction
            forward, backward = np.flatnonzero(rates > _PARALLEL), np.flatnonzero(rates < -_PARALLEL)
            # A point may lie outside by rounding alone, and then the step leads back.
            high = np.maximum((room[forward] * (1.0 / rates[forward, None])).min(axis=0), 0.0)
            low = np.minimum((room[backward] * (1.0 / rates[backward, None])).max(axis=0), 0.0)
            steps = low + (high - low) * generator.random(walks.shape[1])
            walks += direction[:, None] * steps
            room -= rates[:, None] * steps
    return np.asarray(walks.T, dtype=np.float64)
