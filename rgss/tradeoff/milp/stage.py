"""One mixed-integer program after another: compiled, solved by HiGHS, accepted only when proven."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

from rgss.errors import TradeoffError
from rgss.tradeoff.milp.checks import Check
from rgss.tradeoff.milp.selection import Selection
from rgss.tradeoff.milp.status import DecisionStatus
from rgss.tradeoff.milp.terms import Constraint, ObjectiveTerm, compile_constraint
from rgss.tradeoff.problem import Alternative

OBJECTIVE_SCALE = 1e3
"""Values from 0 to 1 are scaled by it in the solver, so that its tolerances lie far below a tie's."""


@dataclass(frozen=True, slots=True, kw_only=True)
class SolverRun:
    """A solver with a named set of options.

    Attributes:
        name: The name, as certificates give it.
        options: The options.
        solver: The solver, as CVXPY names it.
    """

    name: str
    options: Mapping[str, Any] = field(hash=False)
    solver: str = "HIGHS"


_COMMON = {
    # HiGHS stops by default within 1e-4 of the optimum; here the optimum itself is needed.
    "mip_rel_gap": 0.0,
    "mip_abs_gap": 0.0,
    # Below 1e-6 HiGHS 1.15 proves wrong bounds: benchmarks/tradeoff_guard.py measures it.
    "mip_feasibility_tolerance": 1e-6,
    "primal_feasibility_tolerance": 1e-7,
    "dual_feasibility_tolerance": 1e-7,
    # One thread, so that the same program gives the same answer on every machine.
    "threads": 1,
    # A count of nodes, not of seconds: the same answer on every machine.
    "mip_max_nodes": 200_000,
}

FIRST_RUN = SolverRun(name="HiGHS without presolve", options={**_COMMON, "presolve": "off"})
"""The presolve of HiGHS calls some feasible mixed-integer programs infeasible (among others
ERGO-Code/HiGHS#3090), so the first run leaves it off."""

SECOND_RUN = SolverRun(
    name="HiGHS with presolve and another seed", options={**_COMMON, "presolve": "on", "random_seed": 7}
)
"""Another path through the same solver: other rows, other cuts, other branching."""

THIRD_RUN = SolverRun(
    name="HiGHS without heuristics and restarts",
    options={
        **_COMMON,
        "presolve": "off",
        "random_seed": 42,
        "mip_heuristic_effort": 0.0,
        "mip_allow_restart": False,
    },
)
"""Used where the first two do not agree."""

RUNS = (FIRST_RUN, SECOND_RUN, THIRD_RUN)


@dataclass(frozen=True, slots=True, kw_only=True)
class Stage:
    """One program: maximise the sum of the objective terms under all constraints.

    Attributes:
        name: Name of the objective, for people.
        objective: The terms that are summed.
        constraints: The conditions beyond those of the trade-off itself.
        scale: Factor of the objective in the solver.
        sign: -1 where people read the objective with the other sign, for it is minimised.
        quantity: The measure whose quantity people read in place of the objective, which is then
            only its rank.
    """

    name: str
    objective: tuple[ObjectiveTerm, ...]
    constraints: tuple[Constraint, ...] = ()
    scale: float = OBJECTIVE_SCALE
    sign: float = 1.0
    quantity: str | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class StageSolution:
    """Answer of the solver.

    Attributes:
        name: The name of the stage.
        status: Optimal, best found or infeasible.
        alternative: The selected alternative; None if infeasible.
        objective: The objective with its reported sign; None if infeasible.
        gap: Distance of the bound proven by the solver from its objective, in the objective's own unit (or ranks); None
        if infeasible.
        selection_error: Integrality error of the solver's variables: the greatest deviation from 0 or 1; 0 if
        infeasible.
        checks: The independent checks of the result.
        exhaustive: True if one of them evaluated every alternative.
        solvers: The solvers with this result, if several were run.
    """

    name: str
    status: DecisionStatus
    alternative: Alternative | None = None
    objective: float | None = None
    gap: float | None = None
    selection_error: float = 0.0
    checks: tuple[Check, ...] = ()
    exhaustive: bool = False
    solvers: tuple[str, ...] = (FIRST_RUN.solver,)

    @property
    def chosen(self) -> Alternative:
        """The selected alternative of an optimal stage."""
        if self.alternative is None:
            raise TradeoffError(f"stage {self.name!r} is infeasible", hint="check its status first")
        return self.alternative


