"""Solver runs with a hard time limit: each in its own process, which is ended if the solver ignores its limits."""

from __future__ import annotations

import math
import time
from collections import Counter
from collections.abc import Callable, Mapping
from types import SimpleNamespace, TracebackType
from typing import Any

from rgss.errors import TradeoffError
from rgss.tradeoff.milp.solver_process import RunLimit, SolverLimitError, SolverProcess
from rgss.tradeoff.milp.stage import FIRST_RUN, SolverRun, solve_program

LONGEST_RUN_S = 300.0
"""Processor time that a run may take whose answer is needed. The solver's own limit counts nodes."""

LONGEST_BRIEF_RUN_S = 30.0
"""Processor time of a run that only confirms what is proven, or that is made again where it is needed."""

WALL_FACTOR = 20.0
"""By so much the wall clock may exceed the limit of processor time, on a loaded machine."""


class LimitedRuns:
    """Runner of solver programs in a process that is killed at its time limit; a context manager.

    An exceeded limit gives no result. By default limits are in processor time, independent of the machine's load, and
    each overrun halves the limit of the same run of later stages.

    Args:
        time_limit: Time limit of all runs together in s; each may take half of the rest, or a quarter. None for the
            default limits.
        process: Process of the runs; a new one by default.
        clock: The clock of the time limit, in seconds.

    Raises:
        TradeoffError: The time limit is not positive.
    """

    def __init__(
        self,
        time_limit: float | None = None,
        *,
        process: SolverProcess | None = None,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        if time_limit is not None and not (math.isfinite(time_limit) and time_limit > 0.0):
            raise TradeoffError(
                f"the time limit must be positive, got {time_limit:g} s", hint="give seconds, such as 60"
            )
        self._process = SolverProcess() if process is None else process
        self._clock = clock
        self._end = None if time_limit is None else clock() + time_limit
        self._overruns: Counter[tuple[str, bool]] = Counter()

    def __enter__(self) -> LimitedRuns:
        """Start nothing yet."""
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """End the process."""
        self._process.close()

    def limit_of(self, run: SolverRun, *, brief: bool) -> RunLimit:
        """Limit of the next run; 0 s where the time limit is reached.

        Args:
            run: The run.
            brief: Whether the decision can do without it.
        """
        if self._end is None:
            processor_s = (LONGEST_BRIEF_RUN_S if brief else LONGEST_RUN_S) / 2.0 ** self._overruns[run.name, brief]
            return RunLimit(processor_s=processor_s, wall_s=WALL_FACTOR * processor_s)
        left = max(0.0, self._end - self._clock())
        return RunLimit(processor_s=math.inf, wall_s=left / (4.0 if brief else 2.0))

    def half_over(self) -> Callable[[], bool]:
        """A predicate that holds from when half of the time that is left now is over; never without a time limit."""
        if self._end is None:
            return lambda: False
        now = self._clock()
        half = now + max(0.0, self._end - now) / 2.0
        return lambda: self._clock() >= half

    def solve(self, problem: Any, run: SolverRun = FIRST_RUN, *, brief: bool = False) -> bool:
        """Solve a CVXPY problem with at least one boolean variable; see `solve_program`.

        Args:
            problem: The problem.
            run: The solver and its options.
            brief: Whether the decision can do without the run.

        Raises:
            SolverLimitError: The run exceeded its limit.
            TradeoffError: As for `solve_program`, or the process of the solver ended.
        """
        limit = self.limit_of(run, brief=brief)
        if limit.wall_s <= 0.0:
            raise SolverLimitError("the time limit is reached", hint="allow more time: rgss trade --time-limit")
        try:
            return solve_program(problem, run, solve=lambda: self._solve(problem, run, limit))
        except SolverLimitError:
            self._overruns[run.name, brief] += 1
            raise

    def _solve(self, problem: Any, run: SolverRun, limit: RunLimit) -> None:
        """Solve as `Problem.solve` does, with the solver in the other process."""
        data, chain, inverse = problem.get_problem_data(run.solver, solver_opts=dict(run.options))
        request = highs_request(data) if run.solver == "HIGHS" else {"data": _picklable(data)}
        answer = self._process.solve({**request, "solver": run.solver, "options": dict(run.options)}, limit=limit)
        results = _highs_results(answer, len(data["b"])) if run.solver == "HIGHS" else answer
        problem.unpack_results(results, chain, inverse)


def highs_request(data: Mapping[str, Any]) -> dict[str, Any]:
    """Arrays of a compiled program for HiGHS: minimise c x subject to l <= A x <= u.

    Args:
        data: Data compiled by CVXPY for HiGHS: equations first, then rows A x <= b.
    """
    import numpy as np

    matrix = data["A"].tocsc()
    upper = np.asarray(data["b"], dtype=np.float64)
    equations = data["dims"].zero
    count = matrix.shape[1]
    low, high = data["lower_bounds"], data["upper_bounds"]
    column_lower = np.full(count, -np.inf) if low is None else np.array(low, dtype=np.float64)
    column_upper = np.full(count, np.inf) if high is None else np.array(high, dtype=np.float64)
    boolean = np.array(data["bool_vars_idx"], dtype=np.intp)
    column_lower[boolean] = np.maximum(column_lower[boolean], 0.0)
    column_upper[boolean] = np.minimum(column_upper[boolean], 1.0)
    integer = np.zeros(count, dtype=bool)
    integer[boolean] = True
    integer[np.array(data["int_vars_idx"], dtype=np.intp)] = True
    return {
        "cost": np.asarray(data["c"], dtype=np.float64),
        "row_lower": np.where(np.arange(len(upper)) < equations, upper, -np.inf),
        "row_upper": upper,
        "start": matrix.indptr,
        "index": matrix.indices,
        "value": matrix.data,
        "column_lower": column_lower,
        "column_upper": column_upper,
        "integer": integer.tolist(),
    }


def _picklable(data: Mapping[str, Any]) -> dict[str, Any]:
    """Data that the interface of CVXPY reads, without its own objects that refer to the whole problem."""
    wanted = ("c", "A", "b", "dims", "bool_vars_idx", "int_vars_idx", "lower_bounds", "upper_bounds")
    return {name: data[name] for name in wanted if name in data}


def _highs_results(answer: Mapping[str, Any], rows: int) -> dict[str, Any]:
    """The answer of the worker as the interface of CVXPY to HiGHS reads it."""
    return {
        "model_status": answer["model_status"],
        "run_time": answer["run_time"],
        "info": SimpleNamespace(**answer["information"]),
        "solution": SimpleNamespace(col_value=answer["column_value"], row_dual=[0.0] * rows),
        # Not used; CVXPY turns it into dual values wherever a program is infeasible.
        "dual_ray": (None, None, [0.0] * rows),
    }
