"""How a trade-off can end."""

from __future__ import annotations

from enum import Enum


class DecisionStatus(str, Enum):
    """The two outcomes of a trade-off; whatever else a solver may say is an error, not a decision."""

    OPTIMAL = "optimal"
    INFEASIBLE = "infeasible"
