"""Linear programs over non-negative numbers, solved by HiGHS's simplex."""

from __future__ import annotations

import numpy as np

from rgss.errors import DefinitionError
from rgss.grasping.contact import Matrix

_TOLERANCE = 1e-10
_OPTIMAL, _INFEASIBLE = 0, 2


def maximise(
    objective: Matrix, *, equal: tuple[Matrix, Matrix], at_most: tuple[Matrix, Matrix] | None = None
) -> Matrix | None:
    """Maximise objective·x over x ≥ 0.

    Args:
        objective: Shape (n,).
        equal: Rows and right sides that x meets exactly, shapes (p, n) and (p,).
        at_most: Rows and right sides that x does not exceed, shapes (q, n) and (q,).

    Returns:
        The maximiser, shape (n,); None if no x meets the rows.

    Raises:
        DefinitionError: The solver reached no verdict.
    """
    from scipy.optimize import linprog

    rows, limits = at_most if at_most is not None else (None, None)
    # Such programs are small, and presolving takes as long as solving. Where coefficients of very different size make
    # the simplex give up, the interior-point method may not.
    for method, presolve in (("highs-ds", False), ("highs-ipm", True)):
        result = linprog(
            -objective,
            A_ub=rows,
            b_ub=limits,
            A_eq=equal[0],
            b_eq=equal[1],
            bounds=(0.0, None),
            method=method,
            options={
                "presolve": presolve,
                "primal_feasibility_tolerance": _TOLERANCE,
                "dual_feasibility_tolerance": _TOLERANCE,
            },
        )
        if result.status == _OPTIMAL:
            solution: Matrix = np.asarray(result.x)
            return solution
        if result.status == _INFEASIBLE:
            return None
    raise DefinitionError(
        f"the linear program of a grasp was not solved: {' '.join(str(result.message).split())}",
        hint="check that the contacts' coefficients and the limits are of a sensible size",
    )
