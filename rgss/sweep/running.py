"""Running the trials of a study: every piece once, on several processes, into one evidence store."""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from rgss.engines import require_engines
from rgss.errors import EvidenceError
from rgss.evidence import (
    EvidenceStore,
    Piece,
    PieceKind,
    RunFailure,
    RunFailureKind,
    StoredTrial,
    TrialRecord,
    trial_key,
)
from rgss.evidence.records import Numerics, detail_line, numerics_text, require_alike
from rgss.sweep.answers import checked, record_problem
from rgss.sweep.evidence_writer import Origin, TrialWriter
from rgss.sweep.inline_workers import InlineWorkers
from rgss.sweep.task_queue import TaskQueue, Trial
from rgss.sweep.workers import Ended, TaskError, WorkerPool, Workers
from rgss.trials.code import fixed_numerics, numerics, versions
from rgss.trials.pieces import Task, TrialSpec, TrialTask, digests_of, make, record_of, require_search

Maker = Callable[[Task, Mapping[str, Piece]], Piece | TrialRecord]

MOST_ATTEMPTS = 2
"""How often a task is tried whose worker crashed, hung or ran out of memory."""

_MIB = 1024 * 1024


@dataclass(frozen=True, slots=True, kw_only=True)
class WorkerLimits:
    """What a worker may use for one task.

    Attributes:
        time_s: Greatest time by the wall clock: a hundred times what the longest search needs.
        memory_bytes: Greatest size of a worker's data; 0 for no limit.
    """

    time_s: float = 300.0
    memory_bytes: int = 2048 * _MIB


@dataclass(frozen=True, slots=True, kw_only=True)
class FinishedTrial:
    """A trial that was run or read.

    Attributes:
        key: What the store knows it by.
        record: What came out of it.
        fresh: Whether it was put together now; the store had it otherwise.
    """

    key: str
    record: TrialRecord
    fresh: bool


