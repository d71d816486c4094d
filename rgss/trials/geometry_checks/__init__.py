"""Checks of a task and of draws by geometry alone: grips, releases, and positions of an object."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.trials.geometry_checks.check_steps import CheckStepProblem, check_step_problems
    from rgss.trials.geometry_checks.drawn_objects import draw_problems
    from rgss.trials.geometry_checks.hand_steps import HandStepProblem, hand_step_problems
    from rgss.trials.geometry_checks.lifted_weight import HeldLoad, held_loads
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
