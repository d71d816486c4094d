"""Exact reduction: removal of alternatives that provably cannot be chosen, before a large program is built."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from rgss.tradeoff.problem import nondominated

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from rgss.tradeoff.programs import Enumeration

LARGEST_UNREDUCED = 2_000
"""Up to so many alternatives the program takes them all, and the solver itself finds the infeasible."""

WIDEST_CRITERIA = 12
"""Beyond so many criteria hardly any alternative dominates another."""


def reduced_rows(enumeration: Enumeration) -> NDArray[np.intp]:
    """The rows of the alternatives that the program has to consider, ascending.

    Above `LARGEST_UNREDUCED` alternatives,

    - those that violate a demand are left out: no feasible selection can contain them;
    - those that another feasible alternative dominates are left out: every program prefers more of
      each criterion to less, so the other one is at least as good, and the optimum stays;
    - if nothing is feasible, one alternative of each set of violated demands is kept: the program
      is infeasible with all of them exactly if it is with these.

    Returns:
        Rows, of all alternatives or of those that are left.
    """
    if len(enumeration.table) <= LARGEST_UNREDUCED:
        return np.arange(len(enumeration.table), dtype=np.intp)
    feasible = np.flatnonzero(enumeration.feasible)
    if not feasible.size:
        _, first = np.unique(enumeration.violated, axis=0, return_index=True)
        return np.sort(first).astype(np.intp)
    criteria = enumeration.ordering.criteria()
    if criteria is None or criteria.shape[1] > WIDEST_CRITERIA:
        return feasible
    return np.asarray(feasible[nondominated(criteria[feasible])], dtype=np.intp)
