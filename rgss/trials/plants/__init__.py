"""Plants that a task runs on: kinematic and dynamic."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.trials.plants.control import ControlSettings
    from rgss.trials.plants.dynamic_plant import DynamicPlant
    from rgss.trials.plants.joint_load import JointLoad
    from rgss.trials.plants.kinematic_plant import KinematicPlant
    from rgss.trials.plants.plant import Plant
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)

__all__ = [
    "ControlSettings",
    "DynamicPlant",
    "JointLoad",
    "KinematicPlant",
    "Plant",
]
