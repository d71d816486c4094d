"""Answers of workers compared with their tasks, before anything is built on them or kept."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import TypeGuard

from rgss.errors import RgssError
from rgss.evidence import (
    Piece,
    PieceKind,
    RunFailureKind,
    TrialRecord,
    record_from_json,
    record_to_json,
)
from rgss.evidence.records import piece_row
from rgss.findings import shown
from rgss.sweep.task_end import Ended, TaskError
from rgss.trials import TrialSpec
from rgss.trials.pieces import PieceTask, Task, bench_from_json, execution_from_json, plan_from_json, timing_from_json

_READERS: Mapping[PieceKind, Callable[[str], object]] = {
    PieceKind.PLAN: plan_from_json,
    PieceKind.TIMING: timing_from_json,
    PieceKind.EXECUTION: execution_from_json,
    PieceKind.BENCH: bench_from_json,
}


def checked(ended: Ended, task: Task) -> Ended:
    """The end of a task; one whose result does not fit the task has failed by a wrong answer."""
    if ended.failure is not None:
        return ended
    problem = answer_problem(task, ended.result)
    if problem:
        return wrong_answer(ended.key, problem)
    if isinstance(task, PieceTask):
        return ended
    # As it will be read: a text may replace a member of an enumeration.
    return replace(ended, result=record_from_json(record_to_json(ended.result)))


def wrong_answer(key: str, problem: str) -> Ended:
    """The end of a task that was answered wrongly, which another worker may do better."""
    failure = TaskError(kind=RunFailureKind.WRONG_ANSWER, detail=problem, may_pass=True)
    return Ended(key=key, result=None, failure=failure, took_s=0.0)


def answer_problem(task: Task, result: object) -> str:
    """Problem of the result of a task; empty if it can be kept."""
    try:
        return _piece_problem(task, result) if isinstance(task, PieceTask) else record_problem(task.spec, result)
    # Its parts may be of any kind, and break on anything.
    except Exception as error:
        return (
            f"it is malformed: {error.message if isinstance(error, RgssError) else f'{type(error).__name__}: {error}'}"
        )


def record_problem(spec: TrialSpec, record: object) -> str:
    """Problem of the record of a trial; empty if it is valid.

    Raises:
        EvidenceError: A part of the record has a wrong type, or is not finite.
    """
    if type(record) is not TrialRecord:
        return f"expected a record, got a {type(record).__name__}"
    record_to_json(record)
    if (record.variant, record.seed, record.fidelity) != (spec.variant, spec.seed, spec.fidelity):
        return "it is the record of another trial"
    if tuple(each.phase for each in record.phases) != spec.task.phases:
        return "it does not have the steps of the task in their order"
    if tuple(each.subtask for each in record.planning) != spec.task.planned:
        return "it does not have the planned moves of the task in their order"
    if record.failed_phase is not None and record.failed_phase not in spec.task.phases:
        return "it failed in a step that the task does not have"
    return ""


def is_end_of(ended: object, key: str) -> TypeGuard[Ended]:
    """True if a value is a well-typed end of the task with a key.

    Args:
        ended: The value sent by a remote worker.
        key: The task's key.
    """
    if type(ended) is not Ended or ended.key != key or type(ended.took_s) is not float:
        return False
    if not 0.0 <= ended.took_s < math.inf:
        return False
    failure = ended.failure
    return failure is None or (
        type(failure) is TaskError
        and isinstance(failure.kind, RunFailureKind)
        and type(failure.detail) is str
        and type(failure.may_pass) is bool
    )


def _piece_problem(task: PieceTask, result: object) -> str:
    if type(result) is not Piece:
        return f"expected a piece, got a {type(result).__name__}"
    if result.kind is not task.kind:
        return f"expected a piece of kind {task.kind.value}, got {shown(result.kind)}"
    if result.digest != task.digest:
        return f"expected piece {task.digest[:12]}, got {shown(result.digest)}"
    # The row is what the store keeps and reads back.
    piece_row(result)
    _READERS[task.kind](result.text)
    return ""
