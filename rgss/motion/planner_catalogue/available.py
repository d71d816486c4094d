"""Supported planners of OMPL."""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache
from types import MappingProxyType

from rgss.motion.planner_catalogue.table import OmplPlanner, ompl_planners

SOURCE_PLANNERS = ("RRT", "TRRT", "STRIDE")
"""The planners of the source's design space (Table 4.3)."""

ROADMAP_PLANNERS = frozenset({"PRM", "PRMstar"})
"""Planners whose roadmap is grown milestone by milestone here, because OMPL's driver depends on a wall clock."""

_COST_PLANNERS = frozenset({"TRRT", "FMT", "BFMT"})
_TO_THE_LIMIT = "it always runs to its limit, so that the result under a shorter limit is unknown"

_REFUSED: Mapping[str, str] = MappingProxyType(
    {
        "LBTRRT": _TO_THE_LIMIT,
        "LazyLBTRRT": _TO_THE_LIMIT,
        "SST": _TO_THE_LIMIT,
        "SPARS": "it looks for a solution in a second thread, by a wall clock",
        "SPARStwo": "it looks for a solution in a second thread, by a wall clock",
        "STRRTstar": "it needs a state space with time",
    }
)


@lru_cache(maxsize=1)
def available_planners() -> Mapping[str, OmplPlanner]:
    """Names of the supported planners: those of the wheel that `refusal_of` does not exclude."""
    known = {name: planner for name, planner in ompl_planners().items() if name not in _REFUSED}
    return MappingProxyType(known)


def refusal_of(name: str) -> str:
    """Reason why a planner of OMPL is not supported; empty if it is supported or unknown.

    Args:
        name: A planner's class in ``ompl.geometric``.
    """
    return _REFUSED.get(name, "")


def takes_objective(name: str) -> bool:
    """True if a planner depends on an optimisation objective.

    Args:
        name: One of `available_planners`.
    """
    return available_planners()[name].optimizing or name in _COST_PLANNERS
