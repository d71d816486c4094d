"""Lower bound on the number of members of a cover: dual weights of the tasks, in exact arithmetic."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rgss.errors import TradeoffError

Reached = NDArray[np.float64]
"""1 where a member serves a task at the level, 0 elsewhere, shape (members, tasks)."""

UNITS = 2.0**30
"""Weights are whole multiples of one in so many parts: sums of them are exact in float64."""

LARGEST_PROGRAM = 500_000
"""Up to so many members times tasks the linear program is solved: about a second, which no limit can interrupt."""


@dataclass(frozen=True, slots=True, eq=False)
class CoverBound:
    """Task weights that bound covers.

    The share of a member is the sum of the weights of the tasks that it serves. Members whose shares sum to less than
    the weights of all tasks do not cover them, for any weights; so a bound from the linear program is verified by
    addition, and valid even if its solution is inexact.

    Attributes:
        weights: Integers, one row for each set of weights, shape (sets, tasks).
    """

    weights: NDArray[np.float64]

    @staticmethod
    def of(reached: Reached) -> CoverBound:
        """Equal weights, and the dual solution of the linear relaxation of the smallest cover.

        ``max Σ_t y_t`` subject to ``Σ_t a_gt y_t <= 1`` for every member g (Chvátal, "A greedy heuristic for
        the set-covering problem", 1979).

        Args:
            reached: True where a member serves a task.
        """
        from rgss.tradeoff.milp import solve_linear

        tasks = reached.shape[1]
        equal = np.ones(tasks)
        if reached.size > LARGEST_PROGRAM:
            return CoverBound(equal[None, :])
        none = np.zeros((0, tasks))
        try:
            dual = solve_linear(-equal, reached, np.ones(len(reached)), none, np.zeros(0), [(0.0, 1.0)] * tasks)
        except TradeoffError:
            # Without an answer there are the equal weights alone.
            dual = None
        sets = [equal] if dual is None else [equal, np.floor(np.clip(dual, 0.0, 1.0) * UNITS)]
        return CoverBound(np.stack(sets))

    def shares(self, reached: Reached, left: NDArray[np.float64]) -> NDArray[np.float64]:
        """The share of each member in the tasks that are left, shape (members, sets)."""
        return np.asarray(reached @ (self.weights * left).T)

    def excludes(self, shares: NDArray[np.float64], left: NDArray[np.float64], size: int) -> bool:
        """True if so many members cannot cover the tasks that are left."""
        top = shares if size >= len(shares) else np.partition(shares, len(shares) - size, axis=0)[-size:]
        return bool((top.sum(axis=0) < self.weights @ left).any())


def masks_of(reached: NDArray[np.bool_]) -> Sequence[int]:
    """The tasks that each member serves, as the bits of a whole number."""
    packed = np.packbits(reached, axis=1, bitorder="little")
    return [int.from_bytes(row.tobytes(), "little") for row in packed]
