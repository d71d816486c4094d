"""A supervised pool of worker processes that keep their engines loaded.

Each worker has its own pipe and at most one task, so that it is known exactly which task a
worker was at when it was killed, hung or ran out of memory, and no lock can stay behind with it.
Nothing here waits for a worker: tasks are sent and answers read as far as that is
possible at once, and an answer counts only if it is whole and that of the task.
(``concurrent.futures`` and loky give up all tasks when one worker dies and know no time limits;
pebble has both, but its workers share a lock that dies with its holder.)
"""

from __future__ import annotations

import itertools
import math
import multiprocessing
import pickle
import selectors
import signal
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from multiprocessing.process import BaseProcess
from types import TracebackType
from typing import Any

from rgss.errors import SimulationError
from rgss.evidence import RunFailureKind
from rgss.evidence.records import detail_line
from rgss.sweep.scratch_folder import ScratchFolder
from rgss.sweep.task_end import Ended, ended_by, failed_task, is_answer, process_ending
from rgss.sweep.worker_output import WorkerOutput
from rgss.sweep.worker_process import Ready, serve
from rgss.sweep.worker_wire import Channel, WireError
from rgss.trials.code import numeric_environment_of_children

_KILLED_S = 5.0
_STARTING_S = 120.0
_FAILED_STARTS = 2
"""Number of processes, beyond those of the pool, that may end in a row before one of them has done a task."""


