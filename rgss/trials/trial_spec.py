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
    """Specification of a trial: one variant under one seed.

    Attributes:
        variant: Id of the design variant.
        seed: The trial's seed.
        fidelity: Its fidelity.
        scene: The scene of the files.
        gripper: The gripper of the design.
        planner: Name of the planner of the design, in the study or in OMPL.
        planning_limit_s: Longest planning time for one move.
        tool_speed_m_s: Greatest tool speed.
        settings: Settings of planning and simulation.
        task: The steps.
        planner_settings: The planner with its parameters; the one of OMPL with that name if None.
        uncertainty: The uncertain quantities, drawn by the seed.
        workload: The cases of objects, chosen by the seed.
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

    def __hash__(self) -> int:
        """Hash of its numbers: a scene takes longer to hash than to compare with itself, and specs share theirs."""
        return hash((self.variant, self.seed, self.planner, self.planning_limit_s, self.tool_speed_m_s))

    @property
    def searched(self) -> frozenset[str]:
        """Names of the moves that a planner searches."""
        kinds = self.settings.planning.kinds(self.task.planned)
        return frozenset(name for name, kind in kinds.items() if kind is MoveKind.PLANNED)

    @property
    def planned_by(self) -> PlannerSettings:
        """The planner with its parameters."""
        return self.planner_settings or PlannerSettings(algorithm=self.planner)
