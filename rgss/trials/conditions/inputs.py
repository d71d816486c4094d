"""Inputs of the conditions of a trial, which its planner, limits and settings are not."""

from __future__ import annotations

from dataclasses import dataclass

from rgss.scenes import Gripper, Scene
from rgss.scenes.uncertainty import Uncertainty, Workload
from rgss.trials.trial_spec import TrialSpec


@dataclass(frozen=True, slots=True, kw_only=True)
class ConditionInputs:
    """Inputs of the conditions of a trial.

    Attributes:
        seed: The trial's seed.
        tool_speed_m_s: Greatest tool speed.
        scene: The scene of the files.
        gripper: The gripper of the design.
        uncertainty: The uncertain quantities.
        workload: The cases of objects.
    """

    seed: int
    tool_speed_m_s: float
    scene: Scene
    gripper: Gripper
    uncertainty: Uncertainty
    workload: Workload

    def __hash__(self) -> int:
        """Hash of its numbers: a scene takes longer to hash than to compare with itself."""
        return hash((self.seed, self.tool_speed_m_s))


def condition_inputs(spec: TrialSpec) -> ConditionInputs:
    """Inputs of the conditions of a trial."""
    return ConditionInputs(
        seed=spec.seed,
        tool_speed_m_s=spec.tool_speed_m_s,
        scene=spec.scene,
        gripper=spec.gripper,
        uncertainty=spec.uncertainty,
        workload=spec.workload,
    )
