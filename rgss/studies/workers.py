"""A supervised pool of worker processes that keep their engines loaded.

Each worker has a pipe of its own and at most one task, so that it is known exactly which task a
worker was at when it was killed, hung or ran out of memory, and no lock can stay behind with it.
(``concurrent.futures`` and loky give up all tasks when one worker dies and know no time limits;
pebble has both, but its workers share a lock that dies with its holder.)
"""

from __future__ import annotations

import contextlib
import itertools
import math
import multiprocessing
import pickle
import signal
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from multiprocessing import connection
from multiprocessing.process import BaseProcess
from pathlib import Path
from types import TracebackType
from typing import Any, Protocol

from rgss.errors import SimulationError
from rgss.evidence import RunFailureKind
from rgss.studies.worker_process import Answer, Ready, serve
from rgss.trials.numeric_environment import numeric_environment_of_children

_ENDING_S = 5.0
_STARTING_S = 120.0
_LONGEST_WORDS = 300


@dataclass(frozen=True, slots=True, kw_only=True)
class Trouble:
    """Why a task has no result.

    Attributes:
        kind: What happened to it.
        detail: One line: the signal, the limit, the exception.
        may_pass: Whether another attempt could have another end.
    """

    kind: RunFailureKind
    detail: str
    may_pass: bool


@dataclass(frozen=True, slots=True, kw_only=True)
class Ended:
    """A task that has come to its end.

    Attributes:
        key: The name that it was given.
        result: What it made; None if it failed.
        trouble: Why it failed; None if it did not.
        took_s: Its time by the wall clock; 0 if it failed.
    """

    key: str
    result: Any
    trouble: Trouble | None
    took_s: float


class Workers(Protocol):
    """What carries out tasks: processes here, or machines elsewhere."""

    @property
    def size(self) -> int:
        """How many tasks it carries out at once."""

    @property
    def free(self) -> int:
        """How many tasks can be begun now."""

    def want(self, tasks: int) -> None:
        """Be ready for this many tasks, as far as that is possible."""

    def begin(self, key: str, arguments: tuple[Any, ...]) -> None:
        """Begin a task; only while one is free."""

    def wait(self, timeout_s: float) -> list[Ended]:
        """Wait until tasks end, workers become free, or the time is over; returns what has ended."""

    def close(self) -> None:
        """Stop at once, whatever is being done."""


@dataclass(slots=True, kw_only=True, eq=False)
class _Worker:
    process: BaseProcess
    pipe: connection.Connection
    output: Path
    ready: bool
    key: str | None
    ends_at: float


