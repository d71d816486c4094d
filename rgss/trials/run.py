"""Running trials: alone, or together with others that share pieces."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from functools import lru_cache

from rgss.errors import DefinitionError
from rgss.evidence import Fidelity, Phase, TrialRecord
from rgss.physics import TorqueArm, World
from rgss.trials.bench import run_bench
from rgss.trials.bench_spec import BenchSpec, bench_spec
from rgss.trials.dynamic_plant import DynamicPlant
from rgss.trials.execution import Execution
from rgss.trials.kinematic_plant import KinematicPlant
from rgss.trials.observer import StepObserver
from rgss.trials.phase_result import PhaseResult
from rgss.trials.plan import TaskPlan, plan_task
from rgss.trials.program import run_program
from rgss.trials.record import assemble_record
from rgss.trials.reference import reference_of
from rgss.trials.spec import TrialDigests, TrialSpec, digests_of
from rgss.trials.timing import TaskTiming, time_task
from rgss.trials.versions import versions
from rgss.trials.workcell import Workcell, workcell_of


def run_trial(spec: TrialSpec, *, observer: StepObserver | None = None) -> TrialRecord:
    """Run one trial by itself, its search no longer than its own limit needs.

    Args:
        spec: The trial.
        observer: Looks on after every physics step.

    Raises:
        DefinitionError: The limit is longer than the search.
        SimulationError: The physics engine cannot build the world.
    """
    return Pieces(observer=observer).record(spec)


class Pieces:
    """Plans, timings and executions made so far, so that each is made once.

    A record does not depend on what was made before: a piece depends on exactly the inputs
    that its digest covers.
    """

    def __init__(self, *, observer: StepObserver | None = None, checkpoint: Callable[[], None] | None = None) -> None:
        """Begin with no pieces.

        Args:
            observer: Looks on after every physics step of the executions that are made.
            checkpoint: Called between two steps of them; it may wait, or end one by raising.
        """
        self._observer = observer
        self._checkpoint = checkpoint
        self._versions = versions()
        self._plans: dict[str, TaskPlan] = {}
        self._timings: dict[str, TaskTiming] = {}
        self._executions: dict[str, tuple[PhaseResult, ...]] = {}

    @property
    def made(self) -> dict[str, int]:
        """How many pieces of each kind were made."""
        return {"plan": len(self._plans), "timing": len(self._timings), "execution": len(self._executions)}

    def prepare(self, spec: TrialSpec) -> None:
        """Make the plan and the timing of a trial, so that its record only waits for the execution."""
        digests = digests_of(spec, self._versions)
        cell, plan = self._plan(spec, digests)
        self._timing(spec, digests, cell, plan)

    def record(self, spec: TrialSpec) -> TrialRecord:
        """The record of a trial, making what pieces are missing.

        Raises:
            DefinitionError: The limit is longer than the search.
            SimulationError: The physics engine cannot build the world.
        """
        if spec.planning_limit_s > spec.settings.planning.search_limit_s:
            raise DefinitionError(
                f"the planning limit of {spec.planning_limit_s:g} s exceeds the search of "
                f"{spec.settings.planning.search_limit_s:g} s",
                hint="let the search be as long as the greatest limit",
            )
        digests = digests_of(spec, self._versions)
        cell, plan = self._plan(spec, digests)
        timing = self._timing(spec, digests, cell, plan)
        execution = self._execution(spec, digests, cell, timing)
        return assemble_record(spec, plan, timing.failures, execution, bench_payload_kg=_bench_payload_kg(spec))

    def _plan(self, spec: TrialSpec, digests: TrialDigests) -> tuple[Workcell, TaskPlan]:
        planning = spec.settings.planning
        cell = workcell_of(spec.scene, spec.gripper.geometry, planning.clearance_m)
        if digests.plan not in self._plans:
            self._plans[digests.plan] = plan_task(cell, spec.planner, seed=spec.seed, settings=planning)
        return cell, self._plans[digests.plan]

    def _timing(self, spec: TrialSpec, digests: TrialDigests, cell: Workcell, plan: TaskPlan) -> TaskTiming:
        if digests.timing not in self._timings:
            self._timings[digests.timing] = time_task(
                cell, plan, tool_speed_m_s=spec.tool_speed_m_s, settings=spec.settings.planning
            )
        return self._timings[digests.timing]

    def _execution(
        self, spec: TrialSpec, digests: TrialDigests, cell: Workcell, timing: TaskTiming
    ) -> tuple[PhaseResult, ...]:
        if digests.execution not in self._executions:
            self._executions[digests.execution] = execute(
                spec, cell, timing, observer=self._observer, checkpoint=self._checkpoint
            )
        return self._executions[digests.execution]


def execute(
    spec: TrialSpec,
    cell: Workcell,
    timing: TaskTiming,
    *,
    observer: StepObserver | None = None,
    checkpoint: Callable[[], None] | None = None,
) -> tuple[PhaseResult, ...]:
    """Run the timed moves on a fresh plant of the trial's fidelity.

    Args:
        spec: The trial.
        cell: Kinematics of the tool.
        timing: The trajectories.
        observer: Looks on after every step in contact physics; the other fidelities have nothing to show.
        checkpoint: Called between two steps, which in the kinematic model are whole phases; it may wait,
            or end the task by raising.

    Raises:
        SimulationError: The physics engine cannot build the world.
    """
    physics, scene = spec.settings.physics, spec.scene
    references = {}
    for phase in Phase:
        if phase in timing.trajectories:
            references[phase] = reference_of(
                timing.trajectories[phase], cell.arm, step_s=physics.step_s, gravity_m_s2=scene.gravity_m_s2
            )
    control, gripper = spec.settings.control, spec.gripper
    if spec.fidelity is Fidelity.KINEMATIC:
        model = KinematicPlant(cell.arm, gripper, scene.workpiece, control, step_s=physics.step_s)
        return run_program(model, references, checkpoint=checkpoint)
    if spec.fidelity is Fidelity.DYNAMIC:
        with TorqueArm(scene.robot, gripper, physics, gravity_m_s2=scene.gravity_m_s2) as machine:
            plant = DynamicPlant(machine, cell.arm, scene, gripper, physics, control, checkpoint=checkpoint)
            return run_program(plant, references)
    with World(scene, gripper, physics) as world:
        return Execution(world, references, control, observer=observer, checkpoint=checkpoint).run()


def _bench_payload_kg(spec: TrialSpec) -> float | None:
    """What the gripper holds on the payload bench; only contact physics knows."""
    if spec.fidelity is not Fidelity.CONTACT:
        return None
    robot = spec.scene.robot
    bench = bench_spec(
        spec.scene,
        spec.gripper,
        acceleration_m_s2=robot.tool_acceleration_m_s2,
        rated_kg=robot.payload_kg,
        physics=spec.settings.physics,
    )
    return _payload_kg(bench)


@lru_cache(maxsize=64)
def _payload_kg(bench: BenchSpec) -> float:
    """The bench of a gripper, once in a process however many trials have that gripper."""
    return run_bench(bench).payload_kg


def run_shared(specs: Iterable[TrialSpec]) -> Iterator[tuple[TrialSpec, TrialDigests, TrialRecord]]:
    """Run trials one after another, each piece once; yields them as they end."""
    pieces = Pieces()
    for spec in specs:
        yield spec, digests_of(spec, versions()), pieces.record(spec)
