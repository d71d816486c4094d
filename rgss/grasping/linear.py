"""Linear programs over non-negative variables, solved by HiGHS."""

from __future__ import annotations

import threading
from functools import lru_cache
from typing import Any

import numpy as np

from rgss.errors import DefinitionError
from rgss.grasping.contact import Matrix

_TOLERANCE = 1e-10


def maximise(
    objective: Matrix, *, equal: tuple[Matrix, Matrix], at_most: tuple[Matrix, Matrix] | None = None
) -> Matrix | None:
    """Maximise objective·x over x ≥ 0.

    Args:
        objective: Shape (n,).
        equal: Matrix and right-hand side of the equality constraints, shapes (p, n) and (p,).
        at_most: Matrix and right-hand side of the upper bounds, shapes (q, n) and (q,).

    Returns:
        The maximiser, shape (n,); None if the program is infeasible.

    Raises:
        DefinitionError: The solver reached no verdict.
    """
    # HiGHS directly: through SciPy such a small program takes several times as long.
    import highspy

    program = _program(highspy, objective, equal, at_most)
    # Presolving takes as long as solving. If the simplex method fails on coefficients of very different size, the
    # interior-point method may succeed.
    for method, presolve in (("simplex", "off"), ("ipm", "on")):
        solver = _solver(threading.get_ident())
        solver.clear()
        for name, value in (
            ("output_flag", False),
            ("threads", 1),
            ("solver", method),
            ("presolve", presolve),
            ("primal_feasibility_tolerance", _TOLERANCE),
            ("dual_feasibility_tolerance", _TOLERANCE),
        ):
            solver.setOptionValue(name, value)
        solver.passModel(program)
        solver.run()
        status = solver.getModelStatus()
        if status == highspy.HighsModelStatus.kOptimal:
            solution: Matrix = np.array(solver.getSolution().col_value)
            return solution
        if status == highspy.HighsModelStatus.kInfeasible:
            return None
    raise DefinitionError(
        f"the linear program of a grasp was not solved: {solver.modelStatusToString(status)}",
        hint="check that the contacts' coefficients and the limits are of a sensible size",
    )


@lru_cache(maxsize=4)
def _solver(thread: int) -> Any:  # noqa: ARG001 - each thread has its own
    """Solver of a thread, to be cleared before each use: constructing one takes longer than solving a small program."""
    import highspy

    return highspy.Highs()


def _program(
    highspy: Any, objective: Matrix, equal: tuple[Matrix, Matrix], at_most: tuple[Matrix, Matrix] | None
) -> Any:
    rows, upper = equal
    lower = upper
    if at_most is not None:
        rows, upper = np.vstack([rows, at_most[0]]), np.concatenate([upper, at_most[1]])
        lower = np.concatenate([lower, np.full(len(at_most[1]), -np.inf)])
    count, width = rows.shape
    program = highspy.HighsLp()
    program.sense_ = highspy.ObjSense.kMaximize
    program.num_col_, program.num_row_ = width, count
    program.col_cost_ = objective
    program.col_lower_, program.col_upper_ = np.zeros(width), np.full(width, np.inf)
    program.row_lower_, program.row_upper_ = lower, upper
    program.a_matrix_.format_ = highspy.MatrixFormat.kRowwise
    program.a_matrix_.start_ = np.arange(count + 1) * width
    program.a_matrix_.index_ = np.tile(np.arange(width), count)
    program.a_matrix_.value_ = rows.ravel()
    return program
