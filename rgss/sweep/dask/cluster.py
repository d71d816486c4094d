"""Dask cluster on which sweeps may run: found and compared with this machine before the first task."""

from __future__ import annotations

import asyncio
import contextlib
import logging
import pickle
import uuid
import warnings
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from typing import Any

from rgss.errors import DefinitionError, SimulationError
from rgss.evidence import RunFailureKind
from rgss.evidence.records import machine
from rgss.sweep.dask.engines import Differs, Order
from rgss.sweep.dask.process_environment import are_alike, environment
from rgss.sweep.dask.tasks import inspect
from rgss.sweep.dask.workers import WITHOUT_WORKERS_S, DaskWorkers, stop_all
from rgss.sweep.task_end import Ended

_PATIENCE_S = 10.0
_ALIKE = "every worker needs the same engines and the same rgss"
_CODE = "rgss-"


class DaskCluster:
    """Dask cluster with workers verified to run the code and engines of this process."""

    def __init__(self, client: Any, order: Order, *, address: str, machine: str) -> None:
        """Record its address and its state.

        Args:
            client: A client of the cluster.
            order: Settings that all tasks of a sweep share.
            address: The scheduler's address, for messages.
            machine: The machines that its workers run on, in one line.
        """
        self._client = client
        self._order = order
        self._address = address
        self.machine = machine

    def workers(self, function: Callable[..., Any], *, without_workers_s: float = WITHOUT_WORKERS_S) -> DaskWorkers:
        """Workers for one sweep; engines that they load are kept for the next.

        Args:
            function: Function of a module that makes a result from a task's arguments.
            without_workers_s: Longest time without any worker during the sweep.

        Raises:
            SimulationError: The scheduler has stopped.
        """
        return DaskWorkers(
            self._client,
            function,
            self._order,
            address=self._address,
            differs=lambda differs: difference(differs, self._order.environment),
            without_workers_s=without_workers_s,
        )


@contextmanager
def dask_cluster(
    address: str, *, time_limit_s: float, memory_limit_bytes: int, patience_s: float = _PATIENCE_S
) -> Iterator[DaskCluster]:
    """A cluster that already runs, for as long as the block lasts; no process of ours stays on it.

    Args:
        address: The scheduler's address, such as ``tcp://head:8786``.
        time_limit_s: Greatest time of a task by the wall clock, from its beginning in its process.
        memory_limit_bytes: Greatest size of an engine process's data; 0 for no limit.
        patience_s: Longest wait for the scheduler, and then for its first worker.

    Raises:
        DefinitionError: Dask is not installed, no scheduler answers, certificates are missing, it has no
            workers, or one of them runs other code or engines than this process.
        SimulationError: An engine process cannot start there, or the scheduler has stopped.
    """
    try:
        import distributed
    except ImportError as error:
        raise DefinitionError(
            "--dask needs the package distributed, which is not installed", hint="pip install 'rgss[dask]'"
        ) from error
    with _quiet():
        # Certificates are in Dask's settings, if the address requires them.
        security = distributed.Security()
        if address.startswith("tls://") and not security.get_connection_args("client").get("ssl_context"):
            raise DefinitionError(
                f"{address} uses TLS, but Dask's settings name no certificates for a client",
                hint="set distributed.comm.tls.ca-file, client.cert and client.key, as docs/scale-out.md shows",
            )
        try:
            _check_address(address)
            client = distributed.Client(
                address, timeout=patience_s, security=security, set_as_default=False, name="rgss"
            )
        except (OSError, ValueError, TypeError) as error:
            raise DefinitionError(
                f"no Dask scheduler answers at {address}",
                hint="start one with 'dask scheduler', or correct the address",
            ) from error
        try:
            order = Order(
                name=uuid.uuid4().hex,
                environment=environment(),
                time_limit_s=time_limit_s,
                memory_limit_bytes=memory_limit_bytes,
            )
            # To Python 3.10, the time-out of asyncio is none of its own.
            with contextlib.suppress(TimeoutError, asyncio.TimeoutError):
                client.wait_for_workers(1, timeout=patience_s)
            try:
                yield DaskCluster(client, order, address=address, machine=_inspected(client, address, order))
            finally:
                stop_all(client, order)
        finally:
            with contextlib.suppress(Exception):
                client.close(timeout=1.0)