class WorkerPool:
    """Processes on this machine; a context manager that leaves none of them behind."""

    def __init__(
        self,
        function: Callable[..., Any],
        *,
        size: int,
        time_limit_s: float = math.inf,
        memory_limit_bytes: int = 0,
    ) -> None:
        """Prepare the pool; processes are started when they are wanted.

        Args:
            function: What makes a result from a task's arguments; a function of a module, since the
                workers import it by its name.
            size: Greatest number of processes.
            time_limit_s: Greatest time of a task by the wall clock.
            memory_limit_bytes: Greatest size of a worker's data; 0 for no limit.
        """
        self._function = pickle.dumps(function)
        self._size = size
        self._time_limit_s = time_limit_s
        self._memory_limit_bytes = memory_limit_bytes
        # Engines keep state that must not be forked, so each worker is a fresh interpreter.
        self._context = multiprocessing.get_context("spawn")
        self._workers: list[_Worker] = []
        self._numbers = itertools.count()
        self._outputs = tempfile.TemporaryDirectory(prefix="rgss-", ignore_cleanup_errors=True)

    def __enter__(self) -> WorkerPool:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    @property
    def size(self) -> int:
        """How many tasks it carries out at once."""
        return self._size

    @property
    def free(self) -> int:
        """How many tasks can be begun now."""
        return sum(worker.ready and worker.key is None for worker in self._workers)

    def want(self, tasks: int) -> None:
        """Have as many processes as there are tasks, up to the pool's size.

        Args:
            tasks: How many tasks are being done or could be.
        """
        for _ in range(min(tasks, self._size) - len(self._workers)):
            self._start()

    def begin(self, key: str, arguments: tuple[Any, ...]) -> None:
        """Begin a task; only while one is free.

        Args:
            key: A name for it.
            arguments: What the function is called with.
        """
        worker = next(worker for worker in self._workers if worker.ready and worker.key is None)
        worker.key = key
        worker.ends_at = time.monotonic() + self._time_limit_s
        # If it has died meanwhile, that is noticed and told when its end is waited for.
        with contextlib.suppress(OSError):
            worker.pipe.send(arguments)

    def wait(self, timeout_s: float) -> list[Ended]:
        """Wait until tasks end, workers become free, or the time is over; returns what has ended.

        Args:
            timeout_s: The longest time to wait.

        Raises:
            SimulationError: A worker could not be started.
        """
        first = min((worker.ends_at for worker in self._workers), default=math.inf)
        patience_s = max(0.0, min(timeout_s, first - time.monotonic()))
        pipes = {worker.pipe: worker for worker in self._workers}
        spoke = set(connection.wait(list(pipes), patience_s))
        ended = [self._heard(worker) for pipe, worker in pipes.items() if pipe in spoke]
        now = time.monotonic()
        ended += [self._too_late(worker) for worker in list(self._workers) if worker.ends_at <= now]
        return [each for each in ended if each is not None]

    def close(self) -> None:
        """Stop at once, whatever is being done."""
        for worker in self._workers:
            worker.process.kill()
        for worker in list(self._workers):
            self._dismiss(worker)
        self._outputs.cleanup()

    def _start(self) -> None:
        here, there = self._context.Pipe()
        output = Path(self._outputs.name) / f"{next(self._numbers)}.txt"
        process = self._context.Process(
            target=serve, args=(self._function, there, self._memory_limit_bytes, str(output)), daemon=True
        )
        with _interrupts_held_back(), numeric_environment_of_children():
            process.start()
            there.close()
            begun = time.monotonic()
            self._workers.append(
                _Worker(process=process, pipe=here, output=output, ready=False, key=None, ends_at=begun + _STARTING_S)
            )

    def _heard(self, worker: _Worker) -> Ended | None:
        try:
            message = worker.pipe.recv()
        except (EOFError, OSError, pickle.UnpicklingError):
            return self._died(worker)
        if isinstance(message, Ready):
            if message.error:
                raise _not_started(message.error)
            worker.ready, worker.ends_at = True, math.inf
            return None
        answer: Answer = message
        key, worker.key, worker.ends_at = worker.key or "", None, math.inf
        if answer.out_of_memory:
            # What an engine makes of a failed allocation is not known, so this worker does no more.
            self._dismiss(worker)
        return ended_by(answer, key)

    def _died(self, worker: _Worker) -> Ended | None:
        worker.process.join(_ENDING_S)
        how = _ending(worker.process.exitcode) + _last_words(worker.output)
        self._dismiss(worker)
        if not worker.ready:
            raise _not_started(f"it {how}")
        return None if worker.key is None else _failed(worker.key, RunFailureKind.CRASHED, f"the worker {how}")

    def _too_late(self, worker: _Worker) -> Ended | None:
        self._dismiss(worker)
        if not worker.ready:
            raise SimulationError(
                f"a worker process has not started after {_STARTING_S:g} s", hint="see what else the machine is doing"
            )
        detail = f"not done after {self._time_limit_s:g} s"
        return None if worker.key is None else _failed(worker.key, RunFailureKind.TIMED_OUT, detail)

    def _dismiss(self, worker: _Worker) -> None:
        worker.process.kill()
        worker.process.join(_ENDING_S)
        worker.pipe.close()
        worker.output.unlink(missing_ok=True)
        self._workers.remove(worker)


def ended_by(answer: Answer, key: str) -> Ended:
    """The end of a task that a worker has answered.

    Args:
        answer: What the worker said.
        key: The task's name.
    """
    if not answer.error:
        return Ended(key=key, result=answer.result, trouble=None, took_s=answer.took_s)
    kind = RunFailureKind.OUT_OF_MEMORY if answer.out_of_memory else RunFailureKind.RAISED
    return _failed(key, kind, answer.error, may_pass=not answer.ours)


def _failed(key: str, kind: RunFailureKind, detail: str, *, may_pass: bool = True) -> Ended:
    return Ended(key=key, result=None, trouble=Trouble(kind=kind, detail=detail, may_pass=may_pass), took_s=0.0)


def _not_started(how: str) -> SimulationError:
    return SimulationError(f"a worker process cannot start: {how}", hint="is its memory limit too low?")


def _last_words(output: Path) -> str:
    """The last line that a worker has printed, by which libraries say why they end the process."""
    try:
        with output.open("rb") as file:
            file.seek(max(0, output.stat().st_size - _LONGEST_WORDS))
            lines = file.read().decode("utf-8", "replace").split("\n")
    except OSError:
        return ""
    words = next((" ".join(line.split()) for line in reversed(lines) if line.strip()), "")
    return f": {words}" if words else ""


def _ending(status: int | None) -> str:
    """How a process ended, from its exit status."""
    if status is not None and status < 0:
        try:
            return f"was killed by {signal.Signals(-status).name}"
        except ValueError:
            return f"was killed by signal {-status}"
    return f"ended with status {status}"


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
