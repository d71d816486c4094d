"""One trial on both engines: the same plan, the same timed motions, the same program and monitors."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

from rgss.evidence import Failure, PhaseOutcome
from rgss.physics import PhysicsSettings
from rgss.scenes import Scene
from rgss.studies.expansion import trial_specs
from rgss.studies.project import Project
from rgss.tasks import default_task
from rgss.trials.executing import execute
from rgss.trials.planning import TaskPlan, plan_task
from rgss.trials.record import assemble_record
from rgss.trials.second_engine import mujoco_settings
from rgss.trials.timing import TaskTiming, time_task
from rgss.trials.trial_spec import TrialSpec
from rgss.trials.workcell import Workcell
from tests.fixtures.eight_states import Phase


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
            first, second = (_run(with_physics(spec, one), cell, plan, timing) for one in (None, mujoco_settings()))
            self._outcomes[key] = (first, second)
        return self._outcomes[key]

    def shifted(self, variant: int, shift_m: tuple[float, float], *, mass_kg: float, friction: float) -> list[Outcome]:
        """A variant's trial on both engines with a cup that stands elsewhere than the plan takes it to stand.

        Args:
            variant: The variant.
            shift_m: How far the cup is off, along x and y of the world.
            mass_kg: Its mass.
            friction: Its coefficient.
        """
        spec, cell, plan, timing = self._timed(variant)
        cup = spec.scene.workpiece
        x, y, z = cup.pose.position_m
        pose = replace(cup.pose, position_m=(x + shift_m[0], y + shift_m[1], z))
        scene = replace(spec.scene, workpiece=replace(cup, mass_kg=mass_kg, friction=friction, pose=pose))
        spec = replace(spec, scene=scene)
        return [_run(with_physics(spec, one), cell, plan, timing) for one in (None, mujoco_settings())]

    def on_second(self, variant: int, rate_hz: float) -> Outcome:
        """A variant's trial on the second engine at another rate."""
        spec, cell, plan, timing = self._timed(variant)
        return _run(with_physics(spec, mujoco_settings(rate_hz=rate_hz)), cell, plan, timing)

    def _timed(self, variant: int) -> tuple[TrialSpec, Workcell, TaskPlan, TaskTiming]:
        (spec,) = trial_specs(self._project, variants=[self._variants[variant]], seeds=[self._project.study.seed])
        planning = spec.settings.planning
        # All that the plan depends on and that differs between the variants compared here.
        key = f"{spec.gripper.geometry.id} {spec.planner}"
        if key not in self._plans:
            cell = Workcell(spec.scene, spec.gripper.geometry, clearance_m=planning.clearance_m, task=default_task())
            self._plans[key] = cell, plan_task(cell, spec.planner, seed=spec.seed, settings=planning)
        cell, plan = self._plans[key]
        return spec, cell, plan, time_task(cell, plan, tool_speed_m_s=spec.tool_speed_m_s, settings=planning)


def with_physics(spec: TrialSpec, physics: PhysicsSettings | None) -> TrialSpec:
    """The trial under other physics settings; as it is if none are given."""
    return spec if physics is None else replace(spec, settings=replace(spec.settings, physics=physics))


def _with_cup(scene: Scene, mass_kg: float | None, *, breakable: bool) -> Scene:
    cup = scene.workpiece
    limit_n = cup.force_limit_n if breakable else float("inf")
    return replace(scene, workpiece=replace(cup, mass_kg=mass_kg or cup.mass_kg, force_limit_n=limit_n))


def _run(spec: TrialSpec, cell: Workcell, plan: TaskPlan, timing: TaskTiming) -> Outcome:
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
