"""One trial on both engines: the same plan, the same timed motions, the same task program."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from rgss.evidence import Failure, Phase, PhaseOutcome
from rgss.scenes import Scene
from rgss.studies.expansion import trial_specs
from rgss.studies.project import Project
from rgss.trials.phase_result import PhaseResult
from rgss.trials.pieces.input_digests import TrialSpec
from rgss.trials.pieces.run import execute
from rgss.trials.plan import TaskPlan, plan_task
from rgss.trials.program import run_program
from rgss.trials.record import assemble_record
from rgss.trials.reference import Reference, reference_of
from rgss.trials.timing import TaskTiming, time_task
from rgss.trials.workcell import Workcell

from .plant import MujocoPlant

STEP_S = 5.0e-4


@dataclass(frozen=True, slots=True, kw_only=True)
class Outcome:
    """How a trial ended on one engine.

    Attributes:
        failure: What went wrong; None if the task was done.
        failed_phase: Where.
        durations_s: Length of each phase that was completed.
        slip_m: Greatest displacement of the cup in the hand while it was carried.
        place_error_m: Distance of the cup from the place at the end.
        torque_ratio: Greatest share of its rated torque that a joint gave.
        tightenings: How often the fingers were commanded to close further.
    """

    failure: Failure | None
    failed_phase: Phase | None
    durations_s: Mapping[Phase, float]
    slip_m: float
    place_error_m: float | None
    torque_ratio: float
    tightenings: int

    @property
    def success(self) -> bool:
        """Whether all eight states were completed."""
        return self.failure is None and len(self.durations_s) == len(Phase)


class Comparison:
    """Trials of a project on both engines; what several tests look at is made once."""

    def __init__(self, project: Project) -> None:
        """Begin with nothing.

        Args:
            project: The project whose variants are tried.
        """
        self._project = project
        self._variants = {variant.id: variant for variant in project.designs.expand()}
        self._plans: dict[str, tuple[Workcell, TaskPlan]] = {}
        self._outcomes: dict[tuple[int, float | None, bool], tuple[Outcome, Outcome]] = {}

    def both(self, variant: int, *, mass_kg: float | None = None, breakable: bool = True) -> tuple[Outcome, Outcome]:
        """A variant's trial with the study's seed on the first and on the second engine.

        Args:
            variant: The variant.
            mass_kg: Mass of the cup; the scene's by default.
            breakable: Whether force damages the cup.
        """
        key = (variant, mass_kg, breakable)
        if key not in self._outcomes:
            spec, cell, plan, timing = self._timed(variant)
            spec = replace(spec, scene=_with_cup(spec.scene, mass_kg, breakable=breakable))
            self._outcomes[key] = (_on_first(spec, cell, plan, timing), _on_second(spec, cell, timing, STEP_S))
        return self._outcomes[key]

    def on_second(self, variant: int, step_s: float) -> Outcome:
        """A variant's trial on the second engine with another step."""
        spec, cell, _, timing = self._timed(variant)
        return _on_second(spec, cell, timing, step_s)

    def _timed(self, variant: int) -> tuple[TrialSpec, Workcell, TaskPlan, TaskTiming]:
        (spec,) = trial_specs(self._project, variants=[self._variants[variant]], seeds=[self._project.study.seed])
        planning = spec.settings.planning
        # All that the plan depends on and that differs between the variants compared here.
        key = f"{spec.gripper.geometry.id} {spec.planner}"
        if key not in self._plans:
            cell = Workcell(spec.scene, spec.gripper.geometry, clearance_m=planning.clearance_m)
            self._plans[key] = cell, plan_task(cell, spec.planner, seed=spec.seed, settings=planning)
        cell, plan = self._plans[key]
        return spec, cell, plan, time_task(cell, plan, tool_speed_m_s=spec.tool_speed_m_s, settings=planning)


def _with_cup(scene: Scene, mass_kg: float | None, *, breakable: bool) -> Scene:
    cup = scene.workpiece
    limit_n = cup.force_limit_n if breakable else float("inf")
    return replace(scene, workpiece=replace(cup, mass_kg=mass_kg or cup.mass_kg, force_limit_n=limit_n))


def _on_first(spec: TrialSpec, cell: Workcell, plan: TaskPlan, timing: TaskTiming) -> Outcome:
    record = assemble_record(spec, plan, timing.failures, execute(spec, cell, timing))
    completed = {phase.phase: phase for phase in record.phases if phase.outcome is PhaseOutcome.COMPLETED}
    return Outcome(
        failure=record.failure,
        failed_phase=record.failed_phase,
        durations_s={phase: entry.duration_s for phase, entry in completed.items()},
        slip_m=record.metrics["slip_m"] or 0.0,
        place_error_m=record.metrics["place_error_m"],
        torque_ratio=record.metrics["peak_joint_torque_ratio"],
        tightenings=sum(phase.metrics.get("tightenings", 0) for phase in record.phases),
    )


def _on_second(spec: TrialSpec, cell: Workcell, timing: TaskTiming, step_s: float) -> Outcome:
    gravity = spec.scene.gravity_m_s2
    references: dict[Phase, Reference] = {
        phase: reference_of(trajectory, cell.arm, step_s=step_s, gravity_m_s2=gravity)
        for phase, trajectory in timing.trajectories.items()
    }
    plant = MujocoPlant(spec.scene, spec.gripper, spec.settings.control, step_s=step_s)
    results: Sequence[PhaseResult] = run_program(plant, references)
    last = results[-1]
    return Outcome(
        failure=last.failure,
        failed_phase=None if last.failure is None else last.phase,
        durations_s={result.phase: result.duration_s for result in results if result.failure is None},
        slip_m=plant.slip_m,
        place_error_m=plant.place_error_m,
        torque_ratio=plant.torque_ratio,
        tightenings=plant.tightenings,
    )
