"""The weights at which one alternative leads another by most: a linear program over the admitted weights."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rgss.errors import TradeoffError
from rgss.tradeoff.milp import rerun_solver

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class WorstWeights:
    """An optimum of ``max c w`` over ``{w : w >= 0, sum(w) = 1, A w <= b}``.

    Attributes:
        weights: The maximiser, shape (m,).
        value: The maximum.
        multipliers: Dual multipliers of ``A w <= b``, none negative, shape (k,). Of any objective c they
            prove the bound ``b λ + max_j (c - Aᵀ λ)_j`` (weak duality over the simplex).
    """

    weights: Array
    value: float
    multipliers: Array


@dataclass(frozen=True, slots=True, eq=False)
class WeightProgram:
    """Linear programs over one set of weights, each started from the optimum of the one before.

    Attributes:
        rows: The coefficients A, shape (k, m).
        limits: The right-hand sides b, shape (k,).
    """

    rows: Array
    limits: Array
    _solver: list[Any] = field(default_factory=list)

    def maximise(self, objective: Array) -> WorstWeights:
        """The weights of the largest objective c w.

        Args:
            objective: The coefficients c, shape (m,).

        Raises:
            TradeoffError: No weights satisfy the bounds, or the solver gave no optimum.
        """
        import highspy

        is_first = not self._solver
        solver, status = self._run(objective)
        if status != highspy.HighsModelStatus.kOptimal and not is_first:
            # The start from another optimum can end without an answer, where a run from scratch has one.
            self._solver.clear()
            solver, status = self._run(objective)
        if status == highspy.HighsModelStatus.kInfeasible:
            raise TradeoffError("no weights satisfy all the elicited bounds and orders", hint="widen a bound")
        if status != highspy.HighsModelStatus.kOptimal:
            raise TradeoffError(
                f"a linear program over weights ended without an optimum: {solver.modelStatusToString(status)}",
                hint="only a proven optimum is accepted; look for bounds that nearly contradict each other",
            )
        solution = solver.getSolution()
        weights = np.clip(np.array(solution.col_value, dtype=np.float64), 0.0, None)
        weights = weights / weights.sum()
        multipliers = np.clip(-np.array(solution.row_dual, dtype=np.float64)[1:], 0.0, None)
        return WorstWeights(weights=weights, value=float(objective @ weights), multipliers=multipliers)

    def _run(self, objective: Array) -> tuple[Any, Any]:
        """The solver after a run with an objective, and the status of its answer."""
        if not self._solver:
            self._solver.append(self._prepared())
        solver = self._solver[0]
        size = len(objective)
        solver.changeColsCost(size, np.arange(size, dtype=np.int32), np.asarray(-objective, dtype=np.float64))
        solver.run()
        return solver, solver.getModelStatus()

    def _prepared(self) -> Any:
        none = np.full(len(self.limits), -np.inf)
        solver = rerun_solver(
            np.vstack([np.ones((1, self.rows.shape[1])), self.rows]),
            np.concatenate([[1.0], none]),
            np.concatenate([[1.0], self.limits]),
            least=0.0,
        )
        solver.setOptionValue("solver", "simplex")
        return solver
