"""Computation of one piece of a trial from its inputs and earlier pieces: the task of a worker.

A task contains its inputs by value and a piece is text, so that it can be computed in any process on any machine. The
functions ``make_plan``, ``make_timing``, ``make_execution``, ``make_bench`` and ``record_of`` are the entry points of
the code digests: `rgss.trials.code.piece_versions` follows the code that each of them uses.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import lru_cache
from types import MappingProxyType

from rgss.errors import EvidenceError
from rgss.evidence import Piece, PieceKind, TrialRecord
from rgss.trials.executing import execution_of
from rgss.trials.monitors import StepObserver
from rgss.trials.payload_bench import BenchSpec, PayloadResult, bench_of, run_bench
from rgss.trials.pieces.bench_json import bench_from_json, bench_to_json
from rgss.trials.pieces.execution_json import execution_from_json, execution_to_json
from rgss.trials.pieces.input_digests import TrialDigests
from rgss.trials.pieces.plan_json import plan_from_json, plan_to_json
from rgss.trials.pieces.timing_json import timing_from_json, timing_to_json
from rgss.trials.planning import plan_of
from rgss.trials.record import assemble_record
from rgss.trials.timing import timing_of
from rgss.trials.trial_spec import TrialSpec

_READ_KEPT = 16


@dataclass(frozen=True, slots=True, kw_only=True)
class PieceTask:
    """Task to compute a piece.

    Attributes:
        digest: Digest of the piece.
        kind: Kind of the piece.
        spec: One of the trials that share the piece; the others have the same inputs of the piece.
        needs: Digests of the pieces on which it depends.
    """

    digest: str
    kind: PieceKind
    spec: TrialSpec
    needs: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class TrialTask:
    """Task to run a whole trial without shared pieces."""

    digest: str
    spec: TrialSpec

    @property
    def needs(self) -> tuple[str, ...]:
        """Empty: a whole trial depends on no other piece."""
        return ()


Task = PieceTask | TrialTask
"""Task of a worker."""


def tasks_of(spec: TrialSpec, digests: TrialDigests) -> tuple[PieceTask, ...]:
    """Piece tasks of a trial in topological order."""
    tasks = [
        PieceTask(digest=digests.plan, kind=PieceKind.PLAN, spec=spec),
        PieceTask(digest=digests.timing, kind=PieceKind.TIMING, spec=spec, needs=(digests.plan,)),
        PieceTask(digest=digests.execution, kind=PieceKind.EXECUTION, spec=spec, needs=(digests.timing,)),
    ]
    if digests.bench:
        tasks.append(PieceTask(digest=digests.bench, kind=PieceKind.BENCH, spec=spec))
    return tuple(tasks)


def make_plan(spec: TrialSpec) -> str:
    """Compute the plan of a trial, as text.

    Raises:
        MotionError: The planner is not available.
    """
    return plan_to_json(plan_of(spec))


def make_timing(spec: TrialSpec, plan: str) -> str:
    """Compute the timing of a trial, as text.

    Raises:
        EvidenceError: The plan is damaged.
    """
    return timing_to_json(timing_of(spec, plan_from_json(plan)))


def make_execution(
    spec: TrialSpec,
    timing: str,
    *,
    observer: StepObserver | None = None,
    checkpoint: Callable[[], None] | None = None,
) -> str:
    """Compute the execution of a trial, as text.

    Args:
        spec: The trial.
        timing: The text of its timing.
        observer: Callback after every physics step.
        checkpoint: Callback between two steps; it may block, or end the execution by raising.

    Raises:
        EvidenceError: The timing is damaged.
        SimulationError: The physics engine cannot build the world.
    """
    return execution_to_json(execution_of(spec, timing_from_json(timing), observer=observer, checkpoint=checkpoint))


def make_bench(spec: TrialSpec, *, bench: Callable[[BenchSpec], PayloadResult] = run_bench) -> str:
    """Compute the payload bench of a trial's gripper, as text.

    Args:
        spec: The trial.
        bench: Function that runs the bench.

    Raises:
        EvidenceError: The trial's fidelity has no bench.
        SimulationError: The physics engine cannot build the rig.
    """
    asked = bench_of(spec)
    if asked is None:
        raise EvidenceError(f"a {spec.fidelity.value} trial has no payload bench")
    return bench_to_json(bench(asked))


MAKERS: Mapping[PieceKind, Callable[..., str]] = MappingProxyType(
    {
        PieceKind.PLAN: make_plan,
        PieceKind.TIMING: make_timing,
        PieceKind.EXECUTION: make_execution,
        PieceKind.BENCH: make_bench,
    }
)
"""Function of each kind of piece, from the trial and the texts of the pieces on which it depends."""


def make_piece(
    task: PieceTask, needed: Mapping[str, Piece], *, makers: Mapping[PieceKind, Callable[..., str]] = MAKERS
) -> Piece:
    """Compute a piece.

    Args:
        task: The task.
        needed: The pieces on which it depends, by digest.
        makers: Function of each kind of piece.

    Raises:
        EvidenceError: A piece on which it depends is damaged.
        MotionError: The planner is not available.
        SimulationError: The physics engine cannot build the world.
    """
    text = makers[task.kind](task.spec, *(needed[digest].text for digest in task.needs))
    return Piece(digest=task.digest, kind=task.kind, text=text)


def record_of(spec: TrialSpec, pieces: Mapping[PieceKind, Piece]) -> TrialRecord:
    """Assemble the record of a trial from its pieces.

    Raises:
        EvidenceError: A piece is damaged.
    """
    bench = pieces.get(PieceKind.BENCH)
    return assemble_record(
        spec,
        _plan(pieces[PieceKind.PLAN].text),
        _timing(pieces[PieceKind.TIMING].text).failures,
        _execution(pieces[PieceKind.EXECUTION].text),
        bench_payload_kg=None if bench is None else _bench(bench.text).payload_kg,
    )


# Records of trials that share a piece are assembled one after another; the cache avoids parsing it for each.
_plan = lru_cache(maxsize=_READ_KEPT)(plan_from_json)
_timing = lru_cache(maxsize=_READ_KEPT)(timing_from_json)
_execution = lru_cache(maxsize=_READ_KEPT)(execution_from_json)
_bench = lru_cache(maxsize=_READ_KEPT)(bench_from_json)
