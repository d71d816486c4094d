"""Conflicting requirements, their repair, and how both vary with noise."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.tradeoff.infeasibility.conflicts import (
        Conflicts,
        ConflictSurvival,
        JointRepair,
        LimitChange,
        NearestAlternative,
        Repair,
        RequirementCount,
        excluded_counts,
        find_conflicts,
    )
    from rgss.tradeoff.infeasibility.noise import RESAMPLES, conflict_survival, resampled_tables
    from rgss.tradeoff.infeasibility.repair import unmeasured_requirements, winner_among, with_repairs
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
