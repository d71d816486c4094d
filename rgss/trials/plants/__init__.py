"""Plants: the kinematic and the dynamic plant, and common parts of all plants."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.trials.plants.arm_observations import ArmObservations, tool_metrics
    from rgss.trials.plants.calibrated_law import is_stable
    from rgss.trials.plants.control import ControlSettings
    from rgss.trials.plants.dynamic_plant import DynamicPlant
    from rgss.trials.plants.follower_slip import slip_detail
    from rgss.trials.plants.grip_sequence import GripSequence
    from rgss.trials.plants.joint_controller import (
        ControlMode,
        JointController,
        JointGains,
        least_stable_rate_hz,
        stated_in_step,
    )
    from rgss.trials.plants.kinematic_plant import KinematicPlant
    from rgss.trials.plants.move_targets import MoveTargets
    from rgss.trials.plants.plant import Plant
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