@dataclass(slots=True, kw_only=True, eq=False)
class _Worker:
    process: BaseProcess
    channel: Channel
    output: WorkerOutput
    ready: bool
    proved: bool
    key: str | None
    task: int
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
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        """Prepare the pool; processes are started when they are needed.

        Args:
            function: Function that makes a result from a task's arguments; a function of a module, since the
                workers import it by its name.
            size: Greatest number of processes.
            time_limit_s: Greatest time of a task by the wall clock.
            memory_limit_bytes: Greatest size of a worker's data; 0 for no limit.
            clock: Gives the time that limits are compared with, in seconds.
        """
        self._function = pickle.dumps(function)
        self._size = size
        self._time_limit_s = time_limit_s
        self._memory_limit_bytes = memory_limit_bytes
        # Engines keep state that must not be forked, so each worker is a fresh interpreter.
        self._context = multiprocessing.get_context("spawn")
        self._workers: list[_Worker] = []
        self._numbers = itertools.count()
        self._clock = clock
        self._failed_starts = 0
        self._scratch: ScratchFolder | None = None

    def __enter__(self) -> WorkerPool:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    @property
    def size(self) -> int:
        """Number of tasks that it carries out at once."""
        return self._size

    @property
    def free(self) -> int:
        """Number of tasks that can be begun now."""
        return sum(worker.ready and worker.key is None for worker in self._workers)

    def prepare_for(self, tasks: int) -> None:
        """Have as many processes as there are tasks, up to the pool's size.

        Args:
            tasks: Number of tasks that are running or ready.

        Raises:
            SimulationError: The system lets no process be started, and there is none.
        """
        for _ in range(min(tasks, self._size) - len(self._workers)):
            try:
                self._start()
            except OSError as error:  # noqa: PERF203 - it ends the loop
                # With fewer it takes longer, and there may be room for more later.
                if self._workers:
                    return
                hint = "see what else the machine is doing, or raise its limits ('ulimit -n', 'ulimit -u')"
                raise SimulationError(f"a worker process cannot start: {error.strerror}", hint=hint) from error

    def begin(self, key: str, arguments: tuple[Any, ...]) -> None:
        """Begin a task; only while one is free.

        Args:
            key: A name for it.
            arguments: Arguments of the function.
        """
        worker = next(worker for worker in self._workers if worker.ready and worker.key is None)
        worker.key, worker.task = key, next(self._numbers)
        worker.ends_at = self._clock() + self._time_limit_s
        # If it has died meanwhile, that is reported when its end is waited for.
        worker.channel.send(pickle.dumps((worker.task, arguments)))

    def wait(self, timeout_s: float) -> list[Ended]:
        """Wait until tasks end, workers become free, or the time is over; returns what has ended.

        Raises:
            SimulationError: Workers could not be started, one after another.
        """
        first = min((worker.ends_at for worker in self._workers), default=math.inf)
        self._wait_for_any(max(0.0, min(timeout_s, first - self._clock())))
        ended = [self._looked_at(worker) for worker in list(self._workers)]
        now = self._clock()
        ended += [self._too_late(worker) for worker in list(self._workers) if worker.ends_at <= now]
        return [each for each in ended if each is not None]

    def close(self) -> None:
        """Stop at once, whatever is being done."""
        for worker in self._workers:
            worker.process.kill()
        for worker in list(self._workers):
            self._dismiss(worker)
        if self._scratch is not None:
            self._scratch.remove()
            self._scratch = None

    def _start(self) -> None:
        output = WorkerOutput()
        try:
            here, there = self._context.Pipe()
        except OSError:
            output.close()
            raise
        self._scratch = self._scratch or ScratchFolder()
        arguments = (self._function, there, self._memory_limit_bytes, output.end, self._scratch.path)
        process = self._context.Process(target=serve, args=arguments, daemon=True)
        with _interrupts_held_back(), numeric_environment_of_children():
            try:
                process.start()
            except OSError:
                here.close()
                output.close()
                raise
            finally:
                there.close()
            self._workers.append(
                _Worker(
                    process=process,
                    channel=Channel(here),
                    output=output,
                    ready=False,
                    proved=False,
                    key=None,
                    task=-1,
                    ends_at=self._clock() + _STARTING_S,
                )
            )

    def _wait_for_any(self, patience_s: float) -> None:
        """Wait until a worker has sent something or takes more of its task."""
        with selectors.PollSelector() as selector:
            for worker in self._workers:
                writes = selectors.EVENT_WRITE if worker.channel.has_unsent else 0
                selector.register(worker.channel, selectors.EVENT_READ | writes)
            selector.select(patience_s)

    def _looked_at(self, worker: _Worker) -> Ended | None:
        """End of a worker's task since the last look; None if there is none."""
        worker.channel.flush()
        # Polled before the tail of stderr is read, which is then complete.
        has_ended = worker.process.exitcode is not None
        try:
            messages = worker.channel.receive()
        except EOFError:
            return self._died(worker)
        except WireError as error:
            return self._wrong(worker, str(error))
        if messages:
            return self._receive(worker, messages)
        return self._died(worker) if has_ended else None

    def _receive(self, worker: _Worker, messages: list[bytes]) -> Ended | None:
        try:
            message = pickle.loads(messages[0])  # noqa: S301 - our own process wrote it, as its checksum shows
        # The parts of a message may break on anything where they are put together.
        except Exception as error:
            return self._wrong(worker, f"its answer cannot be read: {type(error).__name__}: {error}")
        if isinstance(message, Ready) and not worker.ready and len(messages) == 1:
            if message.error:
                raise _not_started(message.error)
            worker.ready, worker.ends_at = True, math.inf
            return None
        if worker.key is None or len(messages) > 1 or not is_answer(message, worker.task):
            return self._wrong(worker, "its answer belongs to another task")
        key, worker.key, worker.ends_at, worker.proved = worker.key, None, math.inf, True
        self._failed_starts = 0
        if message.out_of_memory:
            # What an engine makes of a failed allocation is not known, so this worker does no more.
            self._dismiss(worker)
        return ended_by(message, key)

    def _wrong(self, worker: _Worker, problem: str) -> Ended | None:
        """End a worker whose answer is invalid."""
        self._dismiss(worker)
        return self._failed(worker, RunFailureKind.WRONG_ANSWER, f"the worker was ended: {problem}")

    def _died(self, worker: _Worker) -> Ended | None:
        how = process_ending(worker.process)
        tail = worker.output.tail()
        self._dismiss(worker)
        return self._failed(worker, RunFailureKind.CRASHED, f"the worker {how}" + (f": {tail}" if tail else ""))

    def _too_late(self, worker: _Worker) -> Ended | None:
        self._dismiss(worker)
        if not worker.ready:
            return self._failed(worker, RunFailureKind.TIMED_OUT, f"the worker has not started after {_STARTING_S:g} s")
        return self._failed(worker, RunFailureKind.TIMED_OUT, f"not done after {self._time_limit_s:g} s")

    def _failed(self, worker: _Worker, kind: RunFailureKind, detail: str) -> Ended | None:
        """The end of the task that a worker had; one that had none is replaced, but not for ever.

        Raises:
            SimulationError: Too many in a row have ended before they had done anything.
        """
        if worker.key is not None:
            return failed_task(worker.key, kind, detail)
        if not worker.proved:
            self._failed_starts += 1
            if self._failed_starts > self._size + _FAILED_STARTS:
                raise _not_started(f"{detail}, like {self._failed_starts - 1} before it")
        return None

    def _dismiss(self, worker: _Worker) -> None:
        worker.process.kill()
        worker.process.join(_KILLED_S)
        worker.channel.close()
        worker.output.close()
        self._workers.remove(worker)


def _not_started(how: str) -> SimulationError:
    return SimulationError(f"a worker process cannot start: {detail_line(how)}", hint="is its memory limit too low?")


@contextmanager
def _interrupts_held_back() -> Iterator[None]:
    """Start processes that never see Ctrl-C; in this one it takes effect at the end of the block.

    Ctrl-C reaches the whole process group, as do the loss of the terminal and the request of a service manager to
    terminate, and only the parent answers them. What is blocked here stays blocked in the processes that are started
    here, from their first instruction on.
    """
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT, signal.SIGTERM, signal.SIGHUP})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)
