"""Choice of a trial's grasp among the candidates, and its entry in the record."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.trials.grasp_choice.chosen_grasp import with_chosen_grasp
    from rgss.trials.grasp_choice.grasp_search import GraspSearch, NoGrasp, search_grasps
    from rgss.trials.grasp_choice.stated_suction import with_stated_suction
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
