"""Registry of the planners: from the name in a design to the class of OMPL."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType


@dataclass(frozen=True, slots=True, kw_only=True)
class Planner:
    """A sampling-based planner of OMPL.

    Attributes:
        name: Name in designs, records and messages.
        ompl_class: Name of the class in ``ompl.geometric``.
        meaning: Name in full.
        settings: Value by setter of the class, such as ``setGoalBias``; its own default for every other parameter.
        typical_search_s: Typical time of a search, for the order of work until times are measured.
    """

    name: str
    ompl_class: str
    meaning: str
    settings: Mapping[str, float] = field(default_factory=dict, hash=False)
    typical_search_s: float = 0.1


PLANNERS: Mapping[str, Planner] = MappingProxyType(
    {
        planner.name: planner
        for planner in (
            Planner(name="RRT", ompl_class="RRT", meaning="rapidly-exploring random tree"),
            Planner(
                name="TRRT",
                ompl_class="TRRT",
                meaning="transition-based rapidly-exploring random tree",
                typical_search_s=0.2,
            ),
            Planner(
                name="STRIDE",
                ompl_class="STRIDE",
                meaning="search tree with resolution-independent density estimation",
                typical_search_s=1.0,
            ),
        )
    }
)
"""The planners by name; a further one is a further entry."""
