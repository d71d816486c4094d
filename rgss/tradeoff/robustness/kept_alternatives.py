"""Alternatives worth keeping: those within a margin of the best for some admitted weights.

An alternative i that no other dominates is kept if some admitted weights w give ``max_j (v_j - v_i) w <= margin``. The
least such maximum is a linear program; with a margin of 0 its alternatives are the potentially optimal ones (Hazen,
"Partial information, dominance, and potential optimality in multiattribute utility theory", 1986). The dual of the
program names the alternatives that beat one that is not kept. An alternative dominated over the weights is not kept,
although they tie at some weights, such as those of a measure in which all are equal; unless the other never leads by
more than the margin.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import Enum

import numpy as np
from numpy.typing import NDArray

from rgss.errors import TradeoffError
from rgss.tradeoff.milp import SOLVER_TOLERANCE
from rgss.tradeoff.problem import TIE_TOLERANCE, Array, Mask, checked_values, checked_weights, classes, nondominated
from rgss.tradeoff.robustness.row_comparisons import dominating_rival
from rgss.tradeoff.weights import Polytope, WeightSet

_SHARE_OF_MIXTURE = 1e-6
"""A smaller share of a mixture is rounding of the solver."""


class KeptFor(str, Enum):
    """Reason why an alternative is kept or not.

    Attributes:
        BEST_AS_STATED: It is best at the weights of the study.
        BEST_FOR_SOME: It is best for some admitted weights.
        WITHIN_MARGIN: It comes within the margin of the best for some admitted weights.
        DOMINATED: Another is worth at least as much at all admitted weights, and more by over the margin at some.
        MIXTURE: At any admitted weights one of several others is worth more by at least the shortfall.
    """

    BEST_AS_STATED = "best_as_stated"
    BEST_FOR_SOME = "best_for_some"
    WITHIN_MARGIN = "within_margin"
    DOMINATED = "dominated"
    MIXTURE = "mixture"


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class KeptAlternative:
    """An alternative with the reason that it is kept or not.

    Attributes:
        row: The alternative.
        reason: The reason.
        shortfall: The least by which the best is worth more, over all admitted weights; of one that another
            dominates, the least lead of that one. At least 0.
        behind: Lead in value of the best at the weights of the study.
        weights: The admitted weights nearest to the study's, by the sum of differences, at which it is best, or
            within the margin of the best, shape (m,); of one that is not kept for a mixture, weights at which
            the shortfall is reached; None of one that another dominates.
        beaten_by: Of one that is not kept, the alternative that dominates it, or several of which one beats
            it at any admitted weights; ascending. Empty of one that is kept.
    """

    row: int
    reason: KeptFor
    shortfall: float
    behind: float
    weights: Array | None
    beaten_by: tuple[int, ...]

    @property
    def is_kept(self) -> bool:
        """True if it is worth keeping."""
        return self.reason not in (KeptFor.DOMINATED, KeptFor.MIXTURE)


def worth_keeping(
    values: Array, feasible: Mask, weights: Array, *, among: WeightSet, margin: float
) -> tuple[KeptAlternative, ...]:
    """Divide the feasible alternatives into those worth keeping and the rest.

    Alternatives of the same values have the same reason.

    Args:
        values: The single values, shape (n, m); rows that are not feasible may hold NaN.
        feasible: Mask of the alternatives that can be chosen, shape (n,).
        weights: The weights of the decision, shape (m,).
        among: The admitted weights.
        margin: Difference in weighted value that counts as nothing; at least 0.

    Returns:
        One entry for each feasible alternative, by ascending row.

    Raises:
        TradeoffError: The margin is negative, a value is not a number from 0 to 1, or no weights are admitted.
    """
    if not (np.isfinite(margin) and margin >= 0.0):
        raise TradeoffError(f"the margin must be at least 0, got {margin:g}", hint="give a value such as 0.01")
    rows = np.flatnonzero(feasible)
    if not len(rows):
        return ()
    distinct, membership = classes(checked_values(values[rows]))
    here = checked_weights(weights, distinct.shape[1])
    first_of = [int(rows[membership == kind][0]) for kind in range(len(distinct))]
    # What another dominates is never worth more than that one, so the front alone can beat anything.
    front = np.flatnonzero(nondominated(distinct))
    place = _Placing(values=distinct, front=front, here=here, among=among, margin=margin, first_of=first_of)
    found = [place.of(kind) for kind in range(len(distinct))]
    return tuple(replace(found[kind], row=int(row)) for row, kind in zip(rows, membership, strict=True))


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Placing:
    """Places one class of equal alternatives after the other."""

    values: Array
    front: NDArray[np.intp]
    here: Array
    among: WeightSet
    margin: float
    first_of: list[int]

    def of(self, kind: int) -> KeptAlternative:
        others = self.front[self.front != kind]
        leads = self.values[others] - self.values[kind]
        behind = max(0.0, float((leads @ self.here).max(initial=0.0)))

        def made(
            reason: KeptFor, shortfall: float, weights: Array | None, beaten_by: tuple[int, ...] = ()
        ) -> KeptAlternative:
            return KeptAlternative(
                row=self.first_of[kind],
                reason=reason,
                shortfall=max(0.0, shortfall),
                behind=behind,
                weights=weights,
                beaten_by=beaten_by,
            )

        if behind <= TIE_TOLERANCE:
            return made(KeptFor.BEST_AS_STATED, 0.0, self.here)
        dominating = dominating_rival(leads, self.here, self.among, margin=self.margin)
        if dominating is not None:
            rival, least = dominating
            return made(KeptFor.DOMINATED, least, None, (self.first_of[int(others[rival])],))
        shortfall, weights, mixture = _least_shortfall(leads, self.among)
        # One that another never trails is best only where both tie, which is not a reason of its own.
        tied_only = dominating_rival(leads, self.here, self.among, margin=0.0) is not None
        if shortfall <= TIE_TOLERANCE and not tied_only:
            return made(KeptFor.BEST_FOR_SOME, shortfall, self._nearest(leads, shortfall, weights))
        if shortfall <= self.margin + TIE_TOLERANCE:
            return made(KeptFor.WITHIN_MARGIN, shortfall, self._nearest(leads, max(shortfall, self.margin), weights))
        beaten_by = sorted(self.first_of[int(others[one])] for one in np.flatnonzero(mixture > _SHARE_OF_MIXTURE))
        return made(KeptFor.MIXTURE, shortfall, weights, tuple(beaten_by))

    def _nearest(self, leads: Array, allowed: float, otherwise: Array) -> Array:
        """The admitted weights nearest to the study's at which no other leads by more than is allowed."""
        region = Polytope.of(self.among, leads, np.full(len(leads), allowed))
        found = region.nearest_in_sum(self.here)
        return otherwise if found is None else found


