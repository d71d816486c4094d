"""Vertices of the polytope of admitted weights."""

from __future__ import annotations

import itertools
import math

import numpy as np
from numpy.typing import NDArray

from rgss.errors import TradeoffError

MOST_CANDIDATES = 2_000_000
"""Largest number of sets of binding bounds that are examined; more would take minutes."""

FEW_CANDIDATES = 5_000
"""Up to so many, looking at every corner is the simplest; beyond, linear programs generate the binding weights."""

_TOLERANCE = 1e-9
_BLOCK = 20_000


def corner_candidates(matrix: NDArray[np.float64]) -> int:
    """In how many ways so many of the bounds can bind that they make a corner.

    Args:
        matrix: Coefficients of the bounds, shape (k, m); that weights are not negative is not among them.
    """
    bounds, count = matrix.shape
    return math.comb(bounds + count, count - 1)


def weight_vertices(matrix: NDArray[np.float64], limits: NDArray[np.float64]) -> NDArray[np.float64]:
    """Vertices of ``{w : w >= 0, sum(w) = 1, matrix @ w <= limits}``.

    At a vertex m - 1 of the inequalities are active in addition to the sum. Every such system is solved and kept if
    feasible; that is exact up to rounding, and fast for a few measures.

    Args:
        matrix: Coefficients, shape (k, m).
        limits: Right-hand sides, shape (k,).

    Returns:
        The vertices in lexicographic order, shape (c, m); empty if the bounds are inconsistent.

    Raises:
        TradeoffError: There are too many bounds to enumerate all vertices.
    """
    count = matrix.shape[1]
    rows = np.vstack([matrix, -np.eye(count)])
    ends = np.concatenate([limits, np.zeros(count)])
    candidates = corner_candidates(matrix)
    if candidates > MOST_CANDIDATES:
        raise TradeoffError(
            f"{count} weights with {len(matrix)} bounds may have {candidates} corners",
            hint=f"at most {MOST_CANDIDATES} are examined; weigh fewer measures or give fewer bounds",
        )
    found: list[NDArray[np.float64]] = []
    choices = itertools.combinations(range(len(rows)), count - 1)
    while block := list(itertools.islice(choices, _BLOCK)):
        binding = np.array(block, dtype=np.intp).reshape(len(block), count - 1)
        systems = np.concatenate([np.ones((len(block), 1, count)), rows[binding]], axis=1)
        sides = np.concatenate([np.ones((len(block), 1)), ends[binding]], axis=1)
        # Rows of very different length would hide a singular system behind its determinant.
        lengths = np.linalg.norm(systems, axis=2, keepdims=True)
        scale = np.where(lengths > 0.0, lengths, 1.0)
        regular = np.abs(np.linalg.det(systems / scale)) > _TOLERANCE
        corners = np.linalg.solve(systems[regular], sides[regular][:, :, None])[:, :, 0]
        found.append(corners[(corners @ rows.T <= ends + _TOLERANCE).all(axis=1)])
    corners = np.clip(np.concatenate(found), 0.0, None)
    corners = corners / corners.sum(axis=1, keepdims=True)
    # Corners that are met by several choices differ by rounding alone.
    _, first = np.unique(np.round(corners, 9) + 0.0, axis=0, return_index=True)
    return np.asarray(corners[first], dtype=np.float64)
