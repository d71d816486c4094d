"""Engine processes of a Dask worker, one for each of its threads.

A planner's random numbers are one sequence for a whole process, a crash of an engine would kill the Dask worker, and a
hanging thread cannot be ended. Each thread of a Dask worker therefore has a supervised process, as in a local sweep,
with the same limits and handling of crashes for any number of threads. The processes end with their order, with their
Dask worker, or after an idle time.
"""

from __future__ import annotations

import multiprocessing
import pickle
import threading
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

from rgss.evidence import RunFailureKind
from rgss.sweep.dask.process_environment import are_alike, environment
from rgss.sweep.task_end import Ended, TaskError
from rgss.sweep.workers import WorkerPool

_LOOK_S = 0.1
_IDLE_S = 60.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Order:
    """Settings of all tasks that one process submits.

    Attributes:
        name: Its name, which no other has.
        environment: Code and engines that a process must have, as `environment` gives it.
        time_limit_s: Greatest time of a task by the wall clock, from its beginning in its process.
        memory_limit_bytes: Greatest size of an engine process's data; 0 for no limit.
    """

    name: str
    environment: Mapping[str, str]
    time_limit_s: float
    memory_limit_bytes: int


@dataclass(frozen=True, slots=True, kw_only=True)
class Differs:
    """In place of a result: the process that was to make it would have made another.

    Attributes:
        found: Its environment; empty if that is unknown.
        why: Reason that it is unknown, in one line; empty if it is known.
        where: Address of the Dask worker that the process belongs to.
    """

    found: Mapping[str, str]
    why: str = ""
    where: str = ""


def make_alike(expected: Mapping[str, str], work: bytes) -> Any:
    """Compute a result if this process is equivalent to the requesting one; runs in an engine process.

    Args:
        expected: Required code and engines of this process.
        work: A function and its arguments, pickled.
    """
    try:
        found = environment()
    except ImportError as error:
        return Differs(found={}, why=" ".join(str(error).split()))
    if not are_alike(found, expected):
        return Differs(found=found)
    # Who may use a Dask cluster may run anything on it: this adds nothing to what its scheduler allows.
    function, arguments = pickle.loads(work)  # noqa: S301
    return function(*arguments)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Idle:
    pool: WorkerPool
    order: Order
    since: float


class Engines:
    """Pool of the engine processes of a Dask worker, one for each concurrent task."""

    def __init__(self, *, idle_s: float = _IDLE_S) -> None:
        """Begin with none.

        Args:
            idle_s: Longest time that a process may be idle; its client may have ended without notice.
        """
        self._idle_s = idle_s
        self._lock = threading.Lock()
        self._idle: list[_Idle] = []
        self._stopped: set[str] = set()
        self._closed = False
        self._timer: threading.Timer | None = None

    def carry_out(self, order: Order, key: str, work: bytes) -> Ended:
        """Carry out a task in one of the processes.

        Args:
            order: Settings that all tasks of a sweep share.
            key: The task's name.
            work: A function and its arguments, pickled.

        Returns:
            Its end; one without a result if it was stopped meanwhile.

        Raises:
            SimulationError: The process cannot start.
        """
        pool = self._taken(order)
        try:
            ended = self._ended(pool, order, key, work)
        except BaseException:
            pool.close()
            raise
        self._put_back(pool, order)
        return ended or _stopped(key)

    def stop(self, order: str) -> None:
        """Stop all tasks of an order, and end its idle processes.

        Args:
            order: The order's name.
        """
        with self._lock:
            self._stopped.add(order)
        self._dismiss(lambda idle: idle.order.name == order)

    def close(self) -> None:
        """End every process; called by the Dask worker when it ends."""
        with self._lock:
            self._closed = True
            if self._timer is not None:
                self._timer.cancel()
        self._dismiss(lambda _: True)

    @property
    def idle(self) -> int:
        """Number of idle processes."""
        return len(self._idle)

    def _taken(self, order: Order) -> WorkerPool:
        with self._lock:
            for idle in self._idle:
                if idle.order == order:
                    self._idle.remove(idle)
                    return idle.pool
        return WorkerPool(
            make_alike, size=1, time_limit_s=order.time_limit_s, memory_limit_bytes=order.memory_limit_bytes
        )

    def _ended(self, pool: WorkerPool, order: Order, key: str, work: bytes) -> Ended | None:
        """End of the task; None if it is stopped before."""
        begun = False
        while not self._is_over(order):
            if not begun:
                with self._lock, _free_to_have_children():
                    pool.prepare_for(1)
                if pool.free:
                    pool.begin(key, (order.environment, work))
                    begun = True
            for ended in pool.wait(_LOOK_S):
                return ended
        return None

    def _is_over(self, order: Order) -> bool:
        return self._closed or order.name in self._stopped

    def _put_back(self, pool: WorkerPool, order: Order) -> None:
        with self._lock:
            wanted = not self._is_over(order)
            if wanted:
                self._idle.append(_Idle(pool=pool, order=order, since=time.monotonic()))
                self._look_later()
        if not wanted:
            pool.close()

    def _look_later(self) -> None:
        if self._timer is None:
            self._timer = threading.Timer(self._idle_s, self._dismiss_idle)
            self._timer.daemon = True
            self._timer.start()

    def _dismiss_idle(self) -> None:
        now = time.monotonic()
        self._dismiss(lambda idle: now - idle.since >= self._idle_s)
        with self._lock:
            self._timer = None
            if self._idle and not self._closed:
                self._look_later()

    def _dismiss(self, unwanted: Callable[[_Idle], bool]) -> None:
        with self._lock:
            expired = [idle for idle in self._idle if unwanted(idle)]
            self._idle = [idle for idle in self._idle if idle not in expired]
        for idle in expired:
            idle.pool.close()


def _stopped(key: str) -> Ended:
    failure = TaskError(kind=RunFailureKind.CRASHED, detail="the sweep was stopped", may_pass=True)
    return Ended(key=key, result=None, failure=failure, took_s=0.0)


@contextmanager
def _free_to_have_children() -> Iterator[None]:
    """Allow this process to start children although it is a daemon, as Dask's workers are by default.

    Python forbids that to avoid orphaned children; ours end with their parent.
    """
    process = multiprocessing.current_process()
    before = process.daemon
    process.daemon = False
    try:
        yield
    finally:
        process.daemon = before
