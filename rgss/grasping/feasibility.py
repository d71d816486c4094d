"""Verdicts without margins: whether wrenches can balance, or span their space, by non-negative least squares.

They say what the linear programs of `rgss.grasping.closure` say, and nothing of how well it holds, in a hundredth of
the time; a grasp that is judged many times while it is carried needs no more.
"""

from __future__ import annotations

import numpy as np

from rgss.errors import DefinitionError
from rgss.grasping.contact import Matrix
from rgss.nonnegative_least_squares import nonnegative_least_squares

RANK_TOLERANCE = 1e-9
"""A singular value below this share of the greatest counts as zero."""

STRICTLY_POSITIVE = 1e-7
"""A coefficient below this share of the mean one counts as zero."""

BALANCED = 1e-8
"""A net wrench below this, for normal forces that sum to 1 N, counts as none."""


def can_balance(wrenches: Matrix) -> bool:
    """True if some combination with coefficients from zero, which sum to 1, is zero.

    Args:
        wrenches: Shape (space, n), in newtons alone.

    Raises:
        DefinitionError: The solver reached no verdict.
    """
    rows, columns = wrenches.shape
    _, residual = _nearest(np.vstack([wrenches, np.ones((1, columns))]), np.append(np.zeros(rows), 1.0))
    return residual <= BALANCED


def positively_span(wrenches: Matrix) -> bool:
    """True if wrenches positively span their space.

    They do if they have full rank and -Σ w_i is a combination of them with coefficients c_i from zero: then
    Σ (1 + c_i) w_i = 0 with coefficients that are all above zero.

    Args:
        wrenches: Shape (space, n), in newtons alone.

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
