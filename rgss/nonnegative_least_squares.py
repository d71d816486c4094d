"""Non-negative least squares with verified optimality.

SciPy 1.15, the last release for Python 3.10, returns points that are not a minimum for about 4 % of the wrench matrices
of random grasps. The Karush-Kuhn-Tucker conditions take two products, so every result is verified by them, with the
Lawson-Hanson algorithm as a fallback.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Matrix = NDArray[np.float64]

TOLERANCE = 1e-9
"""Tolerance of the gradient, relative to the greatest column norm times the norm of the target."""

_ROUNDING = 16 * float(np.finfo(np.float64).eps)
"""Rounding tolerance of the gradient: for nearly opposite columns and a small target the point is large."""


def nonnegative_least_squares(matrix: Matrix, target: Matrix, *, most_steps: int | None = None) -> tuple[Matrix, float]:
    """Minimise ``|matrix @ x - target|`` over ``x >= 0``.

    Args:
        matrix: Shape (m, n).
        target: Shape (m,).
        most_steps: Greatest number of active-set steps of SciPy's and our method; by default 3 n and 30 n.

    Returns:
        The minimum, shape (n,), and the norm of its residual.

    Raises:
        RuntimeError: No point was found that satisfies the conditions of a minimum.
    """
    from scipy.optimize import nnls

    try:
        solution = nnls(matrix, target, maxiter=most_steps)[0]
    except RuntimeError:
        solution = None
    if solution is None or not is_minimum(matrix, target, solution):
        solution = lawson_hanson(matrix, target, most_steps=most_steps or 30 * matrix.shape[1])
        if not is_minimum(matrix, target, solution, rounding=_ROUNDING):
            raise RuntimeError(f"no minimum of the {matrix.shape[0]} x {matrix.shape[1]} least squares was found")
    return solution, float(np.linalg.norm(matrix @ solution - target))


def is_minimum(matrix: Matrix, target: Matrix, point: Matrix, *, rounding: float = 0.0) -> bool:
    """True if a point satisfies the Karush-Kuhn-Tucker conditions, which are sufficient for a convex program.

    Args:
        matrix: Shape (m, n).
        target: Shape (m,).
        point: Shape (n,).
        rounding: Rounding tolerance of the gradient, relative to the greatest column norm times the norm of matrix
            times point.
    """
    descent = matrix.T @ (target - matrix @ point)
    scale = float(np.sqrt((matrix**2).sum(axis=0)).max(initial=0.0) * np.linalg.norm(target))
    allowed = TOLERANCE * scale
    if rounding > 0.0:
        longest = float(np.sqrt((matrix**2).sum(axis=0)).max(initial=0.0))
        allowed += rounding * longest * float(np.linalg.norm(matrix) * np.linalg.norm(point))
    inside = np.abs(descent[point > 0.0]).max(initial=0.0)
    return bool((point >= 0.0).all() and descent.max(initial=0.0) <= allowed and inside <= allowed)


def lawson_hanson(matrix: Matrix, target: Matrix, *, most_steps: int) -> Matrix:
    """Lawson-Hanson active-set method ("Solving Least Squares Problems", 1974, chapter 23).

    Args:
        matrix: Shape (m, n).
        target: Shape (m,).
        most_steps: Greatest number of changes of the active set, after which the last point is returned.

    Returns:
        The minimum over non-negative points, shape (n,), if the steps sufficed.
    """
    count = matrix.shape[1]
    scale = float(np.sqrt((matrix**2).sum(axis=0)).max(initial=0.0) * np.linalg.norm(target))
    free, rejected, point = np.zeros(count, dtype=bool), np.zeros(count, dtype=bool), np.zeros(count)
    for _ in range(most_steps):
        descent = np.where(free | rejected, -np.inf, matrix.T @ (target - matrix @ point))
        entering = int(descent.argmax())
        if descent[entering] <= 0.1 * TOLERANCE * scale:
            break
        free[entering] = True
        while free.any():
            wanted = np.zeros(count)
            wanted[free] = np.linalg.lstsq(matrix[:, free], target, rcond=None)[0]
            leaving = free & (wanted <= 0.0)
            if not leaving.any():
                point = wanted
                break
            # Step towards the unconstrained minimum while all components stay non-negative; those that reach zero
            # leave.
            share = float((point[leaving] / np.maximum(point[leaving] - wanted[leaving], 1e-300)).min())
            point = point + share * (wanted - point)
            free &= ~(leaving & (point <= 1e-15 * max(1.0, float(point.max()))))
            point[~free] = 0.0
        # Rounding may remove an entering component at once; it is not tried again until another one has stayed.
        rejected = np.zeros(count, dtype=bool) if free[entering] else rejected | (np.arange(count) == entering)
    return point
