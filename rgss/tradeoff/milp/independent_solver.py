"""SCIP as an independent solver: the same programs solved by code that HiGHS has no part in."""

from __future__ import annotations

import importlib
from enum import Enum

from rgss.errors import TradeoffError
from rgss.tradeoff.milp.stage import SolverRun

SCIP_RUN = SolverRun(
    name="SCIP",
    solver="SCIP",
    options={
        "scip_params": {
            # Not smaller: at 1e-9, which is SCIP's epsilon, its presolve cuts off feasible designs.
            "numerics/feastol": 1e-6,
            "limits/gap": 0.0,
            "limits/absgap": 0.0,
            "parallel/maxnthreads": 1,
            # A count of nodes, as for HiGHS: the same answer on every machine.
            "limits/nodes": 200_000,
        }
    },
)
"""The options of SCIP: no gap is accepted, and the limit counts nodes."""


class SolverCheck(str, Enum):
    """Solver that checks the answers of HiGHS when it is requested."""

    SCIP = "scip"


def independent_run(check: SolverCheck) -> SolverRun:
    """The run of an independent solver.

    Raises:
        TradeoffError: The solver is not installed.
    """
    try:
        importlib.import_module("pyscipopt")
    except ImportError:
        raise TradeoffError(
            f"the solver check {check.value!r} needs the package pyscipopt, which is not installed",
            hint="pip install 'rgss[scip]'",
        ) from None
    return SCIP_RUN
