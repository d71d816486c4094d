"""Choices of several stakeholders, commonly accepted alternatives, and the compromise."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rgss.errors import TradeoffError
from rgss.tradeoff.problem import TIE_TOLERANCE, Array, Mask, checked_values, checked_weights


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class StakeholderView:
    """The alternatives as one stakeholder weighs them.

    Attributes:
        name: The stakeholder.
        weights: The stakeholder's weights, shape (m,).
        best: The best alternatives, ascending.
        best_value: Their weighted value.
        accepted: The alternatives within the stated distance of the best, ascending.
        unknown: The feasible alternatives that lack a value in a measure that the stakeholder weighs, ascending: the
            stakeholder cannot judge them.
        regrets: Difference in value of each alternative to the best, shape (n,); NaN where not feasible or unknown.
    """

    name: str
    weights: Array
    best: tuple[int, ...]
    best_value: float
    accepted: tuple[int, ...]
    unknown: tuple[int, ...]
    regrets: Array


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class StakeholderAgreement:
    """Agreement of several stakeholders, on the feasible alternatives that all of them can judge.

    Attributes:
        views: One for each stakeholder, in the order given.
        accepted_by_all: The alternatives that each stakeholder accepts, ascending.
        compromise: The alternatives whose largest regret over the stakeholders is least, ascending; none if there is no
            alternative that all can judge.
        largest_regret: That regret; within it of each one's best value, the alternatives of the compromise are
            accepted by all. NaN without a compromise.
        most_regretful: The stakeholders that regret the first alternative of the compromise most.
        largest_regrets: The largest regret of each alternative, shape (n,); NaN where one cannot judge it.
        borda: The mean Borda score of each alternative over the stakeholders: the share of the other alternatives that
            it beats, ties by half, shape (n,); NaN where one cannot judge it.
    """

    views: tuple[StakeholderView, ...]
    accepted_by_all: tuple[int, ...]
    compromise: tuple[int, ...]
    largest_regret: float
    most_regretful: tuple[str, ...]
    largest_regrets: Array
    borda: Array


def stakeholder_agreement(
    values: Array, feasible: Mask, stakeholders: Sequence[tuple[str, Array]], *, within: float
) -> StakeholderAgreement:
    """Compare the alternatives under the weights of each stakeholder.

    The regret of an alternative is its difference from the best value under a stakeholder's weights (Savage, "The
    theory of statistical decision", 1951); the compromise has the least maximum regret. All comparisons are by
    enumeration.

    Args:
        values: The single values, shape (n, m); rows that are not feasible may hold NaN, others where a value is
            unknown.
        feasible: Mask of the alternatives that can be chosen, shape (n,); at least one.
        stakeholders: Name and weights, shape (m,), of each; at least one.
        within: Distance from a stakeholder's best value up to which an alternative is accepted; at least 0.

    Raises:
        TradeoffError: Nothing is feasible, there is no stakeholder, the distance is negative, the weights are invalid,
        or a stakeholder can judge no alternative.
    """
    if not feasible.any() or not stakeholders:
        what = "no stakeholder is named" if feasible.any() else "no alternative is feasible"
        raise TradeoffError(what, hint="compare at least one alternative for at least one stakeholder")
    if not (np.isfinite(within) and within >= 0.0):
        raise TradeoffError(f"the accepted distance must be at least 0, got {within:g}", hint="give a value from 0 on")
    views = tuple(_view(values, feasible, name, weights, within=within) for name, weights in stakeholders)
    each = np.stack([view.regrets for view in views])
    rows = np.flatnonzero(~np.isnan(each).any(axis=0))
    if not len(rows):
        unknown = np.full(len(values), np.nan)
        return StakeholderAgreement(
            views=views,
            accepted_by_all=(),
            compromise=(),
            largest_regret=np.nan,
            most_regretful=(),
            largest_regrets=unknown,
            borda=unknown,
        )
    each = each[:, rows]
    largest = each.max(axis=0)
    compromise = largest <= largest.min() + TIE_TOLERANCE
    first = int(np.flatnonzero(compromise)[0])
    scores = np.mean([_borda(regrets) for regrets in each], axis=0)
    return StakeholderAgreement(
        views=views,
        accepted_by_all=_rows(rows, largest <= within + TIE_TOLERANCE),
        compromise=_rows(rows, compromise),
        largest_regret=float(largest.min()),
        most_regretful=tuple(
            view.name
            for view, regret in zip(views, each[:, first], strict=True)
            if regret >= largest[first] - TIE_TOLERANCE
        ),
        largest_regrets=_spread(largest, rows, len(values)),
        borda=_spread(scores, rows, len(values)),
    )


def _view(values: Array, feasible: Mask, name: str, weights: Array, *, within: float) -> StakeholderView:
    """The feasible alternatives as one stakeholder weighs them, without those that the stakeholder cannot judge."""
    checked = checked_weights(weights, values.shape[1])
    weighed = checked > 0.0
    known = ~np.isnan(values[:, weighed]).any(axis=1)
    rows = np.flatnonzero(feasible & known)
    if not len(rows):
        raise TradeoffError(
            f"no feasible alternative is known in every measure that {name!r} weighs",
            hint="weigh measures that a feasible alternative has, or add evidence",
        )
    totals = checked_values(values[np.ix_(rows, weighed)]) @ checked[weighed]
    regrets = totals.max() - totals
    return StakeholderView(
        name=name,
        weights=weights,
        best=_rows(rows, regrets <= TIE_TOLERANCE),
        best_value=float(totals.max()),
        accepted=_rows(rows, regrets <= within + TIE_TOLERANCE),
        unknown=tuple(int(row) for row in np.flatnonzero(feasible & ~known)),
        regrets=_spread(regrets, rows, len(values)),
    )


def _borda(regrets: Array) -> Array:
    """Borda score: share of the others that each beats, ties counted half; 1 without others."""
    if len(regrets) == 1:
        return np.ones(1)
    ordered = np.sort(regrets)
    worse = len(regrets) - np.searchsorted(ordered, regrets + TIE_TOLERANCE, side="right")
    tied = np.searchsorted(ordered, regrets + TIE_TOLERANCE, side="right") - np.searchsorted(
        ordered, regrets - TIE_TOLERANCE, side="left"
    )
    return np.asarray((worse + 0.5 * (tied - 1)) / (len(regrets) - 1), dtype=np.float64)


def _rows(rows: NDArray[np.intp], among: Mask) -> tuple[int, ...]:
    return tuple(int(row) for row in rows[among])


def _spread(numbers: Array, rows: NDArray[np.intp], size: int) -> Array:
    full = np.full(size, np.nan)
    full[rows] = numbers
    return full