@dataclass(frozen=True, slots=True, kw_only=True)
class StageSolver:
    """Solves stages that share their variables' structure and the trade-off's own constraints.

    Attributes:
        select: Makes new decision variables.
        constraints: The constraints of every stage.
        run: The options of the solver.
        solve_by: Solves a problem with a run; in this process by default.
    """

    select: Callable[[], Selection]
    constraints: tuple[Constraint, ...]
    run: SolverRun = FIRST_RUN
    solve_by: Callable[[Any, SolverRun], bool] | None = None

    def solve(self, stage: Stage) -> StageSolution:
        """Solve a stage to proven optimality or proven infeasibility.

        Raises:
            TradeoffError: The solver is missing, failed, or proved neither.
        """
        problem, selection = self.compiled(stage)
        if not (self.solve_by or solve_program)(problem, self.run):
            return StageSolution(name=stage.name, status=DecisionStatus.INFEASIBLE)
        alternative, error = selection.read()
        objective = stage.sign * float(problem.value) / stage.scale + 0.0
        return StageSolution(
            name=stage.name,
            status=DecisionStatus.OPTIMAL,
            alternative=alternative,
            objective=objective if stage.quantity is None else alternative.measures[stage.quantity],
            gap=proven_gap(problem) / stage.scale,
            selection_error=error,
        )

    def compiled(self, stage: Stage) -> tuple[Any, Selection]:
        """A stage as a CVXPY problem, and the variables of its selection."""
        import cvxpy

        selection = self.select()
        maximised = sum(term.compile(selection) for term in stage.objective)
        constraints = [compile_constraint(one, selection) for one in (*self.constraints, *stage.constraints)]
        # The structure is read last, because terms may have called for further variables.
        constraints += [constraint for _, constraint in selection.structure]
        return cvxpy.Problem(cvxpy.Maximize(stage.scale * maximised), constraints), selection


def solve_program(problem: Any, run: SolverRun = FIRST_RUN, *, solve: Callable[[], None] | None = None) -> bool:
    """Solve a CVXPY problem.

    Args:
        problem: The problem, whose objective is bounded.
        run: The solver and its options.
        solve: Function that solves the problem with that run; by default in this process.

    Returns:
        True if an optimum is proven, False if infeasibility is proven.

    Raises:
        TradeoffError: The solver is missing, failed, or proved neither.
    """
    import cvxpy

    try:
        with warnings.catch_warnings():
            # These two only repeat the status, which is judged below.
            warnings.filterwarnings("ignore", message=r"\s*Solution may be inaccurate")
            warnings.filterwarnings("ignore", message=r"\s*The problem is either infeasible or unbounded")
            if solve is None:
                problem.solve(solver=run.solver, **run.options)
            else:
                solve()
    except cvxpy.SolverError as error:
        raise TradeoffError(
            f"the solver failed: {' '.join(str(error).split())}",
            hint=f"check that {run.name} is installed: pip install 'rgss[scip]'"
            if run.solver == cvxpy.SCIP
            else "check that highspy is installed: pip install 'cvxpy>=1.7' highspy",
        ) from error
    if problem.status == cvxpy.INFEASIBLE:
        return False
    if problem.status == "infeasible_or_unbounded" and run.solver == cvxpy.SCIP:
        # What the presolve of SCIP ends with; the objective is bounded, for it is that of one of finitely many designs.
        return False
    if problem.status != cvxpy.OPTIMAL:
        raise TradeoffError(
            f"the solver ended with the status {problem.status!r}",
            hint="only a proven optimum is accepted; look for measures of extreme magnitude",
        )
    return True


def proven_gap(problem: Any) -> float:
    """Gap between the bound that the solver proved and the objective that it found; 0 if proven best."""
    information = problem.solver_stats.extra_stats
    if isinstance(information, Mapping):
        if "gap" in information:
            # SCIP in its own process.
            return float(information["gap"])
        # SCIP minimises, and its model outlives the run.
        model = information["model"]
        return max(0.0, float(model.getObjVal()) - float(model.getDualbound()))
    if information is None:
        # SCIP through CVXPY 1.7, the last one for Python 3.10: it ends as optimal within the gap of 0 it is given.
        return 0.0
    return max(0.0, float(information.objective_function_value) - float(information.mip_dual_bound))
