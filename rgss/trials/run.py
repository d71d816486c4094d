"""Running trials: alone, or together with others that share pieces."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from rgss.errors import DefinitionError
from rgss.evidence import Fidelity, Phase, TrialRecord
from rgss.physics import World
from rgss.trials.execution import Execution
from rgss.trials.phase_result import PhaseResult
from rgss.trials.plan import TaskPlan, plan_task
from rgss.trials.record import assemble_record
from rgss.trials.reference import reference_of
from rgss.trials.spec import TrialDigests, TrialSpec, digests_of
from rgss.trials.timing import TaskTiming, time_task
from rgss.trials.versions import versions
from rgss.trials.workcell import Workcell


def run_trial(spec: TrialSpec) -> TrialRecord:
    """Run one trial by itself, its search no longer than its own limit needs.

    Args:
        spec: The trial.

    Raises:
        DefinitionError: The fidelity is not available.
        SimulationError: The physics engine cannot build the world.
    """
    return Pieces().record(spec)


class Pieces:
    """Plans, timings and executions made so far, so that each is made once.

    A record does not depend on what was made before: a piece depends on exactly the inputs
    that its digest covers.
    """

    def __init__(self) -> None:
        """Begin with no pieces."""
        self._versions = versions()
        self._cells: dict[str, Workcell] = {}
        self._plans: dict[str, TaskPlan] = {}
        self._timings: dict[str, TaskTiming] = {}
        self._executions: dict[str, tuple[PhaseResult, ...]] = {}

    @property
    def made(self) -> dict[str, int]:
        """How many pieces of each kind were made."""
        return {"plan": len(self._plans), "timing": len(self._timings), "execution": len(self._executions)}

    def record(self, spec: TrialSpec) -> TrialRecord:
        """The record of a trial, making what pieces are missing.

        Raises:
            DefinitionError: The fidelity is not available, or the limit is longer than the search.
            SimulationError: The physics engine cannot build the world.
        """
        if spec.fidelity is not Fidelity.CONTACT:
            raise DefinitionError(f"fidelity {spec.fidelity.value!r} is not available", hint="use 'contact'")
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
        return assemble_record(spec, plan, timing.failures, execution)

    def _plan(self, spec: TrialSpec, digests: TrialDigests) -> tuple[Workcell, TaskPlan]:
        planning = spec.settings.planning
        if digests.plan not in self._plans:
            cell = Workcell(spec.scene, spec.gripper.geometry, clearance_m=planning.clearance_m)
            self._cells[digests.plan] = cell
            self._plans[digests.plan] = plan_task(cell, spec.planner, seed=spec.seed, settings=planning)
        return self._cells[digests.plan], self._plans[digests.plan]

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
            self._executions[digests.execution] = execute(spec, cell, timing)
        return self._executions[digests.execution]


def execute(spec: TrialSpec, cell: Workcell, timing: TaskTiming) -> tuple[PhaseResult, ...]:
    """Run the timed moves in a fresh world.

    Args:
        spec: The trial.
        cell: Kinematics of the tool.
        timing: The trajectories.

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
    with World(scene, spec.gripper, physics) as world:
        return Execution(world, references, spec.settings.control).run()


def run_shared(specs: Iterable[TrialSpec]) -> Iterator[tuple[TrialSpec, TrialDigests, TrialRecord]]:
    """Run trials one after another, each piece once; yields them as they end."""
    pieces = Pieces()
    for spec in specs:
        yield spec, digests_of(spec, versions()), pieces.record(spec)