def _check_address(address: str) -> None:
    """Check an address before a client is made of it, which would complain of itself when it is dropped.

    Raises:
        ValueError: It is empty, or of a kind that Dask does not have.
    """
    from distributed.comm.addressing import parse_address
    from distributed.comm.registry import get_backend

    if not address.strip():
        raise ValueError("no address")
    get_backend(parse_address(address)[0])


def difference(differs: Differs, here: Mapping[str, str]) -> str:
    """Difference of a Dask worker from this process, in one line.

    Args:
        differs: Code and engines of the worker.
        here: Code and engines of this process.
    """
    who = f"the Dask worker {differs.where}"
    if differs.why:
        return f"{who} cannot run trials: {differs.why}"
    names = [name for name in here if not are_alike({name: differs.found.get(name, "")}, {name: here[name]})]
    code = [name.removeprefix(_CODE) for name in names if name.startswith(_CODE)]
    parts = [
        f"{name} {differs.found.get(name, 'nothing')} instead of {here[name]}"
        for name in names
        if not name.startswith(_CODE)
    ]
    if code:
        parts.append(f"other code of rgss ({', '.join(code)})")
    return f"{who} would make other records: it has {', '.join(parts)}"


def _inspected(client: Any, address: str, order: Order) -> str:
    """Hold every worker against this process; returns the machines that they run on."""
    try:
        answers = client.run(inspect, order, pickle.dumps((machine, ())), on_error="return")
    except OSError as error:
        raise SimulationError(f"the Dask scheduler at {address} has stopped") from error
    if not answers:
        raise DefinitionError(
            f"the Dask cluster at {address} has no workers",
            hint=f"start some, such as 'dask worker {address} --nthreads 1'",
        )
    # A worker that is lost meanwhile runs nothing either; the others take over, if there are any.
    heard = {where: answer for where, answer in answers.items() if not isinstance(answer, OSError)} or answers
    machines = {_machine_of(where, answer, order.environment) for where, answer in heard.items()}
    return "; ".join(sorted(machines - {""}))


def _machine_of(where: str, answer: object, expected: Mapping[str, str]) -> str:
    if isinstance(answer, SimulationError):
        raise answer
    # Dask wraps what it cannot send as it is.
    if isinstance(answer, ImportError) or "ModuleNotFoundError" in str(answer):
        missing = " ".join(str(answer).split())
        raise DefinitionError(f"the Dask worker {where} has no rgss that can be used: {missing}", hint=_ALIKE)
    if isinstance(answer, Ended) and answer.failure is None:
        if isinstance(answer.result, Differs):
            found = Differs(found=answer.result.found, why=answer.result.why, where=where)
            raise DefinitionError(difference(found, expected), hint=_ALIKE)
        return str(answer.result)
    if isinstance(answer, Ended) and answer.failure and answer.failure.kind is RunFailureKind.TIMED_OUT:
        # A limit that is too short even for this is too short for every task, which then reports it.
        return ""
    why = (
        answer.failure.detail if isinstance(answer, Ended) and answer.failure else f"{type(answer).__name__}: {answer}"
    )
    raise DefinitionError(f"the Dask worker {where} cannot run trials: {' '.join(why.split())}", hint=_ALIKE)


@contextmanager
def _quiet() -> Iterator[None]:
    """Silence Dask's output on standard error; our messages report what is relevant."""
    # Dask's settings give loggers below this one levels of their own.
    names = [name for name in logging.root.manager.loggerDict if name.startswith("distributed.")]
    loggers = [logging.getLogger(name) for name in ("distributed", *names)]
    before = [logger.level for logger in loggers]
    for logger in loggers:
        logger.setLevel(logging.CRITICAL + 1)
    try:
        with warnings.catch_warnings():
            # Versions are compared by us, the scheduler's alone left out.
            warnings.filterwarnings("ignore", module=r"distributed\.")
            yield
    finally:
        for logger, level in zip(loggers, before, strict=True):
            logger.setLevel(level)
