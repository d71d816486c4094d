"""Conditions of a trial: draws of its seed, true values, and the robot's perception of them."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.trials.conditions.conditions import (
        Conditions,
        conditions_from,
        conditions_of,
        nominal_conditions,
    )
    from rgss.trials.conditions.drawn_value import DrawnValue, drawn_values
    from rgss.trials.conditions.inputs import ConditionInputs, condition_inputs
    from rgss.trials.conditions.object_conditions import ObjectConditions
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
