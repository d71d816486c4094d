"""Comparison of one alternative with each other one over all admitted weights."""

from __future__ import annotations

import numpy as np

from rgss.tradeoff.milp import solve_linear
from rgss.tradeoff.problem import Array
from rgss.tradeoff.weights import WeightSet


def least_lead(lead: Array, among: WeightSet) -> float:
    """The least of ``lead w`` over the admitted weights w; NaN if there are none.

    Args:
        lead: What one alternative is worth more than another in each measure, shape (m,).
        among: The admitted weights.
    """
    if among.is_simplex:
        return float(lead.min())
    equation_rows, equals = among.equations()
    weights = solve_linear(lead, among.inequality, among.limits, equation_rows, equals, [(0.0, None)] * among.size)
    return float("nan") if weights is None else float(lead @ weights)


def best_pairwise_rival(leads: Array, among: WeightSet) -> tuple[int, float]:
    """The other alternative that leads by most at the weights at which it leads by least.

    Args:
        leads: What each other alternative is worth more, shape (k, m) with k at least 1.
        among: The admitted weights.

    Returns:
        Its row, of several the first, and its least lead; the alternative is dominated by it if that is
        not negative.
    """
    if among.is_simplex:
        leasts = leads.min(axis=1)
    else:
        # At any single weights the least lead is at most the lead there, so most rivals need no program.
        leasts = np.full(len(leads), -np.inf)
        bound = np.nan_to_num(leads @ _some_weights(among), nan=-np.inf)
        for place in np.argsort(-bound, kind="stable"):
            if bound[place] <= leasts.max():
                break
            leasts[place] = least_lead(leads[place], among)
    best = int(np.argmax(leasts))
    return best, float(leasts[best])


def _some_weights(among: WeightSet) -> Array:
    equation_rows, equals = among.equations()
    found = solve_linear(
        np.zeros(among.size), among.inequality, among.limits, equation_rows, equals, [(0.0, None)] * among.size
    )
    return np.full(among.size, np.nan) if found is None else found
