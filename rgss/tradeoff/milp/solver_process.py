"""Separate process for a solver, so that a run that does not return can be killed.

HiGHS 1.15.1 does not check its limits in some loops: its presolve loops forever removing doubleton equations on a
program of 88 rows (benchmarks/tradeoff_guard_cases.py, level_case(1020)), whatever `time_limit` is; see
ERGO-Code/HiGHS#1278 and #2226, both open.
"""

from __future__ import annotations

import contextlib
import math
import os
import signal
import subprocess
import sys
from collections.abc import Mapping
from dataclasses import dataclass
from multiprocessing import Pipe
from multiprocessing.connection import Connection
from types import TracebackType
from typing import Any

from rgss.errors import TradeoffError

STARTING_S = 120.0
"""So long the process may take to start: it imports NumPy's C library and little else."""

MORE_TIME = "allow more time: rgss trade --time-limit"

WORKER = "rgss.tradeoff.milp.solver_worker"
"""The module whose `serve` answers."""


@dataclass(frozen=True, slots=True, kw_only=True)
class RunLimit:
    """Limit of a run; infinite for none.

    Attributes:
        processor_s: Seconds of processor time, after which the kernel ends the process.
        wall_s: Seconds by the clock, after which the parent ends it.
    """

    processor_s: float = math.inf
    wall_s: float = math.inf


class SolverLimitError(TradeoffError):
    """A run was ended because it exceeded its limit; it proved nothing."""


class SolverProcess:
    """Persistent worker process for solver runs, replaced after it had to be killed; a context manager.

    It is started by the first run, in a session of its own, without multiprocessing, because daemonic workers may
    have no such children. It ends with this object, and with the parent however that ends.

    Args:
        worker: The module whose function `serve` answers the requests.
    """

    def __init__(self, worker: str = WORKER) -> None:
        self._worker = worker
        self._process: subprocess.Popen[bytes] | None = None
        self._connection: Connection | None = None

    def __enter__(self) -> SolverProcess:
        """Start nothing yet."""
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """End the process."""
        self.close()

    def solve(self, request: Mapping[str, Any], *, limit: RunLimit) -> dict[str, Any]:
        """Solve a program.

        Args:
            request: The solver, its options and the program's arrays.
            limit: Limit of the run.

        Returns:
            What the solver answered.

        Raises:
            SolverLimitError: The run exceeded its limit.
            TradeoffError: The solver failed, or its process ended.
        """
        connection = self._connected()
        error, answer = self._answer(
            connection, {**request, "processor_s": limit.processor_s, "wall_s": limit.wall_s}, limit
        )
        if error is not None:
            raise TradeoffError(f"the solver failed: {error}", hint="check that highspy is installed: pip install rgss")
        return dict(answer)

    def close(self) -> None:
        """Kill the process and its children, if any."""
        if self._connection is not None:
            self._connection.close()
            self._connection = None
        if self._process is not None:
            with contextlib.suppress(ProcessLookupError):
                os.killpg(self._process.pid, signal.SIGKILL)
            self._process.wait()
            self._process = None

    @property
    def pid(self) -> int | None:
        """Process id; None without a process."""
        return None if self._process is None else self._process.pid

    def _connected(self) -> Connection:
        """The parent's end of the pipe to a process that is ready."""
        if self._connection is not None:
            return self._connection
        ours, theirs = Pipe()
        self._connection = ours
        # The path is given on, because a process that is not forked does not inherit what was added to it.
        code = f"import sys; sys.path[:] = {sys.path!r}; from {self._worker} import serve; serve({theirs.fileno()})"
        try:
            self._process = subprocess.Popen(  # noqa: S603 - this interpreter
                [sys.executable, "-c", code],
                stdin=subprocess.DEVNULL,
                stdout=subprocess.DEVNULL,
                stderr=subprocess.DEVNULL,
                pass_fds=[theirs.fileno()],
                start_new_session=True,
            )
        except OSError as error:
            self.close()
            raise TradeoffError(
                f"the process of the solver was not started: {error.strerror}", hint="look for free memory"
            ) from None
        finally:
            theirs.close()
        self._answer(ours, None, RunLimit(wall_s=STARTING_S))
        return ours

    def _answer(self, connection: Connection, request: Mapping[str, Any] | None, limit: RunLimit) -> tuple[Any, Any]:
        """Send a request, if there is one, and wait for the answer; without one the process is killed."""
        try:
            if request is not None:
                connection.send(request)
            in_time = connection.poll(limit.wall_s if math.isfinite(limit.wall_s) else None)
            answer = connection.recv() if in_time else None
        except (EOFError, OSError):
            raise self._ended(limit) from None
        except BaseException:
            self.close()
            raise
        if answer is None:
            self.close()
            raise SolverLimitError(f"the solver was ended after {limit.wall_s:.3g} s", hint=MORE_TIME)
        return tuple(answer)

    def _ended(self, limit: RunLimit) -> TradeoffError:
        """The error of a process that closed its end of the pipe, which it only does by ending."""
        process = self._process
        status = None
        if process is not None:
            with contextlib.suppress(subprocess.TimeoutExpired):
                status = process.wait(timeout=STARTING_S)
        self.close()
        if status == -signal.SIGPROF:
            return SolverLimitError(
                f"the solver was ended after {limit.processor_s:.3g} s of processor time", hint=MORE_TIME
            )
        return TradeoffError(
            f"the process of the solver ended by itself with the status {status}",
            hint="look for free memory; only a proven optimum is accepted",
        )
