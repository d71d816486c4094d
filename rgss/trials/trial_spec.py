"""What a trial is made of."""

from __future__ import annotations

from dataclasses import dataclass

from rgss.evidence import Fidelity
from rgss.scenes import Gripper, Scene
from rgss.scenes.uncertainty import NOTHING_UNCERTAIN, ONE_WORKLOAD, Uncertainty, Workload
from rgss.trials.settings import TrialSettings


@dataclass(frozen=True, slots=True, kw_only=True)
class TrialSpec:
    """One variant to be tried once.

    Attributes:
        variant: Id of the design variant.
        seed: The trial's seed.
        fidelity: How much physics it has.
        scene: Where it happens, as the files say.
        gripper: The gripper of the design.
        planner: Name of the planner of the design.
        planning_limit_s: Longest planning time for one move.
        tool_speed_m_s: Greatest tool speed.
        settings: How it is planned and simulated.
        uncertainty: What differs from the files; the seed draws it.
        workload: The objects that are carried; the seed chooses one.
    """

    variant: int
    seed: int
    fidelity: Fidelity
    scene: Scene
    gripper: Gripper
    planner: str
    planning_limit_s: float
    tool_speed_m_s: float
    settings: TrialSettings
    uncertainty: Uncertainty = NOTHING_UNCERTAIN
    workload: Workload = ONE_WORKLOAD
