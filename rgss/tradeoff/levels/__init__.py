"""Designs as combinations of levels, chosen without listing them."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.tradeoff.levels.problem import LevelProblem, decide_levels
    from rgss.tradeoff.levels.selection import LevelModel, LevelSelection, LevelTable, smallest_table
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
