"""Weights from pairwise answers: logarithmic least squares, or the centre of the weights that agree."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from rgss.errors import TradeoffError
from rgss.tradeoff.elicitation.answers import PairwiseAnswer, connected_parts
from rgss.tradeoff.elicitation.consistency import consistency_of
from rgss.tradeoff.elicitation.contradictions import contradiction_of
from rgss.tradeoff.elicitation.difference_bounds import bound_rows, implied_bounds, least_missing
from rgss.tradeoff.elicitation.elicited_weights import ElicitedWeights, FitMethod
from rgss.tradeoff.elicitation.least_squares import Array, answer_row, bounded_fit, design_matrix
from rgss.tradeoff.problem import WeightBounds
from rgss.tradeoff.weights import Polytope, WeightSet, centroid


def weights_from_answers(names: Sequence[str], answers: Sequence[PairwiseAnswer]) -> ElicitedWeights:
    """Weights that answers imply.

    Ratios, and the geometric means of ranges, are fitted by least squares of logarithms where they connect
    all members; orders and ranges hold exactly. Where they do not connect all, the weights are the
    centroid of those that agree with the bounds and, within the least factor that is possible, with the
    ratios. Of a complete order alone that is the rank-order centroid.

    Args:
        names: The members; at least one.
        answers: The answers, which name no other.

    Raises:
        TradeoffError: A member is in no answer, or bounds contradict each other.
    """
    missing = [name for name in names if not any(name in (one.swing_of, one.over) for one in answers)]
    if missing and len(names) > 1:
        raise TradeoffError(
            f"no answer names {', '.join(map(repr, missing))}", hint="compare each criterion with another, or drop it"
        )
    bounds = [answer for answer in answers if not answer.is_ratio]
    contradiction = contradiction_of(names, bounds)
    if contradiction is not None:
        raise TradeoffError(
            f"{contradiction.words} cannot hold together: around the circle the product is "
            f"{contradiction.factor:.3g}, above 1",
            hint="withdraw one of them, or loosen one by that factor",
        )
    measured = [answer for answer in answers if math.isfinite(answer.most)]
    if len(connected_parts(names, measured)) == 1:
        method, logs = FitMethod.LEAST_SQUARES, _fitted(names, measured, bounds)
        factor, weights = _factor(names, answers, logs), _normalised(logs)
    else:
        method = FitMethod.CENTRE
        logs, factor = least_missing(names, answers, bounds)
        weights = centroid(_agreeing(names, answers, logs))
    low, high = weight_extents(names, answers, factor)
    fits = np.array([weights, *(_normalised(logs) for logs in _fits_without_one(names, measured, bounds))])
    return ElicitedWeights(
        answers=tuple(answers),
        weights=_by_name(names, weights),
        method=method,
        factor=factor,
        low=_by_name(names, np.minimum(low, fits.min(axis=0))),
        high=_by_name(names, np.maximum(high, fits.max(axis=0))),
        consistency=consistency_of(names, answers),
    )


def _fitted(names: Sequence[str], measured: Sequence[PairwiseAnswer], bounds: Sequence[PairwiseAnswer]) -> Array:
    matrix, logs = design_matrix(names, measured)
    return bounded_fit(matrix, logs, *bound_rows(names, bounds))


def _fits_without_one(
    names: Sequence[str], measured: Sequence[PairwiseAnswer], bounds: Sequence[PairwiseAnswer]
) -> list[Array]:
    """The fits without each of the ratios, where the others connect all members."""
    fits = []
    for place, answer in enumerate(measured):
        others = [one for number, one in enumerate(measured) if number != place]
        if answer.is_ratio and len(connected_parts(names, others)) == 1:
            fits.append(_fitted(names, others, bounds))
    return fits


def _normalised(logs: Array) -> Array:
    weights = np.exp(logs - logs.max())
    return np.asarray(weights / weights.sum(), dtype=np.float64)


def _factor(names: Sequence[str], answers: Sequence[PairwiseAnswer], logs: Array) -> float:
    """By how much the worst ratio is missed."""
    missed = [abs(float(answer_row(names, one) @ logs) - math.log(one.ratio)) for one in answers if one.is_ratio]
    return math.exp(max(missed, default=0.0))


def _agreeing(names: Sequence[str], answers: Sequence[PairwiseAnswer], logs: Array) -> Polytope:
    """The weights that agree with the bounds, and with the ratios as some weights have them."""
    # Ratios that disagree leave no room within the least factor; those of weights agree exactly.
    met = [
        replace(one, least=ratio, most=ratio)
        for one in answers
        if one.is_ratio
        for ratio in [math.exp(float(answer_row(names, one) @ logs))]
    ]
    orders = tuple(order for one in (*met, *(one for one in answers if not one.is_ratio)) for order in one.orders())
    rows, limits = WeightBounds(orders=orders).system(names)
    return Polytope.of(WeightSet.cut(rows, limits))


def weight_extents(names: Sequence[str], answers: Sequence[PairwiseAnswer], factor: float) -> tuple[Array, Array]:
    """The least and the greatest of each weight that agrees with bounds, and with ratios within a factor.

    In logarithms these are difference constraints. The tightest bounds that they imply on the differences from
    one criterion can all be reached at once (they are the shortest paths from it), so that the extents follow
    without a program: the greatest weight is ``1 / Σ_j exp(lower_j)``.

    Args:
        names: The criteria.
        answers: The answers.
        factor: The factor, at least 1.

    Returns:
        Shapes (n,) each.
    """
    lower = implied_bounds(names, answers, factor=factor)
    high = 1.0 / np.exp(lower).sum(axis=1)
    with np.errstate(over="ignore"):
        low = 1.0 / np.exp(-lower).sum(axis=0)
    return low, np.asarray(high, dtype=np.float64)


def _by_name(names: Sequence[str], weights: Array) -> dict[str, float]:
    return dict(zip(names, (float(weight) for weight in weights), strict=True))
