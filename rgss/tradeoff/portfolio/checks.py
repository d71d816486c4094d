"""Checks of a portfolio: the mixed-integer program by HiGHS, and enumeration of all portfolios."""

from __future__ import annotations

import itertools
import math
from enum import Enum
from typing import TYPE_CHECKING, Any

from rgss.errors import TradeoffError
from rgss.tradeoff.milp import FIRST_RUN, INTEGRALITY_TOLERANCE, OBJECTIVE_SCALE, SolverRun, solve_program
from rgss.tradeoff.problem import TIE_TOLERANCE

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

MOST_ENTRIES = 20_000_000
"""Largest number of values of members in tasks that are evaluated to enumerate all portfolios."""

LARGEST_SOLVED = 2_500
"""Up to so many values of members in tasks the mixed-integer program is solved as well."""

PORTFOLIO_RUN = SolverRun(name=FIRST_RUN.name, options={**FIRST_RUN.options, "mip_max_nodes": 5_000})
"""The options of that run; a proof that takes more nodes is left to the bounds."""


class PortfolioAim(str, Enum):
    """Objective of a portfolio: the weighted mean of the tasks' values, or the worst of them."""

    MEAN = "mean"
    WORST = "worst"


def portfolio_objective(values: NDArray[np.float64], weights: NDArray[np.float64], aim: PortfolioAim) -> Any:
    """The objective of portfolios, shape (..., members, tasks) to (...); negative where a task is not served."""
    import numpy as np

    best = values.max(axis=-2)
    served = (best >= 0.0).all(axis=-1)
    score = best @ weights if aim is PortfolioAim.MEAN else best.min(axis=-1)
    return np.where(served, score, -1.0)


def solved_portfolio(
    values: NDArray[np.float64],
    weights: NDArray[np.float64],
    at_most: int,
    aim: PortfolioAim,
    run: SolverRun = PORTFOLIO_RUN,
) -> tuple[int, ...] | None:
    """The chosen rows of the mixed-integer program; None if the solver calls it infeasible.

    ``max Σ_t w_t Σ_g h_gt x_gt`` (or the least of ``Σ_g h_gt x_gt``) with ``Σ_g x_gt = 1``, ``x_gt <= y_g``,
    ``Σ_g y_g <= k``, y boolean: the facility-location model.

    Raises:
        TradeoffError: The solver failed, proved neither, or its answer is not a portfolio.
    """
    import cvxpy
    import numpy as np

    members, tasks = values.shape
    chosen = cvxpy.Variable(members, boolean=True)
    serves = cvxpy.Variable((members, tasks), nonneg=True)
    able = values >= 0.0
    constraints = [
        cvxpy.sum(serves, axis=0) == 1.0,
        serves <= cvxpy.multiply(able, chosen[:, None] @ np.ones((1, tasks))),
        cvxpy.sum(chosen) <= float(at_most),
    ]
    by_task = cvxpy.sum(cvxpy.multiply(np.where(able, values, 0.0), serves), axis=0)
    objective = weights @ by_task if aim is PortfolioAim.MEAN else cvxpy.min(by_task)
    program = cvxpy.Problem(cvxpy.Maximize(OBJECTIVE_SCALE * objective), constraints)
    if not solve_program(program, run):
        return None
    answer = np.asarray(chosen.value, dtype=np.float64)
    error = float(np.abs(answer - answer.round()).max())
    if error > INTEGRALITY_TOLERANCE:
        raise TradeoffError(
            f"the solver's answer selects no portfolio (off by {error:.3g})",
            hint="the answer is not used; look for measures of extreme magnitude",
        )
    open_rows = np.flatnonzero(answer > 0.5)
    # The program may choose a member that is the best in no task; it is left out.
    return tuple(sorted({int(open_rows[place]) for place in values[open_rows].argmax(axis=0)}))


def best_portfolio(
    values: NDArray[np.float64], weights: NDArray[np.float64], at_most: int, aim: PortfolioAim
) -> tuple[tuple[int, ...] | None, float] | None:
    """The best portfolio of all, with the fewest members; None if there are too many to enumerate."""
    import numpy as np

    count = len(values)
    sizes = range(1, min(at_most, count) + 1)
    if sum(math.comb(count, size) * size for size in sizes) * values.shape[1] > MOST_ENTRIES:
        return None
    best: tuple[tuple[int, ...] | None, float] = (None, -1.0)
    for size in sizes:
        portfolios = np.array(list(itertools.combinations(range(count), size)), dtype=np.intp)
        scores = portfolio_objective(values[portfolios], weights, aim)
        top = float(scores.max())
        if top >= 0.0 and (best[0] is None or top > best[1] + TIE_TOLERANCE):
            place = int(np.flatnonzero(scores >= top - TIE_TOLERANCE)[0])
            best = (tuple(portfolios[place].tolist()), top)
    return best
