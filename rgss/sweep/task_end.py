"""Ends of tasks, and the interface of execution backends."""

from __future__ import annotations

import math
import signal
import time
from dataclasses import dataclass
from multiprocessing.process import BaseProcess
from typing import Any, Protocol

from rgss.evidence import RunFailureKind
from rgss.sweep.worker_process import Answer

_ENDING_S = 5.0
_ENDING_LOOK_S = 0.01


@dataclass(frozen=True, slots=True, kw_only=True)
class TaskError:
    """Failure of a task.

    Attributes:
        kind: Kind of the failure.
        detail: One line: the signal, the limit, the exception.
        may_pass: True if another attempt may succeed.
    """

    kind: RunFailureKind
    detail: str
    may_pass: bool


@dataclass(frozen=True, slots=True, kw_only=True)
class Ended:
    """End of a task.

    Attributes:
        key: The task's key.
        result: Its result; None if it failed.
        failure: Reason of its failure; None if it succeeded.
        took_s: Its time by the wall clock; 0 if it failed.
    """

    key: str
    result: Any
    failure: TaskError | None
    took_s: float


class Workers(Protocol):
    """Execution backend of tasks: processes here, or machines elsewhere."""

    @property
    def size(self) -> int:
        """Number of tasks that it carries out at once."""

    @property
    def free(self) -> int:
        """Number of tasks that can be begun now."""

    def prepare_for(self, tasks: int) -> None:
        """Be ready for this many tasks, as far as that is possible."""

    def begin(self, key: str, arguments: tuple[Any, ...]) -> None:
        """Begin a task; only while one is free."""

    def wait(self, timeout_s: float) -> list[Ended]:
        """Wait until tasks end, workers become free, or the timeout; returns the ended tasks."""

    def close(self) -> None:
        """Stop at once, whatever is being done."""


def ended_by(answer: Answer, key: str) -> Ended:
    """The end of a task that a worker has answered.

    Args:
        answer: The worker's answer.
        key: The task's name.
    """
    if not answer.error:
        return Ended(key=key, result=answer.result, failure=None, took_s=answer.took_s)
    kind = RunFailureKind.OUT_OF_MEMORY if answer.out_of_memory else RunFailureKind.RAISED
    return failed_task(key, kind, answer.error, may_pass=not answer.ours)


def failed_task(key: str, kind: RunFailureKind, detail: str, *, may_pass: bool = True) -> Ended:
    """The end of a task without a result."""
    return Ended(key=key, result=None, failure=TaskError(kind=kind, detail=detail, may_pass=may_pass), took_s=0.0)


def is_answer(message: object, task: int) -> bool:
    """True if a message is the answer to a task, and each part of it of its type."""
    return (
        type(message) is Answer
        and type(message.task) is int
        and message.task == task
        and type(message.error) is str
        and type(message.ours) is bool
        and type(message.out_of_memory) is bool
        and type(message.took_s) is float
        and 0.0 <= message.took_s < math.inf
    )


def process_ending(process: BaseProcess) -> str:
    """End of a process whose end of the pipe is closed, as a phrase that follows 'the worker'."""
    latest = time.monotonic() + _ENDING_S
    while process.exitcode is None and time.monotonic() < latest:
        time.sleep(_ENDING_LOOK_S)
    status = process.exitcode
    if status is None:
        return "closed its pipe and did not end"
    if status < 0:
        try:
            return f"was killed by {signal.Signals(-status).name}"
        except ValueError:
            return f"was killed by signal {-status}"
    return f"ended with status {status}"