@dataclass(frozen=True, slots=True, kw_only=True)
class LostTrials:
    """A failure of the run, and the trials that have no record for it.

    Attributes:
        failure: What could not be made, and why.
        trials: Variant and seed of each trial that needed it.
    """

    failure: RunFailure
    trials: tuple[tuple[int, int], ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class SweepState:
    """How far a sweep is.

    Attributes:
        elapsed_s: Time since it began.
        remaining_s: Time that what is left is expected to take; None before anything is known.
        tasks_left: How many pieces (or trials, if nothing is shared) are still to be made.
        made: How many pieces of each kind were made.
        reused: How many pieces of each kind came from the store.
        saved: How many pieces more the trials that are done would have needed without sharing.
    """

    elapsed_s: float
    remaining_s: float | None
    tasks_left: int
    made: Mapping[str, int]
    reused: Mapping[str, int]
    saved: int


@dataclass(frozen=True, slots=True, kw_only=True)
class SweepResult:
    """What a sweep did.

    Attributes:
        made: How many pieces of each kind were made; ``trial`` where nothing was shared.
        reused: How many pieces of each kind came from the store.
        lost: What could not be made; empty if all trials have records.
        elapsed_s: Time from the first task to the last, workers' start included.
        busy_s: Time that the workers spent on tasks, summed over them.
    """

    made: Mapping[str, int]
    reused: Mapping[str, int]
    lost: tuple[LostTrials, ...]
    elapsed_s: float = 0.0
    busy_s: float = 0.0


def key_of(spec: TrialSpec) -> str:
    """What the store knows a trial by: the digest of its inputs, the versions, and its variant."""
    return _trial(spec, versions()).key


def trials_of(specs: Sequence[TrialSpec]) -> tuple[Trial, ...]:
    """The trials with their keys and digests, each once.

    Args:
        specs: The trials.

    Raises:
        DefinitionError: A planning limit is longer than the search.
    """
    found = versions()
    for spec in specs:
        require_search(spec)
    return tuple({trial.key: trial for trial in (_trial(spec, found) for spec in specs)}.values())


def sweep(
    specs: Sequence[TrialSpec],
    store: EvidenceStore,
    *,
    jobs: int,
    on_finished: Callable[[FinishedTrial], None],
    on_state: Callable[[SweepState], None] | None = None,
    share: bool = True,
    limits: WorkerLimits | None = None,
    origin: Callable[[], Origin] = Origin,
    maker: Maker = make,
    workers_for: Callable[[Maker], Workers] | None = None,
) -> SweepResult:
    """Make what the store has not, and keep each result within about a second.

    Records depend neither on the number of processes nor on the order of the work, nor on whether
    pieces are shared. When it is interrupted, what was finished is kept, and the next sweep goes on
    from there. A task whose worker crashes, hangs or runs out of memory is tried once more; then it
    is recorded as a failure of the run, and the sweep goes on without it; so it is with a task whose answer
    is not what was asked for.

    Args:
        specs: The trials.
        store: Where evidence is kept.
        jobs: Number of worker processes; with 0 everything is done in this process, nothing isolated.
        on_finished: Called for every trial that has a record, also for those that the store had.
        on_state: Called whenever something has ended.
        share: Whether pieces are shared between trials and taken from the store.
        limits: What a worker may use for one task.
        origin: Tells where the trials come from, for their provenance; asked only if there are any to run.
        maker: What carries out a task: a function of a module, which the workers import by its name.
        workers_for: Gives the workers that carry out tasks by a maker, in place of `jobs` and `limits`;
            asked only if there is anything to be made.

    Raises:
        DefinitionError: A planning limit is longer than the search, or an engine is not installed.
        EvidenceError: The store cannot be read or written, or had another result for the same inputs.
        StorageError: The disk is full; or the store was removed, replaced or damaged meanwhile, and the
            message says where what could be saved is.
        SimulationError: Worker processes cannot be started, or the workers are lost.
    """
    require_engines("a sweep")
    trials = trials_of(specs)
    there = store.has(trial.key for trial in trials)
    made_with: dict[str, StoredTrial] = {}
    for trial in trials:
        found = store.get(trial.key) if trial.key in there else None
        if found is not None:
            made_with[numerics_text(found.provenance.numerics)] = found
            on_finished(FinishedTrial(key=trial.key, record=found.record, fresh=False))
    missing = [trial for trial in trials if trial.key not in there]
    stored: set[str] = set()
    computed_with = numerics if jobs == 0 and workers_for is None else fixed_numerics
    for known in made_with.values() if missing else ():
        # Pieces of both would be mixed, and their records could be run again nowhere.
        _require_alike(known, computed_with())
    if share and missing:
        stored = store.has_pieces({digest for trial in missing for digest in trial.pieces.values()})
    keeper = TrialWriter(
        store,
        origin,
        on_kept=lambda key, record: on_finished(FinishedTrial(key=key, record=record, fresh=True)),
        numerics=computed_with,
    )
    work = TaskQueue(missing, stored=stored, share=share)
    limits = limits or WorkerLimits()
    workers: Workers = InlineWorkers(maker)
    if workers_for is not None and work.left:
        workers = workers_for(maker)
    elif jobs > 0:
        workers = WorkerPool(maker, size=jobs, time_limit_s=limits.time_s, memory_limit_bytes=limits.memory_bytes)
    return _Sweep(work, store, keeper, workers, on_state=on_state).run()


class _Sweep:
    """One sweep while it runs."""

    def __init__(
        self,
        work: TaskQueue,
        store: EvidenceStore,
        keeper: TrialWriter,
        workers: Workers,
        *,
        on_state: Callable[[SweepState], None] | None,
    ) -> None:
        self._work = work
        self._store = store
        self._keeper = keeper
        self._workers = workers
        self._on_state = on_state
        self._begun = time.monotonic()
        self._held: dict[str, Piece] = {}
        self._running: dict[str, Task] = {}
        self._attempts: Counter[str] = Counter()
        self._made: Counter[str] = Counter()
        self._reused: Counter[str] = Counter()
        self._lost: list[LostTrials] = []
        self._used = 0
        self._busy_s = 0.0

    def run(self) -> SweepResult:
        """Do the work until nothing is left."""
        try:
            self._put_together()
            while self._work.left:
                self._workers.want(self._work.ready + len(self._running))
                self._begin_tasks()
                for ended in self._workers.wait(self._keeper.due_s()):
                    # Others can begin what this one makes ready before it is written down.
                    self._take_in(ended)
                    self._begin_tasks()
                self._put_together()
                self._keeper.flush_if_due()
                self._tell()
        except BaseException:
            self._workers.close()
            self._write_down()
            raise
        elapsed_s = time.monotonic() - self._begun
        self._workers.close()
        self._write_down()
        return SweepResult(
            made=dict(self._made),
            reused=dict(self._reused),
            lost=tuple(self._lost),
            elapsed_s=elapsed_s,
            busy_s=self._busy_s,
        )

    def _write_down(self) -> None:
        """Put what is finished, and make sure that it is in the store; if it is not, that is the error to report."""
        self._keeper.flush()
        self._store.confirm()

    def _begin_tasks(self) -> None:
        while self._workers.free and self._work.ready:
            task = self._work.take()
            needed = {digest: self._piece(digest) for digest in task.needs}
            self._running[task.digest] = task
            self._attempts[task.digest] += 1
            self._workers.begin(task.digest, (task, needed))

    def _take_in(self, ended: Ended) -> None:
        task = self._running.pop(ended.key)
        ended = checked(ended, task)
        if ended.trouble is not None:
            self._handle_failure(task, ended.trouble)
            return
        del self._attempts[task.digest]
        self._busy_s += ended.took_s
        if isinstance(ended.result, Piece):
            self._made[ended.result.kind.value] += 1
            self._held[task.digest] = ended.result
            self._keeper.keep_piece(ended.result)
        else:
            self._made["trial"] += 1
        self._work.done(task.digest, took_s=ended.took_s)
        for digest in task.needs:
            self._release(digest)
        if isinstance(task, TrialTask):
            for trial in self._work.complete():
                self._keeper.keep_trial(trial, ended.result)

    def _put_together(self) -> None:
        """Put the records together whose pieces are all there."""
        for trial in self._work.complete():
            pieces = {kind: self._piece(digest) for kind, digest in trial.pieces.items()}
            record = self._assembled(trial, pieces)
            if record is not None:
                self._keeper.keep_trial(trial, record)
                self._used += len(pieces)
            for digest in trial.pieces.values():
                self._release(digest)
            self._keeper.flush_if_due()

    def _assembled(self, trial: Trial, pieces: Mapping[PieceKind, Piece]) -> TrialRecord | None:
        """The record of a trial; None, and a failure of the run, if its pieces do not fit each other."""
        try:
            record = record_of(trial.spec, pieces)
            problem = record_problem(trial.spec, record)
        # Each piece is one that can be read, but together they may break anything.
        except Exception as error:
            problem = f"{type(error).__name__}: {error}"
        if not problem:
            return record
        self._lose("trial", trial.key, RunFailureKind.WRONG_ANSWER, f"its pieces make no record: {problem}", (trial,))
        return None

    def _handle_failure(self, task: Task, trouble: TaskError) -> None:
        attempts = self._attempts[task.digest]
        if trouble.may_pass and attempts < MOST_ATTEMPTS:
            self._work.give_back(task)
            return
        lost = self._work.give_up(task.digest)
        self._held = {digest: piece for digest, piece in self._held.items() if self._work.is_used(digest)}
        what = "trial" if isinstance(task, TrialTask) else task.kind.value
        self._lose(what, task.digest, trouble.kind, trouble.detail, lost, attempts=attempts)

    def _lose(
        self, what: str, key: str, kind: RunFailureKind, detail: str, trials: Sequence[Trial], *, attempts: int = 1
    ) -> None:
        """Record a failure of the run, and the trials that have no record for it."""
        failure = RunFailure(key=key, what=what, kind=kind, detail=detail_line(detail), attempts=attempts)
        self._store.put_failure(failure)
        lost = tuple((trial.spec.variant, trial.spec.seed) for trial in trials)
        self._lost.append(LostTrials(failure=failure, trials=lost))

    def _piece(self, digest: str) -> Piece:
        """A piece that was made now, or before, and is needed now."""
        if digest not in self._held:
            piece = self._store.piece(digest)
            if piece is None:
                raise EvidenceError(
                    f"piece {digest[:12]} has gone from the store during the sweep", hint="run the sweep again"
                )
            self._held[digest] = piece
            self._reused[piece.kind.value] += 1
        return self._held[digest]

    def _release(self, digest: str) -> None:
        self._work.release(digest)
        if not self._work.is_used(digest):
            self._held.pop(digest, None)

    def _tell(self) -> None:
        if self._on_state is None:
            return
        left_s = self._work.remaining_s() / self._workers.size
        self._on_state(
            SweepState(
                elapsed_s=time.monotonic() - self._begun,
                remaining_s=left_s if self._made else None,
                tasks_left=self._work.left,
                made=dict(self._made),
                reused=dict(self._reused),
                saved=max(0, self._used - sum(self._made.values()) - sum(self._reused.values())),
            )
        )


def _require_alike(stored: StoredTrial, here: Numerics) -> None:
    record = stored.record
    what = f"the stored trial {stored.key[:12]} (variant {record.variant}, seed {record.seed})"
    require_alike(what, stored.provenance.numerics, here)


def _trial(spec: TrialSpec, found: Mapping[str, str]) -> Trial:
    digests = digests_of(spec, found)
    key = trial_key({"trial": digests.trial, "variant": spec.variant})
    return Trial(key=key, spec=spec, digests=digests)
