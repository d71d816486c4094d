"""Equilibrium and force closure without margins, by non-negative least squares.

The verdicts equal those of the linear programs of `rgss.grasping.closure`, in a hundredth of the time; they suffice for
a grasp that is analysed many times while it is carried.
"""

from __future__ import annotations

import numpy as np

from rgss.errors import DefinitionError
from rgss.grasping.contact import Matrix
from rgss.nonnegative_least_squares import nonnegative_least_squares

RANK_TOLERANCE = 1e-9
"""Relative tolerance of singular values: a smaller share of the greatest counts as zero."""

STRICTLY_POSITIVE = 1e-7
"""Relative tolerance of coefficients: a smaller share of their mean counts as zero."""

BALANCED = 1e-8
"""Tolerance of the net wrench in N, for normal forces that sum to 1 N."""


def can_balance(wrenches: Matrix) -> bool:
    """True if a convex combination of wrenches is zero.

    Args:
        wrenches: Shape (space, n), all components in N.

    Raises:
        DefinitionError: The solver reached no verdict.
    """
    rows, columns = wrenches.shape
    _, residual = _nearest(np.vstack([wrenches, np.ones((1, columns))]), np.append(np.zeros(rows), 1.0))
    return residual <= BALANCED


def positively_span(wrenches: Matrix) -> bool:
    """True if wrenches positively span their space.

    They do if they have full rank and -Σ w_i is a combination of them with coefficients c_i ≥ 0: then Σ (1 + c_i) w_i =
    0 with positive coefficients.

    Args:
        wrenches: Shape (space, n), all components in N.

    Raises:
        DefinitionError: The solver reached no verdict.
    """
    rows, columns = wrenches.shape
    if columns <= rows:
        return False
    values = np.linalg.svd(wrenches, compute_uv=False)
    if values[-1] <= RANK_TOLERANCE * values[0]:
        return False
    coefficients, residual = _nearest(wrenches, -wrenches.sum(axis=1))
    mean = 1.0 + float(np.mean(coefficients))
    return residual <= BALANCED * mean * columns and mean * STRICTLY_POSITIVE < 1.0


def _nearest(matrix: Matrix, target: Matrix) -> tuple[Matrix, float]:
    try:
        return nonnegative_least_squares(matrix, target)
    except RuntimeError as error:
        raise DefinitionError(
            f"the wrenches of a grasp were not judged: {error}",
            hint="check that the contacts' coefficients are of a sensible size",
        ) from error
