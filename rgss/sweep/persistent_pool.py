"""One pool of worker processes for several sweeps that follow each other, so that engines are loaded once."""

from __future__ import annotations

from collections.abc import Callable
from types import TracebackType
from typing import Any

from rgss.sweep.task_end import Ended, Workers
from rgss.sweep.workers import WorkerPool


class PersistentWorkerPool:
    """Gives the workers of one sweep after the other; a context manager that leaves no process behind."""

    def __init__(self, *, size: int, time_limit_s: float, memory_limit_bytes: int) -> None:
        """Start nothing yet.

        Args:
            size: Greatest number of processes.
            time_limit_s: Greatest time of a task by the wall clock.
            memory_limit_bytes: Greatest size of a worker's data; 0 for no limit.
        """
        self._size = size
        self._time_limit_s = time_limit_s
        self._memory_limit_bytes = memory_limit_bytes
        self._pool: WorkerPool | None = None
        self._function: Callable[..., Any] | None = None

    def __enter__(self) -> PersistentWorkerPool:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def workers(self, function: Callable[..., Any]) -> Workers:
        """Workers for the next sweep; those of the last one, if it has closed them with nothing left to do.

        Args:
            function: Function of a module that makes a result from a task's arguments.
        """
        if self._pool is None or function is not self._function:
            self.close()
            self._function = function
            self._pool = WorkerPool(
                function,
                size=self._size,
                time_limit_s=self._time_limit_s,
                memory_limit_bytes=self._memory_limit_bytes,
            )
        return _PoolHandle(self._pool, self)

    def close(self) -> None:
        """End every process."""
        pool, self._pool = self._pool, None
        if pool is not None:
            pool.close()


class _PoolHandle:
    """The workers of one sweep, whose end is not that of the processes."""

    def __init__(self, pool: WorkerPool, owner: PersistentWorkerPool) -> None:
        self._pool = pool
        self._owner = owner
        self._running = 0

    @property
    def size(self) -> int:
        return self._pool.size

    @property
    def free(self) -> int:
        return self._pool.free

    def prepare_for(self, tasks: int) -> None:
        self._pool.prepare_for(tasks)

    def begin(self, key: str, arguments: tuple[Any, ...]) -> None:
        self._pool.begin(key, arguments)
        self._running += 1

    def wait(self, timeout_s: float) -> list[Ended]:
        ended = self._pool.wait(timeout_s)
        self._running -= len(ended)
        return ended

    def close(self) -> None:
        # No caller waits for running tasks any more, and only the end of their processes stops them.
        if self._running:
            self._owner.close()
