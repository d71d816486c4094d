"""Outcomes of a trade-off."""

from __future__ import annotations

from enum import Enum


class DecisionStatus(str, Enum):
    """Outcome of a trade-off; whatever else a solver may answer is an error, not a decision.

    Optimal and infeasible are proven. Best found is a choice that meets every demand and whose
    optimality is not proven: its gap bounds how much better another one could be. Undecided: a limit ended the
    search before it found a choice, or proved that there is none.
    """

    OPTIMAL = "optimal"
    BEST_FOUND = "best found"
    INFEASIBLE = "infeasible"
    UNDECIDED = "undecided"
