"""Workers whose answers are whole, and whose results are of any kind."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

import worker_doubles

from rgss.evidence import Piece, PieceKind, TrialRecord
from rgss.trials.pieces.pieces import Task, TrialTask
from tests.fixtures.eight_states import Phase


def wrong(task: Task, needed: dict[str, Piece]) -> Piece | TrialRecord:
    """Every seed has its own lie about a piece of its, or about its record; seed 0 is honest."""
    made = worker_doubles.quick(task, needed)
    seed = task.spec.seed
    if isinstance(task, TrialTask):
        return CHANGED_RECORDS[seed](made) if seed in CHANGED_RECORDS else made
    kind = PieceKind.EXECUTION if seed >= LATE else PieceKind.PLAN
    return WRONG_PIECES[seed % LATE](made) if task.kind is kind and seed % LATE in WRONG_PIECES else made


LATE = 100
"""Seeds from here on have the same lies about their executions."""

WRONG_PIECES: dict[int, Callable[[Piece], object]] = {
    1: lambda piece: None,
    2: lambda piece: "a piece",
    3: lambda piece: replace(piece, digest="0" * 64),
    4: lambda piece: replace(piece, kind=PieceKind.BENCH),
    5: lambda piece: replace(piece, kind="plan"),
    6: lambda piece: replace(piece, text="{}"),
    7: lambda piece: replace(piece, text="not JSON"),
    8: lambda piece: replace(piece, text=piece.text.encode()),
    9: lambda piece: replace(piece, text=piece.text.replace("0.001", "NaN").replace("[]", "[NaN]")),
    10: lambda piece: replace(piece, text="\udc80"),
    11: lambda piece: replace(piece, text=" " * (17 * 1024 * 1024)),
    12: lambda piece: worker_doubles.quick,
    13: lambda piece: replace(piece, text="[" * 100_000),
}

WRONG_RECORDS: dict[int, Callable[[TrialRecord], object]] = {
    1: lambda record: None,
    2: lambda record: replace(record, variant=record.variant + 1),
    3: lambda record: replace(record, seed=record.seed + 1),
    4: lambda record: replace(record, success="yes"),
    5: lambda record: replace(record, metrics={**record.metrics, "task_time_s": math.nan}),
    6: lambda record: replace(record, phases=record.phases[:3]),
    7: lambda record: replace(record, planning=()),
    8: lambda record: replace(record, failed_phase="nowhere"),
    9: lambda record: replace(record, metrics=[1.0]),
    10: lambda record: replace(record, seed=str(record.seed)),
}

TEXTS_FOR_MEMBERS = 50
"""A seed whose record has texts in the place of members of enumerations, which are as good."""

CHANGED_RECORDS = {
    **WRONG_RECORDS,
    TEXTS_FOR_MEMBERS: lambda record: replace(record, failed_phase=Phase(record.failed_phase).value),
}
