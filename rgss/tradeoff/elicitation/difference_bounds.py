"""Bounds on ratios of weights as difference constraints of their logarithms."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from rgss.errors import TradeoffError
from rgss.tradeoff.elicitation.answers import PairwiseAnswer
from rgss.tradeoff.elicitation.least_squares import Array, answer_row
from rgss.tradeoff.milp import solve_linear


def bound_rows(names: Sequence[str], bounds: Sequence[PairwiseAnswer]) -> tuple[Array, Array]:
    """Bounds on the logarithms of weights as ``rows u >= limits``.

    Args:
        names: The criteria.
        bounds: Orders and ranges.

    Returns:
        Shapes (k, n) and (k,).
    """
    rows, limits = [], []
    for answer in bounds:
        row = answer_row(names, answer)
        rows.append(row)
        limits.append(math.log(answer.least))
        if math.isfinite(answer.most):
            rows.append(-row)
            limits.append(-math.log(answer.most))
    return np.array(rows).reshape(-1, len(names)), np.array(limits)


def least_missing(
    names: Sequence[str], answers: Sequence[PairwiseAnswer], bounds: Sequence[PairwiseAnswer]
) -> tuple[Array, float]:
    """Logarithms of weights that satisfy the bounds and miss all ratios by the least factor, and that factor.

    Args:
        names: The criteria.
        answers: The answers, of which the ratios are read.
        bounds: The orders and ranges.

    Raises:
        TradeoffError: No weights satisfy the bounds.
    """
    ratios = [answer for answer in answers if answer.is_ratio]
    rows, limits = bound_rows(names, bounds)
    signed = np.array([sign * answer_row(names, one) for one in ratios for sign in (1.0, -1.0)]).reshape(-1, len(names))
    logs = np.array([sign * math.log(one.ratio) for one in ratios for sign in (1.0, -1.0)])
    found = solve_linear(
        np.concatenate([np.zeros(len(names)), [1.0]]),
        np.vstack([np.hstack([signed, -np.ones((len(signed), 1))]), np.hstack([-rows, np.zeros((len(rows), 1))])]),
        np.concatenate([logs, -limits]),
        np.concatenate([[1.0], np.zeros(len(names))])[None, :],
        np.zeros(1),
        [(None, None)] * len(names) + [(0.0, None)],
    )
    if found is None:
        raise TradeoffError("no weights satisfy all answers", hint="withdraw one of the bounds")
    return found[:-1], math.exp(float(found[-1]))


def implied_bounds(names: Sequence[str], answers: Sequence[PairwiseAnswer], *, factor: float = 1.0) -> Array:
    """Greatest lower bound of the logarithm of ``w_j / w_i`` at ``[i, j]``, shape (n, n); -inf without one.

    The tightest bounds are the longest paths in the graph of the constraints.

    Args:
        names: The criteria.
        answers: The answers.
        factor: The factor within which ratios are met, at least 1; orders and ranges are met exactly.
    """
    lower = np.full((len(names), len(names)), -np.inf)
    np.fill_diagonal(lower, 0.0)
    slack = math.log(factor)
    for answer in answers:
        one, other = names.index(answer.swing_of), names.index(answer.over)
        room = slack if answer.is_ratio else 0.0
        lower[other, one] = max(lower[other, one], math.log(answer.least) - room)
        if math.isfinite(answer.most):
            lower[one, other] = max(lower[one, other], -math.log(answer.most) - room)
    for through in range(len(names)):
        lower = np.maximum(lower, lower[:, through, None] + lower[None, through, :])
    return lower
