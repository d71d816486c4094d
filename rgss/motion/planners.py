"""Planners of OMPL that can be run here."""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache
from types import MappingProxyType

from rgss.motion.planner_table import OmplPlanner, ompl_planners

SOURCE_PLANNERS = ("RRT", "TRRT", "STRIDE")
"""The planners of the source's design space (Table 4.3)."""

ROADMAP_PLANNERS = frozenset({"PRM", "PRMstar"})
"""Planners whose roadmap is grown milestone by milestone, as OMPL's own driver looks for a solution by a wall clock."""

_COST_PLANNERS = frozenset({"TRRT", "FMT", "BFMT"})
_TO_THE_LIMIT = "it goes on to its limit, so that a shorter limit cannot be read off its search"

_REFUSED: Mapping[str, str] = MappingProxyType(
    {
        "LBTRRT": _TO_THE_LIMIT,
        "LazyLBTRRT": _TO_THE_LIMIT,
        "SST": _TO_THE_LIMIT,
        "SPARS": "it looks for a solution in a second thread, by a wall clock",
        "SPARStwo": "it looks for a solution in a second thread, by a wall clock",
        "STRRTstar": "it needs a space of states with time",
    }
)


@lru_cache(maxsize=1)
def available_planners() -> Mapping[str, OmplPlanner]:
    """The planners that can be run here, by name: those of the wheel without those that `refusal_of` names."""
    known = {name: planner for name, planner in ompl_planners().items() if name not in _REFUSED}
    return MappingProxyType(known)


def refusal_of(name: str) -> str:
    """The reason why a planner of OMPL cannot be run here; empty if it can, or is none of OMPL.

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
