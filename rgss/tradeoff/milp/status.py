"""Outcomes of a trade-off."""

from __future__ import annotations

from enum import Enum


class DecisionStatus(str, Enum):
    """Status of a decision; any other solver status is an error.

    Optimal and infeasible are proven. Best found is a feasible choice whose optimality is not proven; its gap bounds
    the possible improvement. Undecided: a limit ended the search before it found a choice or proved infeasibility.
    """

    OPTIMAL = "optimal"
    BEST_FOUND = "best found"
    INFEASIBLE = "infeasible"
    UNDECIDED = "undecided"
