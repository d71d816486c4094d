"""Small linear programs, solved by HiGHS through SciPy."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from rgss.errors import TradeoffError

Array = NDArray[np.float64]

SOLVER_TOLERANCE = 1e-10
"""How far a condition may be from holding; conditions are scaled to unit length before."""

_OPTIMAL, _INFEASIBLE = 0, 2


def solve_linear(
    cost: Array, rows: Array, limits: Array, equation_rows: Array, equals: Array, bounds: Any
) -> Array | None:
    """Minimise a linear cost.

    Args:
        cost: Cost vector, shape (v,).
        rows: Inequalities a x <= c, shape (k, v).
        limits: Their right-hand sides.
        equation_rows: Equations, shape (q, v).
        equals: Their right-hand sides.
        bounds: The least and the greatest value of each variable; None for no bound.

    Returns:
        The proven optimum; None if infeasible.

    Raises:
        TradeoffError: The solver proved neither optimality nor infeasibility.
    """
    from scipy.optimize import linprog

    options = {
        "primal_feasibility_tolerance": SOLVER_TOLERANCE,
        "dual_feasibility_tolerance": SOLVER_TOLERANCE,
    }
    result = linprog(
        cost,
        A_ub=rows,
        b_ub=limits,
        A_eq=equation_rows,
        b_eq=equals,
        bounds=bounds,
        method="highs",
        options=options,
    )
    if result.status == _INFEASIBLE:
        return None
    if result.status != _OPTIMAL:
        raise TradeoffError(
            f"a linear program over weights ended without an optimum: {' '.join(str(result.message).split())}",
            hint="only a proven optimum is accepted; look for values that are not between 0 and 1",
        )
    return np.asarray(result.x, dtype=np.float64)
