"""Running trials in this process: alone, or together with others that share pieces."""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache

from rgss.errors import DefinitionError
from rgss.evidence import TrialRecord
from rgss.trials.code import versions
from rgss.trials.executing import execute, execution_of
from rgss.trials.monitors import StepObserver
from rgss.trials.payload_bench import BenchSpec, PayloadResult, bench_of, run_bench
from rgss.trials.phase_result import PhaseResult
from rgss.trials.pieces.input_digests import TrialDigests, digests_of
from rgss.trials.planning import TaskPlan, plan_of
from rgss.trials.record import assemble_record
from rgss.trials.timing import TaskTiming, timing_of
from rgss.trials.trial_spec import TrialSpec

__all__ = ["Pieces", "execute", "require_search", "run_trial"]

_BENCHES_KEPT = 64


def run_trial(spec: TrialSpec, *, observer: StepObserver | None = None) -> TrialRecord:
    """Run one trial by itself; only the bench of its gripper may be known from an earlier one.

    Args:
        spec: The trial.
        observer: Looks on after every physics step.

    Raises:
        DefinitionError: The limit is longer than the search.
        SimulationError: The physics engine cannot build the world.
    """
    return Pieces(observer=observer, bench=_remembered_bench).record(spec)


def require_search(spec: TrialSpec) -> None:
    """Check that a trial's planning limit can be read off its search.

    Args:
        spec: The trial.

    Raises:
        DefinitionError: The limit is longer than the search.
    """
    if spec.planning_limit_s > spec.settings.planning.search_limit_s:
        raise DefinitionError(
            f"the planning limit of {spec.planning_limit_s:g} s exceeds the search of "
            f"{spec.settings.planning.search_limit_s:g} s",
            hint="let the search be as long as the greatest limit",
        )


class Pieces:
    """Plans, timings, executions and benches made so far, so that each is made once.

    A record does not depend on what was made before: a piece depends on exactly the inputs
    that its digest covers.
    """

    def __init__(
        self,
        *,
        observer: StepObserver | None = None,
        checkpoint: Callable[[], None] | None = None,
        bench: Callable[[BenchSpec], PayloadResult] = run_bench,
    ) -> None:
        """Start without pieces.

        Args:
            observer: Looks on after every physics step of the executions that are made.
            checkpoint: Called between two steps of them; it may wait, or end one by raising.
            bench: What tries a gripper on the payload bench.
        """
        self._observer = observer
        self._checkpoint = checkpoint
        self._bench = bench
        self._versions = versions()
        self._plans: dict[str, TaskPlan] = {}
        self._timings: dict[str, TaskTiming] = {}
        self._executions: dict[str, tuple[PhaseResult, ...]] = {}
        self._benches: dict[str, PayloadResult] = {}

    @property
    def made(self) -> dict[str, int]:
        """Number of pieces of each kind that were made."""
        return {
            "plan": len(self._plans),
            "timing": len(self._timings),
            "execution": len(self._executions),
            "bench": len(self._benches),
        }

    def prepare(self, spec: TrialSpec) -> None:
        """Make the plan and the timing of a trial, so that its record only waits for the execution."""
        digests = digests_of(spec, self._versions)
        self._timing(spec, digests, self._plan(spec, digests))

    def record(self, spec: TrialSpec) -> TrialRecord:
        """The record of a trial, making what pieces are missing.

        Raises:
            DefinitionError: The limit is longer than the search.
            SimulationError: The physics engine cannot build the world.
        """
        require_search(spec)
        digests = digests_of(spec, self._versions)
        plan = self._plan(spec, digests)
        timing = self._timing(spec, digests, plan)
        execution = self._execution(spec, digests, timing)
        return assemble_record(spec, plan, timing.failures, execution, bench_payload_kg=self._payload_kg(spec, digests))

    def _plan(self, spec: TrialSpec, digests: TrialDigests) -> TaskPlan:
        if digests.plan not in self._plans:
            self._plans[digests.plan] = plan_of(spec)
        return self._plans[digests.plan]

    def _timing(self, spec: TrialSpec, digests: TrialDigests, plan: TaskPlan) -> TaskTiming:
        if digests.timing not in self._timings:
            self._timings[digests.timing] = timing_of(spec, plan)
        return self._timings[digests.timing]

    def _execution(self, spec: TrialSpec, digests: TrialDigests, timing: TaskTiming) -> tuple[PhaseResult, ...]:
        if digests.execution not in self._executions:
            self._executions[digests.execution] = execution_of(
                spec, timing, observer=self._observer, checkpoint=self._checkpoint
            )
        return self._executions[digests.execution]

    def _payload_kg(self, spec: TrialSpec, digests: TrialDigests) -> float | None:
        """Payload of the gripper on the bench; None where the trial's fidelity has none."""
        bench = bench_of(spec)
        if bench is None:
            return None
        if digests.bench not in self._benches:
            self._benches[digests.bench] = self._bench(bench)
        return self._benches[digests.bench].payload_kg


@lru_cache(maxsize=_BENCHES_KEPT)
def _remembered_bench(bench: BenchSpec) -> PayloadResult:
    return run_bench(bench)
