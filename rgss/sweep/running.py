"""Running the trials of a study: every piece once, on several processes, into one evidence store."""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Callable, Mapping, Sequence

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
)
from rgss.evidence.records import Numerics, detail_line, numerics_text, require_alike
from rgss.sweep.answers import checked, record_problem
from rgss.sweep.evidence_writer import Origin, TrialWriter
from rgss.sweep.inline_workers import InlineWorkers
from rgss.sweep.results import FinishedTrial, LostTrials, SweepResult, SweepState, WorkerLimits
from rgss.sweep.task_end import Ended, TaskError, Workers
from rgss.sweep.task_queue import TaskQueue, Trial
from rgss.sweep.trial_keys import trials_of
from rgss.sweep.workers import WorkerPool
from rgss.trials.code import fixed_numerics, numerics
from rgss.trials.pieces import Task, TrialSpec, TrialTask, make, record_of

Maker = Callable[[Task, Mapping[str, Piece]], Piece | TrialRecord]

MOST_ATTEMPTS = 2
"""Number of attempts at a task whose worker crashed, hung or ran out of memory."""


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
    """Compute missing results, and store each within about a second.

    Records depend neither on the number of processes nor on the order of tasks, nor on sharing of pieces. After an
    interruption finished results are stored, and the next sweep continues from there. A task whose worker crashes,
    hangs or runs out of memory, or whose result does not match the task, is retried once; then it is recorded as a
    failure of the run, and the sweep continues without it.

    Args:
        specs: The trials.
        store: The evidence store.
        jobs: Number of worker processes; 0 for execution in this process, without isolation.
        on_finished: Callback for every trial with a record, including stored ones.
        on_state: Callback after each ended task.
        share: Whether pieces are shared between trials and taken from the store.
        limits: Limits of a worker for one task.
        origin: Callback for the provenance of the trials; called only if there are any to run.
        maker: Module-level function that runs a task, imported by the workers by name.
        workers_for: Factory of the execution backend for a maker, instead of `jobs` and `limits`; called only if there
            are tasks.

    Raises:
        DefinitionError: A planning limit is longer than the search, or an engine is not installed.
        EvidenceError: The store cannot be read or written, or had another result for the same inputs.
        StorageError: The disk is full; or the store was removed, replaced or damaged meanwhile, and the message names
        the file with the rescued rows.
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
    writer = TrialWriter(
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
    return _Sweep(work, store, writer, workers, on_state=on_state).run()


class _Sweep:
    """One sweep while it runs."""

    def __init__(
        self,
        work: TaskQueue,
        store: EvidenceStore,
        writer: TrialWriter,
        workers: Workers,
        *,
        on_state: Callable[[SweepState], None] | None,
    ) -> None:
        self._work = work
        self._store = store
        self._writer = writer
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
                self._workers.prepare_for(self._work.ready + len(self._running))
                self._begin_tasks()
                for ended in self._workers.wait(self._writer.due_s()):
                    # Others can begin what this one makes ready before it is written down.
                    self._take_in(ended)
                    self._begin_tasks()
                self._put_together()
                self._writer.flush_if_due()
                self._report_progress()
        except BaseException:
            self._end()
            raise
        elapsed_s = time.monotonic() - self._begun
        self._end()
        return SweepResult(
            made=dict(self._made),
            reused=dict(self._reused),
            lost=tuple(self._lost),
            elapsed_s=elapsed_s,
            busy_s=self._busy_s,
        )

    def _end(self) -> None:
        """Stop the workers, store finished results and verify that they are in the store.

        A failure of that is the reported error.
        """
        try:
            self._workers.close()
        finally:
            # Also where a second interrupt cuts off the end of the workers.
            self._writer.flush()
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
        if ended.failure is not None:
            self._handle_failure(task, ended.failure)
            return
        del self._attempts[task.digest]
        self._busy_s += ended.took_s
        if isinstance(ended.result, Piece):
            self._made[ended.result.kind.value] += 1
            self._held[task.digest] = ended.result
            self._writer.keep_piece(ended.result)
        else:
            self._made["trial"] += 1
        self._work.done(task.digest, took_s=ended.took_s)
        for digest in task.needs:
            self._release(digest)
        if isinstance(task, TrialTask):
            for trial in self._work.complete():
                self._writer.keep_trial(trial, ended.result)

    def _put_together(self) -> None:
        """Put the records together whose pieces are all there."""
        for trial in self._work.complete():
            pieces = {kind: self._piece(digest) for kind, digest in trial.pieces.items()}
            record = self._assembled(trial, pieces)
            if record is not None:
                self._writer.keep_trial(trial, record)
                self._used += len(pieces)
            for digest in trial.pieces.values():
                self._release(digest)
            self._writer.flush_if_due()

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

    def _handle_failure(self, task: Task, failure: TaskError) -> None:
        attempts = self._attempts[task.digest]
        if failure.may_pass and attempts < MOST_ATTEMPTS:
            self._work.give_back(task)
            return
        lost = self._work.give_up(task.digest)
        self._held = {digest: piece for digest, piece in self._held.items() if self._work.is_used(digest)}
        what = "trial" if isinstance(task, TrialTask) else task.kind.value
        self._lose(what, task.digest, failure.kind, failure.detail, lost, attempts=attempts)

    def _lose(
        self, what: str, key: str, kind: RunFailureKind, detail: str, trials: Sequence[Trial], *, attempts: int = 1
    ) -> None:
        """Record a failure of the run, and the trials that have no record for it."""
        failure = RunFailure(key=key, what=what, kind=kind, detail=detail_line(detail), attempts=attempts)
        # First what is finished: if the store is lost, it is saved with what is being written.
        self._writer.flush()
        self._store.put_failure(failure)
        lost = tuple((trial.spec.variant, trial.spec.seed) for trial in trials)
        self._lost.append(LostTrials(failure=failure, trials=lost))

    def _piece(self, digest: str) -> Piece:
        """A piece that was made now, or before, and is needed now."""
        if digest not in self._held:
            piece = self._store.piece(digest)
            if piece is None:
                raise EvidenceError(
                    f"piece {digest[:12]} was removed from the store during the sweep", hint="run the sweep again"
                )
            self._held[digest] = piece
            self._reused[piece.kind.value] += 1
        return self._held[digest]

    def _release(self, digest: str) -> None:
        self._work.release(digest)
        if not self._work.is_used(digest):
            self._held.pop(digest, None)

    def _report_progress(self) -> None:
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
