"""The largest regret of alternatives over bounded weights, without a list of the corners of the weights."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rgss.tradeoff.problem import nondominated
from rgss.tradeoff.programs.worst_weights import WeightProgram

Array = NDArray[np.float64]

CLOSED = 1e-11
"""An alternative's regret is known where its upper and lower bound are no further apart."""

MOST_REMEMBERED = 2_000
"""Of up to so many alternatives the bounds of all pairs are kept for other choices of rivals."""

_MOST_DUALS = 64


class WeightRegret:
    """The regret of each alternative: ``max_w max_y (v_y - v_x) w`` over admitted weights w and rivals y.

    For one pair it is a linear program over the weights. Few pairs need it: weights found before bound
    a regret from below, and the multipliers found before bound every pair's lead from above (weak
    duality), so that only rivals that could raise the regret are solved for, the most promising
    first. It ends with the exact regret, for the bounds meet.
    """

    def __init__(self, values: Array, rows: Array, limits: Array) -> None:
        """Prepare the analysis of some alternatives.

        Args:
            values: Single values, shape (n, m); NaN where unknown.
            rows: Coefficients A of the bounds ``A w <= b`` on the weights, shape (k, m).
            limits: Their right-hand sides b, shape (k,).
        """
        self._values = values
        self._program = WeightProgram(rows, limits)
        self._rows, self._limits = rows, limits
        self._weights = np.zeros((0, values.shape[1]))
        self._duals: list[tuple[float, Array]] = [(0.0, np.zeros(values.shape[1]))]
        self._upper: dict[int, Array] = {}

    def of_all(self, rivals: NDArray[np.bool_]) -> Array:
        """Greatest regret of every alternative, shape (n,).

        Args:
            rivals: Mask of the alternatives that could be chosen instead, shape (n,).

        Returns:
            Regrets; NaN if a value is unknown, and everywhere without rivals.
        """
        worst = np.full(len(self._values), np.nan)
        against = np.flatnonzero(rivals)
        if not len(against):
            return worst
        # What another rival dominates never leads by more than that one, for weights are not negative.
        against = against[nondominated(self._values[against])]
        best = (self._weights @ self._values[against].T).max(axis=1)
        known = np.flatnonzero(~np.isnan(self._values).any(axis=1))
        _, firsts, kinds = np.unique(self._values[known], axis=0, return_index=True, return_inverse=True)
        found = np.empty(len(firsts))
        for kind, row in enumerate(known[firsts]):
            found[kind], best = self._regret(int(row), against, best)
        worst[known] = found[kinds.reshape(-1)]
        return worst

    def _regret(self, row: int, against: NDArray[np.intp], best: Array) -> tuple[float, Array]:
        """Regret of one alternative; and the best value of the rivals at all weights found so far."""
        mine = self._values[row]
        lower = float((best - self._weights @ mine).max(initial=-np.inf))
        upper = self._bounds(row)
        while True:
            place = int(against[upper[against].argmax()])
            if upper[place] <= lower + CLOSED:
                return lower, best
            optimum = self._program.maximise(self._values[place] - mine)
            upper[place] = optimum.value
            self._remember(optimum.multipliers)
            there = float((self._values[against] @ optimum.weights).max())
            if there - mine @ optimum.weights > lower:
                lower = float(there - mine @ optimum.weights)
                self._weights = np.vstack([self._weights, optimum.weights])
                best = np.append(best, there)

    def _bounds(self, row: int) -> Array:
        """Upper bounds of the lead of every alternative over one, shape (n,)."""
        if row in self._upper:
            return self._upper[row]
        leads = self._values - self._values[row]
        upper = np.full(len(leads), np.inf)
        for constant, prices in self._duals:
            upper = np.minimum(upper, constant + (leads - prices).max(axis=1))
        if len(self._values) <= MOST_REMEMBERED:
            self._upper[row] = upper
        return upper

    def _remember(self, multipliers: Array) -> None:
        prices = np.asarray(self._rows.T @ multipliers, dtype=np.float64)
        constant = float(self._limits @ multipliers)
        if all(abs(constant - one) > CLOSED or np.abs(prices - other).max() > CLOSED for one, other in self._duals):
            self._duals = [*self._duals[-_MOST_DUALS + 1 :], (constant, prices)]
