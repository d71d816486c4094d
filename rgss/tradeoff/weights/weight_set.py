"""The weights that are admitted: the simplex, cut by what was elicited."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rgss.errors import TradeoffError
from rgss.tradeoff.milp import solve_linear

Array = NDArray[np.float64]

ALWAYS_TIGHT = 1e-9
"""A condition that cannot be satisfied with more room than this holds with equality."""

_SAME_DIRECTION = 1e-9


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class WeightSet:
    """Weights w with w >= 0, sum w = 1, and linear conditions beyond these.

    Attributes:
        size: The number m of weights.
        inequality: Rows a of conditions a w <= c, shape (k, m); non-negativity is not among them.
        limits: The right-hand sides c, shape (k,).
        equality: Rows of conditions that hold with equality, shape (q, m); the sum is not among them.
        equals: Their right-hand sides, shape (q,).
    """

    size: int
    inequality: Array
    limits: Array
    equality: Array
    equals: Array

    @staticmethod
    def simplex(size: int) -> WeightSet:
        """Every weight is admitted.

        Args:
            size: The number of weights, at least 1.
        """
        nothing, none = np.zeros((0, size)), np.zeros(0)
        return WeightSet(size=size, inequality=nothing, limits=none, equality=nothing, equals=none)

    @staticmethod
    def cut(rows: Array, limits: Array) -> WeightSet:
        """Weights that satisfy further inequalities, such as those of elicited bounds and orders.

        Inequalities that can only hold with equality become equations, so that a weight that is
        fixed takes no room.

        Args:
            rows: Coefficients a of a w <= c, shape (k, m).
            limits: The right-hand sides c, shape (k,).

        Raises:
            TradeoffError: No weights satisfy them all.
        """
        size = rows.shape[1]
        every = np.vstack([rows, -np.eye(size)])
        ends = np.concatenate([limits, np.zeros(size)])
        least = [solve_linear(row, every, ends, np.ones((1, size)), np.ones(1), [(None, None)] * size) for row in every]
        slack = [
            None if weights is None else end - float(row @ weights)
            for row, end, weights in zip(every, ends, least, strict=True)
        ]
        if None in slack:
            raise TradeoffError(
                "no weights satisfy all the elicited bounds and orders", hint="widen a bound, or drop an order"
            )
        tight = np.array([room is not None and room <= ALWAYS_TIGHT for room in slack])
        loose = ~tight[: len(rows)]
        return WeightSet(
            size=size, inequality=rows[loose], limits=limits[loose], equality=every[tight], equals=ends[tight]
        )

    @property
    def is_simplex(self) -> bool:
        """True if non-negativity and the sum are the only bounds."""
        return not len(self.limits) and not len(self.equals)

    def conditions(self) -> tuple[Array, Array]:
        """All inequalities a w <= c, non-negativity among them: shapes (k + m, m) and (k + m,)."""
        return (
            np.vstack([self.inequality, -np.eye(self.size)]),
            np.concatenate([self.limits, np.zeros(self.size)]),
        )

    def equations(self) -> tuple[Array, Array]:
        """All equations, the sum first: shapes (q + 1, m) and (q + 1,)."""
        return np.vstack([np.ones((1, self.size)), self.equality]), np.concatenate([[1.0], self.equals])

    def directions(self) -> Array:
        """An orthonormal basis of the directions in which weights may move, shape (m, d).

        They are the weights' own axes, orthogonalised one after the other, and so the same on every
        machine up to rounding.
        """
        rows, _ = self.equations()
        found: list[Array] = []
        for axis in np.eye(self.size):
            left = axis - rows.T @ np.linalg.lstsq(rows.T, axis, rcond=None)[0]
            for other in found:
                left = left - (left @ other) * other
            length = float(np.linalg.norm(left))
            if length > _SAME_DIRECTION:
                found.append(left / length)
        return np.asarray(np.array(found).reshape(-1, self.size).T, dtype=np.float64)
