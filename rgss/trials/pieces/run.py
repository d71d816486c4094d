"""Execution of trials in this process, piece by piece, with or without shared pieces."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping
from functools import lru_cache, partial

from rgss.errors import DefinitionError
from rgss.evidence import Piece, PieceKind, TrialRecord
from rgss.trials.code import versions
from rgss.trials.monitors import StepObserver
from rgss.trials.payload_bench import BenchSpec, PayloadResult, run_bench
from rgss.trials.pieces.input_digests import digests_of
from rgss.trials.pieces.pieces import (
    MAKERS,
    PieceTask,
    Task,
    TrialTask,
    make_bench,
    make_execution,
    make_piece,
    record_of,
    tasks_of,
)
from rgss.trials.trial_spec import TrialSpec

_BENCHES_KEPT = 64


def run_trial(spec: TrialSpec, *, observer: StepObserver | None = None) -> TrialRecord:
    """Run one trial; only the bench of its gripper is cached across trials.

    Args:
        spec: The trial.
        observer: Callback after every physics step.

    Raises:
        DefinitionError: The limit is longer than the search.
        SimulationError: The physics engine cannot build the world.
    """
    return Pieces(observer=observer, bench=_remembered_bench).record(spec)


def require_search(spec: TrialSpec) -> None:
    """Require that the search of a trial covers its planning limit.

    Raises:
        DefinitionError: The limit is longer than the search.
    """
    if spec.planning_limit_s > spec.settings.planning.search_limit_s:
        raise DefinitionError(
            f"the planning limit of {spec.planning_limit_s:g} s exceeds the search of "
            f"{spec.settings.planning.search_limit_s:g} s",
            hint="set the search limit to at least the greatest planning limit",
        )


class Pieces:
    """In-memory cache of pieces.

    A record does not depend on earlier ones: a piece depends on exactly the inputs that its digest covers.
    """

    def __init__(
        self,
        *,
        observer: StepObserver | None = None,
        checkpoint: Callable[[], None] | None = None,
        bench: Callable[[BenchSpec], PayloadResult] = run_bench,
    ) -> None:
        """Start with an empty cache.

        Args:
            observer: Callback after every physics step of an execution.
            checkpoint: Callback between two steps; it may block, or end an execution by raising.
            bench: Function that runs a payload bench.
        """
        self._makers: dict[PieceKind, Callable[..., str]] = {
            **MAKERS,
            PieceKind.EXECUTION: partial(make_execution, observer=observer, checkpoint=checkpoint),
            PieceKind.BENCH: partial(make_bench, bench=bench),
        }
        self._versions = versions()
        self._made: dict[str, Piece] = {}

    @property
    def made(self) -> dict[str, int]:
        """Number of computed pieces of each kind."""
        kinds = Counter(piece.kind for piece in self._made.values())
        return {kind.value: kinds[kind] for kind in PieceKind}

    def prepare(self, spec: TrialSpec) -> None:
        """Compute the plan and the timing of a trial in advance of its execution."""
        for task in tasks_of(spec, digests_of(spec, self._versions)):
            if task.kind in (PieceKind.PLAN, PieceKind.TIMING):
                self._piece(task)

    def record(self, spec: TrialSpec) -> TrialRecord:
        """Record of a trial; computes missing pieces.

        Raises:
            DefinitionError: The limit is longer than the search.
            SimulationError: The physics engine cannot build the world.
        """
        require_search(spec)
        tasks = tasks_of(spec, digests_of(spec, self._versions))
        return record_of(spec, {task.kind: self._piece(task) for task in tasks})

    def _piece(self, task: PieceTask) -> Piece:
        if task.digest not in self._made:
            self._made[task.digest] = make_piece(task, self._made, makers=self._makers)
        return self._made[task.digest]


def make(task: Task, needed: Mapping[str, Piece]) -> Piece | TrialRecord:
    """Run a task: compute a piece, or run a whole trial.

    Args:
        task: The task.
        needed: The pieces on which it depends, by digest.

    Raises:
        EvidenceError: A piece on which it depends is damaged.
        MotionError: The planner is not available.
        SimulationError: The physics engine cannot build the world.
    """
    return Pieces().record(task.spec) if isinstance(task, TrialTask) else make_piece(task, needed)


@lru_cache(maxsize=_BENCHES_KEPT)
def _remembered_bench(bench: BenchSpec) -> PayloadResult:
    return run_bench(bench)
