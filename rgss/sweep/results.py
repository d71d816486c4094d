"""Limits of a sweep's workers, its state while it runs, and its result."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from rgss.evidence import RunFailure, TrialRecord

_MIB = 1024 * 1024


@dataclass(frozen=True, slots=True, kw_only=True)
class WorkerLimits:
    """Limits of a worker for one task.

    Attributes:
        time_s: Wall-clock time limit: a hundred times that of the longest search.
        memory_bytes: Greatest size of a worker's data; 0 for no limit.
    """

    time_s: float = 300.0
    memory_bytes: int = 2048 * _MIB


@dataclass(frozen=True, slots=True, kw_only=True)
class FinishedTrial:
    """A trial that was run or read.

    Attributes:
        key: Its key in the store.
        record: Its record.
        fresh: Whether it was put together now; the store had it otherwise.
    """

    key: str
    record: TrialRecord
    fresh: bool


@dataclass(frozen=True, slots=True, kw_only=True)
class LostTrials:
    """A failure of the run, and the trials that have no record for it.

    Attributes:
        failure: Task that could not be done, and the reason.
        trials: Variant and seed of each trial that needed it.
    """

    failure: RunFailure
    trials: tuple[tuple[int, int], ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class SweepState:
    """Progress of a sweep.

    Attributes:
        elapsed_s: Time since its start.
        remaining_s: Estimated remaining time; None before an estimate is available.
        tasks_left: Number of remaining pieces (or trials, without sharing).
        made: Number of computed pieces of each kind.
        reused: Number of pieces of each kind from the store.
        saved: Number of pieces saved by sharing.
    """

    elapsed_s: float
    remaining_s: float | None
    tasks_left: int
    made: Mapping[str, int]
    reused: Mapping[str, int]
    saved: int


@dataclass(frozen=True, slots=True, kw_only=True)
class SweepResult:
    """Result of a sweep.

    Attributes:
        made: Number of pieces of each kind that were made; ``trial`` where nothing was shared.
        reused: Number of pieces of each kind that came from the store.
        lost: Trials and pieces that could not be made; empty if all trials have records.
        elapsed_s: Time from the first task to the last, workers' start included.
        busy_s: Time that the workers spent on tasks, summed over them.
    """

    made: Mapping[str, int]
    reused: Mapping[str, int]
    lost: tuple[LostTrials, ...]
    elapsed_s: float = 0.0
    busy_s: float = 0.0
