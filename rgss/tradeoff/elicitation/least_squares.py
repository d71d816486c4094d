"""Logarithmic least squares under linear bounds."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from rgss.errors import TradeoffError
from rgss.tradeoff.elicitation.answers import PairwiseAnswer

Array = NDArray[np.float64]


def design_matrix(names: Sequence[str], answers: Sequence[PairwiseAnswer]) -> tuple[Array, Array]:
    """The answers as equations of the logarithms of weights.

    Args:
        names: The criteria.
        answers: The answers; of a range its geometric mean counts.

    Returns:
        The matrix with 1 and -1 in each row, shape (k, n), and the logarithms of the ratios, shape (k,).
    """
    matrix = np.array([answer_row(names, one) for one in answers]).reshape(-1, len(names))
    return matrix, np.array([math.log(answer.ratio) for answer in answers])


def answer_row(names: Sequence[str], answer: PairwiseAnswer) -> Array:
    """Coefficients of the logarithm of the ratio of an answer, shape (n,)."""
    row = np.zeros(len(names))
    row[names.index(answer.swing_of)], row[names.index(answer.over)] = 1.0, -1.0
    return row


def fitted_logs(matrix: Array, logs: Array) -> Array:
    """Logarithms of weights by least squares; of a complete matrix, the geometric means of its rows."""
    return np.asarray(np.linalg.lstsq(matrix, logs, rcond=None)[0], dtype=np.float64)


def bounded_fit(matrix: Array, logs: Array, rows: Array, limits: Array) -> Array:
    """The logarithms u that minimise ``|matrix u - logs|²`` subject to ``rows u >= limits``.

    The logarithm of the first weight is 0. Solved as a least-distance program by non-negative least squares
    (Lawson and Hanson, *Solving Least Squares Problems*, 1974, chapter 23).

    Args:
        matrix: The equations, shape (k, n), of rank n - 1.
        logs: Their right-hand sides.
        rows: The bounds, shape (q, n).
        limits: Their right-hand sides.

    Raises:
        TradeoffError: Nothing satisfies the bounds.
    """
    from scipy.optimize import nnls

    triangular = np.linalg.qr(matrix[:, 1:])
    target = triangular.Q.T @ logs
    inverse = np.linalg.inv(triangular.R)
    free = inverse @ target
    slack = limits - rows[:, 1:] @ free
    if not len(rows) or (slack <= 0.0).all():
        return np.concatenate([[0.0], free])
    stacked = np.vstack([(rows[:, 1:] @ inverse).T, slack[None, :]])
    goal = np.zeros(len(stacked))
    goal[-1] = 1.0
    multipliers, _ = nnls(stacked, goal, maxiter=50 * stacked.shape[1])
    residual = stacked @ multipliers - goal
    if -residual[-1] < 1e-12:
        raise TradeoffError("no weights satisfy all answers", hint="withdraw one of the bounds")
    return np.concatenate([[0.0], free + inverse @ (residual[:-1] / -residual[-1])])
