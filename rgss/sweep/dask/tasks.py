"""Tasks in a Dask worker, which runs each of them in its own engine process.

Dask workers load these functions by the name of this module; see `engines` for why a task is not
carried out in the Dask worker itself.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from rgss.sweep.dask.engines import Differs, Engines, Order
from rgss.sweep.task_end import Ended

EXTENSION = "rgss"
"""The name of the engine processes in a Dask worker."""


def carry_out(order: Order, key: str, work: bytes) -> Ended:
    """Carry out a task; runs in a thread of a Dask worker.

    Args:
        order: Settings that all tasks of a sweep share.
        key: The task's name.
        work: A function and its arguments, pickled.

    Returns:
        Its end; its result is a `Differs` if the engine process runs other code or engines.

    Raises:
        SimulationError: The engine process cannot start.
    """
    from distributed import get_worker

    dask_worker = get_worker()
    ended = _engines_of(dask_worker).carry_out(order, key, work)
    if isinstance(ended.result, Differs):
        return replace(ended, result=replace(ended.result, where=dask_worker.address))
    return ended


async def inspect(order: Order, work: bytes, dask_worker: Any) -> Ended:
    """Do something in an engine process of a Dask worker without waiting for one of its threads.

    Args:
        order: Settings that all tasks of a sweep share.
        work: A function and its arguments, pickled.
        dask_worker: The Dask worker, which Dask itself gives.

    Raises:
        SimulationError: The engine process cannot start.
    """
    import asyncio

    return await asyncio.to_thread(_engines_of(dask_worker).carry_out, order, "", work)


def stop(order: str, dask_worker: Any) -> None:
    """Stop the tasks of an order on a Dask worker, and end its engine processes.

    Args:
        order: The order's name.
        dask_worker: The Dask worker, which Dask itself gives.
    """
    _engines_of(dask_worker).stop(order)


def _engines_of(dask_worker: Any) -> Engines:
    """The engine processes of a Dask worker, which ends them when it ends itself."""
    engines = dask_worker.extensions.setdefault(EXTENSION, Engines())
    assert isinstance(engines, Engines)  # noqa: S101 - the name is ours alone
    return engines
