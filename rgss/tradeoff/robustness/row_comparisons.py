"""Dominance of one alternative by another over all admitted weights."""

from __future__ import annotations

import numpy as np

from rgss.tradeoff.milp import solve_linear
from rgss.tradeoff.problem import TIE_TOLERANCE, Array
from rgss.tradeoff.weights import WeightSet


def dominating_rival(leads: Array, here: Array, among: WeightSet, *, margin: float) -> tuple[int, float] | None:
    """Alternative that dominates another over the admitted weights, with a lead above a margin at some weights.

    Args:
        leads: Lead in value of each other alternative in each measure, shape (k, m).
        here: Admitted weights, shape (m,); of several dominating alternatives, the one with the greatest lead there is
            returned, and of equal ones the first.
        among: The admitted weights.
        margin: The margin.

    Returns:
        Its row and its least lead; None if there is none.
    """
    at_here = leads @ here
    for place in np.argsort(-np.round(at_here, 12), kind="stable"):
        if at_here[place] < -TIE_TOLERANCE:
            break
        least, greatest = lead_range(leads[place], among)
        if least >= -TIE_TOLERANCE and greatest > margin + TIE_TOLERANCE:
            return int(place), max(0.0, least)
    return None


def lead_range(lead: Array, among: WeightSet) -> tuple[float, float]:
    """The least and the greatest of ``lead w`` over the admitted weights w, of which there are some.

    Args:
        lead: Lead in value of one alternative over another in each measure, shape (m,).
        among: The admitted weights.
    """
    if among.is_simplex:
        return float(lead.min()), float(lead.max())
    equation_rows, equals = among.equations()
    ends = []
    for sign in (1.0, -1.0):
        weights = solve_linear(
            sign * lead, among.inequality, among.limits, equation_rows, equals, [(0.0, None)] * among.size
        )
        ends.append(float("nan") if weights is None else float(lead @ weights))
    return ends[0], ends[1]
