"""Execution backend of a sweep on a Dask cluster.

The sweep owns the task queue and the store; the cluster receives tasks whose dependencies are complete, with all inputs
by value, and returns results. Each thread of the cluster has more than one task, so that the next one is available at
once; Dask restarts the tasks of a lost worker.
"""

from __future__ import annotations

import contextlib
import pickle
import queue
import threading
import time
import uuid
from collections.abc import Callable, Sequence
from typing import Any

from rgss.errors import SimulationError
from rgss.evidence import RunFailureKind
from rgss.sweep.answers import is_end_of, wrong_answer
from rgss.sweep.dask.engines import Differs, Order
from rgss.sweep.dask.tasks import carry_out, stop
from rgss.sweep.task_end import Ended, TaskError

IN_FLIGHT = 2
"""Number of tasks that each thread of the cluster has: one that is carried out, and the next."""

WITHOUT_WORKERS_S = 300.0
"""Longest time for which a cluster may be without any worker in the middle of a sweep."""

_COUNTED_EVERY_S = 1.0
_STOPPING_S = 0.7


class DaskWorkers:
    """Workers of a sweep: the threads of a Dask cluster's workers, each with an engine process."""

    def __init__(
        self,
        client: Any,
        function: Callable[..., Any],
        order: Order,
        *,
        address: str,
        differs: Callable[[Differs], str],
        without_workers_s: float = WITHOUT_WORKERS_S,
    ) -> None:
        """Prepare the backend, without sending anything to the cluster.

        Args:
            client: A client of the cluster.
            function: Function that computes a result from a task's arguments; module-level, since workers import it by
                name.
            order: Settings that all tasks of a sweep share.
            address: The scheduler's address, for messages.
            differs: Describes in what a worker differs.
            without_workers_s: Longest time without any worker.
        """
        self._client = client
        self._function = function
        self._order = order
        self._address = address
        self._differs = differs
        self._without_workers_s = without_workers_s
        self._running: dict[str, Any] = {}
        self._done: queue.SimpleQueue[str] = queue.SimpleQueue()
        self._threads = 0
        self._counted_at = -_COUNTED_EVERY_S
        self._there_at = time.monotonic()
        self._count()

    @property
    def size(self) -> int:
        """Number of tasks that the cluster carries out at once; 1 while it has no worker."""
        return max(1, self._threads)

    @property
    def free(self) -> int:
        """Number of tasks that can be begun now."""
        return max(0, IN_FLIGHT * self._threads - len(self._running))

    def prepare_for(self, tasks: int) -> None:
        """The cluster has the workers that it has."""

    def begin(self, key: str, arguments: tuple[Any, ...]) -> None:
        """Submit a task to the cluster.

        Args:
            key: A name for it.
            arguments: Arguments of the function.
        """
        # Pickled here, it stays as it is on its way: neither Dask nor its workers look into it.
        work = pickle.dumps((self._function, arguments))
        # Another sweep may give the same task to the same cluster.
        name = f"rgss-{key[:16]}-{uuid.uuid4().hex}"
        future = self._client.submit(carry_out, self._order, key, work, key=name, pure=False)
        self._running[key] = future
        future.add_done_callback(lambda _: self._done.put(key))

    def wait(self, timeout_s: float) -> list[Ended]:
        """Wait until tasks end or the timeout; returns the ended tasks.

        Raises:
            SimulationError: The scheduler or all workers are lost, or a worker is not equivalent to this process.
        """
        self._count()
        keys = []
        with contextlib.suppress(queue.Empty):
            keys.append(self._done.get(timeout=min(timeout_s, _COUNTED_EVERY_S)))
            while True:
                keys.append(self._done.get_nowait())
        return [self._ended(key) for key in keys]

    def close(self) -> None:
        """Stop at once, whatever is being done; then no other workers can be had by the same order."""
        futures, self._running = list(self._running.values()), {}
        if futures:
            stop_all(self._client, self._order, futures)

    def _count(self) -> None:
        """Count the cluster's threads from time to time: workers come and go."""
        now = time.monotonic()
        if now - self._counted_at < _COUNTED_EVERY_S:
            return
        try:
            self._threads = sum(self._client.nthreads().values())
        except OSError as error:
            raise self._lost() from error
        self._counted_at = now
        if self._threads:
            self._there_at = now
        elif now - self._there_at > self._without_workers_s:
            raise SimulationError(
                f"the Dask cluster at {self._address} has had no workers for {self._without_workers_s:g} s",
                hint="what was finished is kept; start workers and run the sweep again",
            )

    def _ended(self, key: str) -> Ended:
        from concurrent.futures import CancelledError

        from distributed import KilledWorker

        future = self._running.pop(key)
        try:
            ended: object = future.result()
        except KilledWorker as error:
            detail = f"{error.allowed_failures + 1} Dask workers were lost at it"
            failure = TaskError(kind=RunFailureKind.CRASHED, detail=detail, may_pass=True)
            return Ended(key=key, result=None, failure=failure, took_s=0.0)
        except (CancelledError, OSError) as error:
            raise self._lost() from error
        except SimulationError:
            raise
        # Whatever a worker's environment breaks on comes back as it was raised there.
        except Exception as error:
            line = f"{type(error).__name__}: {' '.join(str(error).split())}"
            raise SimulationError(
                f"a worker of the Dask cluster at {self._address} cannot carry out tasks of rgss: {line}",
                hint="install the same rgss on every worker",
            ) from error
        finally:
            future.release()
        if not is_end_of(ended, key):
            return wrong_answer(key, "the answer of a Dask worker belongs to another task")
        if isinstance(ended.result, Differs):
            raise SimulationError(
                self._differs(ended.result), hint="every worker needs the same engines and the same rgss"
            )
        return ended

    def _lost(self) -> SimulationError:
        return SimulationError(
            f"the Dask scheduler at {self._address} has stopped or has dropped the sweep's tasks",
            hint="what was finished is kept; run the sweep again to go on",
        )


def stop_all(client: Any, order: Order, futures: Sequence[Any] = ()) -> None:
    """Cancel tasks and end every engine process of an order, wherever it is, as far as the cluster answers.

    Args:
        client: A client of the cluster.
        order: The order.
        futures: The tasks that have not ended.
    """

    def cancel() -> None:
        with contextlib.suppress(Exception):
            if futures:
                client.cancel(list(futures))
            client.run(stop, order.name, on_error="ignore")

    # A scheduler that does not answer must not keep what is finished here from being written down.
    cancelling = threading.Thread(target=cancel, daemon=True)
    cancelling.start()
    cancelling.join(_STOPPING_S)
