"""Small linear programs, solved by HiGHS."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from rgss.errors import TradeoffError

Array = NDArray[np.float64]

SOLVER_TOLERANCE = 1e-10
"""Largest violation of a condition that counts as met; conditions are scaled to unit length before."""

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
        raise _unproven(str(result.message))
    return np.asarray(result.x, dtype=np.float64)


def variable_ranges(rows: Array, limits: Array, equation_rows: Array, equals: Array) -> tuple[Array, Array] | None:
    """The least and the greatest value of each variable, shapes (v,) each; bounds only follow from the conditions.

    All are optima of one program with different costs, each of which begins at the last optimum: by HiGHS directly,
    since through SciPy each would take ten times as long.

    Args:
        rows: Inequalities a x <= c, shape (k, v).
        limits: Their right-hand sides.
        equation_rows: Equations, shape (q, v).
        equals: Their right-hand sides.

    Returns:
        The values; None if infeasible.

    Raises:
        TradeoffError: The solver proved neither optimality nor infeasibility, or a variable has no least or greatest
            value.
    """
    import highspy

    size = rows.shape[1]
    solver = rerun_solver(
        np.vstack([rows, equation_rows]),
        np.concatenate([np.full(len(limits), -np.inf), equals]),
        np.concatenate([limits, equals]),
        least=-np.inf,
    )
    ends = np.empty((2, size))
    for place in range(size):
        for end, sign in enumerate((1.0, -1.0)):
            solver.changeColCost(place, sign)
            solver.run()
            status = solver.getModelStatus()
            if status == highspy.HighsModelStatus.kInfeasible:
                return None
            if status != highspy.HighsModelStatus.kOptimal:
                raise _unproven(solver.modelStatusToString(status))
            ends[end, place] = solver.getSolution().col_value[place]
        solver.changeColCost(place, 0.0)
    return ends[0], ends[1]


def rerun_solver(rows: Array, lower: Array, upper: Array, *, least: float) -> Any:
    """HiGHS with a linear program l <= A x <= u of costs 0; each run with other costs begins at the last optimum.

    Args:
        rows: The coefficients A, shape (k, v).
        lower: The bounds l, shape (k,).
        upper: The bounds u, shape (k,).
        least: The least value of every variable.
    """
    import highspy

    solver = highspy.Highs()
    for name, value in (
        ("output_flag", False),
        ("threads", 1),
        ("presolve", "off"),
        ("primal_feasibility_tolerance", SOLVER_TOLERANCE),
        ("dual_feasibility_tolerance", SOLVER_TOLERANCE),
    ):
        solver.setOptionValue(name, value)
    count, size = rows.shape
    program = highspy.HighsLp()
    program.num_col_, program.num_row_ = size, count
    program.col_cost_ = np.zeros(size)
    program.col_lower_, program.col_upper_ = np.full(size, least), np.full(size, np.inf)
    program.row_lower_, program.row_upper_ = lower, upper
    program.a_matrix_.format_ = highspy.MatrixFormat.kRowwise
    program.a_matrix_.start_ = np.arange(count + 1) * size
    program.a_matrix_.index_ = np.tile(np.arange(size), count)
    program.a_matrix_.value_ = rows.ravel()
    solver.passModel(program)
    return solver


def _unproven(end: str) -> TradeoffError:
    return TradeoffError(
        f"a linear program over weights ended without an optimum: {' '.join(end.split())}",
        hint="only a proven optimum is accepted; look for values that are not between 0 and 1",
    )
