"""Worker process of `SolverProcess`: solves the programs that come through a pipe, until the pipe is closed."""

from __future__ import annotations

import contextlib
import math
import os
import queue
import signal
import threading
from multiprocessing.connection import Connection
from typing import Any

GRACE_S = 10.0
"""So long after its limit by the clock the kernel ends a run that no parent has ended."""

INFORMATION = (
    "objective_function_value",
    "mip_dual_bound",
    "mip_node_count",
    "ipm_iteration_count",
    "crossover_iteration_count",
    "pdlp_iteration_count",
    "qp_iteration_count",
    "simplex_iteration_count",
)
"""Entries of the information of HiGHS that CVXPY and the gap are read from."""


def serve(descriptor: int) -> None:
    """Answer requests one after another.

    A request is a mapping with the solver, its options, the limits in seconds and the program's arrays. An answer is
    a pair: an error text or None, and the solver's results or None.

    Args:
        descriptor: The file descriptor of this end of the pipe.
    """
    # What a solver prints must not reach the terminal, and timers end the process whatever was inherited.
    nowhere = os.open(os.devnull, os.O_RDWR)
    for standard in (0, 1, 2):
        os.dup2(nowhere, standard)
    for ending in (signal.SIGALRM, signal.SIGPROF):
        signal.signal(ending, signal.SIG_DFL)
    connection = Connection(descriptor)
    requests: queue.SimpleQueue[dict[str, Any]] = queue.SimpleQueue()
    threading.Thread(target=_receive, args=(connection, requests), daemon=True).start()
    connection.send((None, None))
    while True:
        request = requests.get()
        # The default action of the kernel needs no interpreter, so that it ends a run that never returns too.
        _set_timer(signal.ITIMER_PROF, request["processor_s"])
        _set_timer(signal.ITIMER_REAL, request["wall_s"] + GRACE_S)
        answer: tuple[str | None, dict[str, Any] | None]
        try:
            answer = (None, solved(request))
        except Exception as error:  # every failure of a solver is an answer
            answer = (f"{type(error).__name__}: {error}", None)
        for timer in (signal.ITIMER_PROF, signal.ITIMER_REAL):
            signal.setitimer(timer, 0.0)
        # The other thread detects that the parent has ended.
        with contextlib.suppress(OSError):
            connection.send(answer)


def _set_timer(timer: int, seconds: float) -> None:
    """Set a kernel timer in s that kills the process; none for infinity."""
    if math.isfinite(seconds):
        signal.setitimer(timer, seconds)


def solved(request: dict[str, Any]) -> dict[str, Any]:
    """Results of a program, as the interface of CVXPY to its solver gives them, in plain values."""
    return _solved_by_highs(request) if request["solver"] == "HIGHS" else _solved_by_scip(request)


def _receive(connection: Connection, requests: queue.SimpleQueue[dict[str, Any]]) -> None:
    """Pass on the requests; end the process when the parent closes the pipe, even during a run."""
    try:
        while True:
            requests.put(connection.recv())
    except (EOFError, OSError):
        os._exit(0)


def _solved_by_highs(request: dict[str, Any]) -> dict[str, Any]:
    """The run by highspy alone: the import of CVXPY takes a second and the run does not need it."""
    import highspy

    model = highspy.HighsModel()
    program = model.lp_
    program.num_col_ = len(request["cost"])
    program.num_row_ = len(request["row_lower"])
    program.offset_ = 0
    program.col_cost_ = request["cost"]
    program.row_lower_ = request["row_lower"]
    program.row_upper_ = request["row_upper"]
    program.a_matrix_.format_ = highspy.MatrixFormat.kColwise
    program.a_matrix_.start_ = request["start"]
    program.a_matrix_.index_ = request["index"]
    program.a_matrix_.value_ = request["value"]
    kinds = (highspy.HighsVarType.kContinuous, highspy.HighsVarType.kInteger)
    program.integrality_ = [kinds[integer] for integer in request["integer"]]
    program.col_lower_ = request["column_lower"]
    program.col_upper_ = request["column_upper"]
    solver = highspy.Highs()
    for name, value in {"log_to_console": False, **request["options"]}.items():
        if solver.setOptionValue(name, value) == highspy.HighsStatus.kError:
            raise ValueError(f"HiGHS has no option {name} = {value}")
    solver.passModel(model)
    solver.run()
    information, solution = solver.getInfo(), solver.getSolution()
    return {
        "model_status": solver.getModelStatus().name,
        "run_time": solver.getRunTime(),
        "information": {name: getattr(information, name) for name in INFORMATION},
        "column_value": list(solution.col_value),
    }


def _solved_by_scip(request: dict[str, Any]) -> dict[str, Any]:
    """Run of SCIP through CVXPY, whose overhead is acceptable for an independent check."""
    from cvxpy.reductions.solvers.conic_solvers.scip_conif import SCIP

    found: dict[str, Any] = SCIP().solve_via_data(
        request["data"], warm_start=False, verbose=False, solver_opts=dict(request["options"])
    )
    model = found.pop("model", None)
    if "primal" in found:
        # SCIP minimises. The interface of CVXPY 1.7, the last one for Python 3.10, keeps no model: there an optimum is
        # one within the gap of 0 that SCIP is given, and any other end has another status.
        found["gap"] = 0.0 if model is None else max(0.0, float(model.getObjVal()) - float(model.getDualbound()))
    return found
