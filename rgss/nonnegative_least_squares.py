"""Non-negative least squares whose answer is verified.

SciPy 1.15, the last one for Python 3.10, returns points that are no minimum for about 4 % of the wrench matrices of
random grasps. The conditions of Karush, Kuhn and Tucker cost two products, so every answer is verified by them, and
the algorithm of Lawson and Hanson answers where they do not hold.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Matrix = NDArray[np.float64]

TOLERANCE = 1e-9
"""Largest gradient that counts as zero, as a share of the greatest column times the target."""

_ROUNDING = 16 * float(np.finfo(np.float64).eps)
"""Where columns are nearly opposite and the target is nearly none, the point is large and its gradient is rounded."""


def nonnegative_least_squares(matrix: Matrix, target: Matrix, *, most_steps: int | None = None) -> tuple[Matrix, float]:
    """Minimise ``|matrix @ x - target|`` over ``x >= 0``.

    Args:
        matrix: Shape (m, n).
        target: Shape (m,).
        most_steps: Steps of the active set before SciPy's attempt and ours are given up; by default 3 n and 30 n.

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
    """Whether a point satisfies the conditions of Karush, Kuhn and Tucker, which suffice for a convex program.

    Args:
        matrix: Shape (m, n).
        target: Shape (m,).
        point: Shape (n,).
        rounding: Share of the greatest column times the matrix times the point by which a gradient may differ from
            zero besides: no gradient is known better than that.
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
    """Active-set method of Lawson and Hanson, "Solving Least Squares Problems", 1974, chapter 23.

    Args:
        matrix: Shape (m, n).
        target: Shape (m,).
        most_steps: Changes of the active set after which the last point is returned.

    Returns:
        A minimum over non-negative points, shape (n,), unless the steps ended first.
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
            # As far towards the unconstrained minimum as all stay non-negative; who reaches zero leaves.
            share = float((point[leaving] / np.maximum(point[leaving] - wanted[leaving], 1e-300)).min())
            point = point + share * (wanted - point)
            free &= ~(leaving & (point <= 1e-15 * max(1.0, float(point.max()))))
            point[~free] = 0.0
        # Rounding may send away at once what came in; it is not tried again until another one has stayed.
        rejected = np.zeros(count, dtype=bool) if free[entering] else rejected | (np.arange(count) == entering)
    return point
