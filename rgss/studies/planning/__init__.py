"""The ``planning`` section of a study: clock, resolutions, limits, and the planners that it declares."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.studies.planning.declared_planners import planner_problem, read_parameter, require_value
    from rgss.studies.planning.moves_section import read_moves
    from rgss.studies.planning.section import PlanningChoice, PlanningEntry, read_planning, resolution_findings
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