def _least_shortfall(leads: Array, among: WeightSet) -> tuple[float, Array, Array]:
    """The least t with ``leads w <= t`` for admitted weights w, such weights, and the shares of the dual.

    Args:
        leads: Lead in value of each other alternative, shape (k, m).
        among: The admitted weights.
    """
    from scipy.optimize import linprog

    size = among.size
    equation_rows, equals = among.equations()
    result = linprog(
        np.concatenate([np.zeros(size), [1.0]]),
        A_ub=np.vstack(
            [
                np.hstack([leads, -np.ones((len(leads), 1))]),
                np.hstack([among.inequality, np.zeros((len(among.limits), 1))]),
            ]
        ),
        b_ub=np.concatenate([np.zeros(len(leads)), among.limits]),
        A_eq=np.hstack([equation_rows, np.zeros((len(equation_rows), 1))]),
        b_eq=equals,
        bounds=[(0.0, None)] * size + [(None, None)],
        method="highs",
        options={
            "primal_feasibility_tolerance": SOLVER_TOLERANCE,
            "dual_feasibility_tolerance": SOLVER_TOLERANCE,
        },
    )
    if result.status != 0:
        raise TradeoffError(
            "no weights satisfy all the elicited bounds and orders", hint="widen a bound, or drop an order"
        )
    weights = np.clip(np.asarray(result.x[:size], dtype=np.float64), 0.0, 1.0)
    # Recomputed from the weights, so that the figure holds at the weights that are shown.
    shortfall = float((leads @ weights).max(initial=0.0))
    return shortfall, weights, -np.asarray(result.ineqlin.marginals[: len(leads)], dtype=np.float64)
