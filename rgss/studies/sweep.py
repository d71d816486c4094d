"""Running the trials of a study on several processes, into one evidence store."""

from __future__ import annotations

import multiprocessing
import signal
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from dataclasses import dataclass

from rgss.errors import SimulationError
from rgss.evidence import EvidenceStore, Provenance, TrialRecord, trial_key
from rgss.trials.run import run_shared
from rgss.trials.spec import TrialDigests, TrialSpec, digests_of
from rgss.trials.versions import versions


@dataclass(frozen=True, slots=True, kw_only=True)
class FinishedTrial:
    """A trial that was run or read.

    Attributes:
        key: What the store knows it by.
        record: What came out of it.
        fresh: Whether it was run now; the store had it otherwise.
    """

    key: str
    record: TrialRecord
    fresh: bool


@dataclass(frozen=True, slots=True, kw_only=True)
class Batch:
    """Trials that share a plan, run one after another by one worker."""

    specs: tuple[TrialSpec, ...]


Result = tuple[str, TrialRecord, Provenance]

_LONGEST_SEARCHES = {"STRIDE": 0, "TRRT": 1}
"""The planners whose searches take longest, in their order."""


def key_of(spec: TrialSpec) -> str:
    """What the store knows a trial by: the digest of its inputs, the versions, and its variant."""
    return _key(spec, digests_of(spec, versions()))


def sweep(
    specs: Sequence[TrialSpec],
    store: EvidenceStore,
    *,
    jobs: int,
    on_finished: Callable[[FinishedTrial], None],
) -> None:
    """Run what the store has not, and keep each result as soon as its batch ends.

    Records do not depend on the number of processes or the order of the trials. When it is
    interrupted, what was finished is kept, and the next sweep goes on from there.

    Args:
        specs: The trials.
        store: Where evidence is kept.
        jobs: Number of worker processes; with 1 the trials run in this process.
        on_finished: Called for every trial, also for those that the store had.

    Raises:
        EvidenceError: The store cannot be read or written.
        SimulationError: A worker died.
    """
    keys = {key_of(spec): spec for spec in specs}
    there = store.has(keys)
    for key in keys:
        if key in there:
            found = store.get(key)
            if found is not None:
                on_finished(FinishedTrial(key=key, record=found.record, fresh=False))
    batches = batches_of([spec for key, spec in keys.items() if key not in there])
    for results in _results(batches, jobs):
        for key, record, provenance in results:
            store.put(key, record, provenance)
            on_finished(FinishedTrial(key=key, record=record, fresh=True))


def batches_of(specs: Sequence[TrialSpec]) -> list[Batch]:
    """Trials by the plan that they share; those whose planner searches longest come first."""
    groups: dict[str, list[TrialSpec]] = {}
    for spec in specs:
        groups.setdefault(digests_of(spec, versions()).plan, []).append(spec)
    batches = [Batch(specs=tuple(group)) for group in groups.values()]
    # A long batch at the end would leave the other processes idle.
    return sorted(batches, key=lambda batch: _LONGEST_SEARCHES.get(batch.specs[0].planner, 2))


def _results(batches: Sequence[Batch], jobs: int) -> Iterator[list[Result]]:
    if jobs <= 1 or len(batches) <= 1:
        for batch in batches:
            yield from ([result] for result in _run(batch))
        return
    # Engines keep state that must not be forked, so each worker is a fresh interpreter.
    context = multiprocessing.get_context("spawn")
    executor = ProcessPoolExecutor(max_workers=min(jobs, len(batches)), mp_context=context)
    pending: set[Future[list[Result]]] = set()
    try:
        with _interrupts_held_back():
            pending = {executor.submit(_run_all, batch) for batch in batches}
        while pending:
            done, pending = wait(pending, return_when=FIRST_COMPLETED)
            for future in done:
                yield future.result()
    except BrokenProcessPool as error:
        raise SimulationError(
            "a worker process died in the middle of a trial",
            hint="finished trials are kept; run again, with --jobs 1 to see which trial it is",
        ) from error
    finally:
        for future in pending:
            future.cancel()
        # Only an interrupted or failed sweep still has work here; its workers are not waited for.
        if pending:
            for process in list((executor._processes or {}).values()):  # noqa: SLF001 - no public way to stop at once
                process.terminate()
        executor.shutdown(wait=True, cancel_futures=True)


def _run_all(batch: Batch) -> list[Result]:
    return list(_run(batch))


def _run(batch: Batch) -> Iterator[Result]:
    for spec, digests, record in run_shared(batch.specs):
        yield _key(spec, digests), record, Provenance(inputs=digests.as_mapping(), versions=versions())


def _key(spec: TrialSpec, digests: TrialDigests) -> str:
    return trial_key({"trial": digests.trial, "variant": spec.variant})


@contextmanager
def _interrupts_held_back() -> Iterator[None]:
    """Start processes that never see Ctrl-C; in this one it takes effect at the end of the block.

    Ctrl-C reaches the whole process group, and only the parent answers it. What is blocked here
    stays blocked in the processes that are started here, from their first instruction on.
    """
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)
