"""Making one piece of a trial from its inputs and the pieces before it: the task of a worker.

A task carries its inputs by value and a piece is text, so that it can be made in any process on
any machine.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache

from rgss.errors import EvidenceError
from rgss.evidence import Piece, PieceKind, TrialRecord
from rgss.trials.bench import run_bench
from rgss.trials.bench_text import bench_from_text, bench_to_text
from rgss.trials.executing import execute
from rgss.trials.execution_text import execution_from_text, execution_to_text
from rgss.trials.plan import plan_task
from rgss.trials.plan_text import plan_from_text, plan_to_text
from rgss.trials.record import assemble_record
from rgss.trials.run import Pieces
from rgss.trials.spec import TrialDigests, bench_of
from rgss.trials.timing import time_task
from rgss.trials.timing_text import timing_from_text, timing_to_text
from rgss.trials.trial_spec import TrialSpec
from rgss.trials.workcell import Workcell, workcell_of

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
        """It needs no piece of any other trial."""
        return ()


Task = PieceTask | TrialTask
"""What a worker can be given to make."""


def make(task: Task, needed: Mapping[str, Piece]) -> Piece | TrialRecord:
    """Carry out a task: make a piece, or run a trial by itself.

    Args:
        task: The task.
        needed: The pieces that it needs, by their digests.

    Raises:
        EvidenceError: A piece that it needs is damaged.
        MotionError: The planner is not there.
        SimulationError: The physics engine cannot build the world.
    """
    return Pieces().record(task.spec) if isinstance(task, TrialTask) else make_piece(task, needed)


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


def make_piece(task: PieceTask, needed: Mapping[str, Piece]) -> Piece:
    """Make a piece.

    Args:
        task: The piece to be made.
        needed: The pieces that it needs, by their digests.

    Raises:
        EvidenceError: A piece that it needs is damaged.
        MotionError: The planner is not there.
        SimulationError: The physics engine cannot build the world.
    """
    spec = task.spec
    if task.kind is PieceKind.PLAN:
        plan = plan_task(_cell(spec), spec.planner, seed=spec.seed, settings=spec.settings.planning)
        text = plan_to_text(plan)
    elif task.kind is PieceKind.TIMING:
        plan = plan_from_text(needed[task.needs[0]].text)
        timing = time_task(_cell(spec), plan, tool_speed_m_s=spec.tool_speed_m_s, settings=spec.settings.planning)
        text = timing_to_text(timing)
    elif task.kind is PieceKind.EXECUTION:
        timing = timing_from_text(needed[task.needs[0]].text)
        text = execution_to_text(execute(spec, _cell(spec), timing))
    else:
        bench = bench_of(spec)
        if bench is None:
            raise EvidenceError(f"a {spec.fidelity.value} trial knows no payload bench")
        text = bench_to_text(run_bench(bench))
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
_plan = lru_cache(maxsize=_READ_KEPT)(plan_from_text)
_timing = lru_cache(maxsize=_READ_KEPT)(timing_from_text)
_execution = lru_cache(maxsize=_READ_KEPT)(execution_from_text)
_bench = lru_cache(maxsize=_READ_KEPT)(bench_from_text)


def _cell(spec: TrialSpec) -> Workcell:
    return workcell_of(spec.scene, spec.gripper.geometry, spec.settings.planning.clearance_m)
