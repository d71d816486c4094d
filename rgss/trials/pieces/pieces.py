"""Making one piece of a trial from its inputs and the pieces before it: the task of a worker.

A task carries its inputs by value and a piece is text, so that it can be made in any process on
any machine. The functions ``make_plan``, ``make_timing``, ``make_execution``, ``make_bench`` and
``record_of`` are where the code of each piece begins, which its digest covers: `rgss.trials.code.piece_versions`
follows what each of them uses.
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
    """A piece to be made.

    Attributes:
        digest: What it will be known by.
        kind: What it is.
        spec: One of the trials that it is for; the others have the same inputs as far as it sees them.
        needs: Digests of the pieces that it is made from.
    """

    digest: str
    kind: PieceKind
    spec: TrialSpec
    needs: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class TrialTask:
    """A whole trial to be run by itself.

    Attributes:
        digest: The trial's key.
        spec: The trial.
    """

    digest: str
    spec: TrialSpec

    @property
    def needs(self) -> tuple[str, ...]:
        """Empty: a whole trial needs no piece of another one."""
        return ()


Task = PieceTask | TrialTask
"""Task of a worker."""


def tasks_of(spec: TrialSpec, digests: TrialDigests) -> tuple[PieceTask, ...]:
    """The pieces of a trial, each after those that it needs.

    Args:
        spec: The trial.
        digests: Its digests.
    """
    tasks = [
        PieceTask(digest=digests.plan, kind=PieceKind.PLAN, spec=spec),
        PieceTask(digest=digests.timing, kind=PieceKind.TIMING, spec=spec, needs=(digests.plan,)),
        PieceTask(digest=digests.execution, kind=PieceKind.EXECUTION, spec=spec, needs=(digests.timing,)),
    ]
    if digests.bench:
        tasks.append(PieceTask(digest=digests.bench, kind=PieceKind.BENCH, spec=spec))
    return tuple(tasks)


def make_plan(spec: TrialSpec) -> str:
    """The plan of a trial, as a piece's text.

    Args:
        spec: The trial.

    Raises:
        MotionError: The planner is not there.
    """
    return plan_to_json(plan_of(spec))


def make_timing(spec: TrialSpec, plan: str) -> str:
    """The timing of a trial, as a piece's text.

    Args:
        spec: The trial.
        plan: The text of its plan.

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
    """The execution of a trial, as a piece's text.

    Args:
        spec: The trial.
        timing: The text of its timing.
        observer: Looks on after every physics step.
        checkpoint: Called between two steps; it may wait, or end the execution by raising.

    Raises:
        EvidenceError: The timing is damaged.
        SimulationError: The physics engine cannot build the world.
    """
    return execution_to_json(execution_of(spec, timing_from_json(timing), observer=observer, checkpoint=checkpoint))


def make_bench(spec: TrialSpec, *, bench: Callable[[BenchSpec], PayloadResult] = run_bench) -> str:
    """The payload bench of a trial's gripper, as a piece's text.

    Args:
        spec: The trial.
        bench: What tries the gripper.

    Raises:
        EvidenceError: The trial's fidelity knows no bench.
        SimulationError: The physics engine cannot build the rig.
    """
    asked = bench_of(spec)
    if asked is None:
        raise EvidenceError(f"a {spec.fidelity.value} trial knows no payload bench")
    return bench_to_json(bench(asked))


MAKERS: Mapping[PieceKind, Callable[..., str]] = MappingProxyType(
    {
        PieceKind.PLAN: make_plan,
        PieceKind.TIMING: make_timing,
        PieceKind.EXECUTION: make_execution,
        PieceKind.BENCH: make_bench,
    }
)
"""What makes each kind of piece, from the trial and the texts of the pieces that it needs."""


def make_piece(
    task: PieceTask, needed: Mapping[str, Piece], *, makers: Mapping[PieceKind, Callable[..., str]] = MAKERS
) -> Piece:
    """Make a piece.

    Args:
        task: The piece to be made.
        needed: The pieces that it needs, by their digests.
        makers: What makes each kind, from the trial and the texts that it needs.

    Raises:
        EvidenceError: A piece that it needs is damaged.
        MotionError: The planner is not there.
        SimulationError: The physics engine cannot build the world.
    """
    text = makers[task.kind](task.spec, *(needed[digest].text for digest in task.needs))
    return Piece(digest=task.digest, kind=task.kind, text=text)


def record_of(spec: TrialSpec, pieces: Mapping[PieceKind, Piece]) -> TrialRecord:
    """Put the record of a trial together from its pieces.

    Args:
        spec: The trial.
        pieces: Its pieces by their kind.

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


# Trials that share a piece are put together one after another, and it need not be read for each.
_plan = lru_cache(maxsize=_READ_KEPT)(plan_from_json)
_timing = lru_cache(maxsize=_READ_KEPT)(timing_from_json)
_execution = lru_cache(maxsize=_READ_KEPT)(execution_from_json)
_bench = lru_cache(maxsize=_READ_KEPT)(bench_from_json)
