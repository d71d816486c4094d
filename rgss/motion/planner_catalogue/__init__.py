"""Planners of OMPL with their parameters, which of them are supported, and the settings of one."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.motion.planner_catalogue.available import (
        ROADMAP_PLANNERS,
        SOURCE_PLANNERS,
        available_planners,
        refusal_of,
        takes_objective,
    )
    from rgss.motion.planner_catalogue.settings import Objective, OnUnverified, PlannerSettings
    from rgss.motion.planner_catalogue.table import OmplPlanner, ParameterType, PlannerParameter, ompl_planners
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
