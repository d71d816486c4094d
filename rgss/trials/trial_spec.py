"""Specification of a trial."""

from __future__ import annotations

from dataclasses import dataclass

from rgss.evidence import Fidelity
from rgss.motion import PlannerSettings
from rgss.scenes import Gripper, Scene
from rgss.scenes.uncertainty import NOTHING_UNCERTAIN, ONE_WORKLOAD, Uncertainty, Workload
from rgss.tasks import MoveKind, TaskProgram
from rgss.trials.settings import TrialSettings


@dataclass(frozen=True, slots=True, kw_only=True)
class TrialSpec:
    """One variant to be tried once.

    Attributes:
        variant: Id of the design variant.
        seed: The trial's seed.
        fidelity: Its fidelity.
        scene: Where it happens, as the files say.
        gripper: The gripper of the design.
        planner: Name of the planner of the design, in the study or in OMPL.
        planning_limit_s: Longest planning time for one move.
        tool_speed_m_s: Greatest tool speed.
        settings: How it is planned and simulated.
        task: The steps.
        planner_settings: The planner with its parameters; the one of OMPL with that name if None.
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
    task: TaskProgram
    planner_settings: PlannerSettings | None = None
    uncertainty: Uncertainty = NOTHING_UNCERTAIN
    workload: Workload = ONE_WORKLOAD

    @property
    def searched(self) -> frozenset[str]:
        """The moves that a planner searches for."""
        kinds = self.settings.planning.kinds(self.task.planned)
        return frozenset(name for name, kind in kinds.items() if kind is MoveKind.PLANNED)

    @property
    def planned_by(self) -> PlannerSettings:
        """The planner with its parameters."""
        return self.planner_settings or PlannerSettings(algorithm=self.planner)
