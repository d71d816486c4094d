"""Mixed-integer programs: terms, selections, stages, solver runs and their checks."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.tradeoff.milp.checks import Agreement, Check, CheckKind
    from rgss.tradeoff.milp.independent_solver import SolverCheck, independent_run
    from rgss.tradeoff.milp.limited_runs import LimitedRuns
    from rgss.tradeoff.milp.linear import SOLVER_TOLERANCE, rerun_solver, solve_linear, variable_ranges
    from rgss.tradeoff.milp.selection import INTEGRALITY_TOLERANCE, Row, VariantSelection, read_choice
    from rgss.tradeoff.milp.solver_process import SolverLimitError, SolverProcess
    from rgss.tradeoff.milp.stage import (
        FIRST_RUN,
        OBJECTIVE_SCALE,
        RUNS,
        SolverRun,
        Stage,
        StageSolution,
        StageSolver,
        proven_gap,
        solve_program,
    )
    from rgss.tradeoff.milp.status import DecisionStatus
    from rgss.tradeoff.milp.sums import LinearQuantity
    from rgss.tradeoff.milp.terms import (
        Constraint,
        EvidenceConstraint,
        Exclusion,
        ObjectiveTerm,
        QuantityRank,
        WeightedValue,
        WorstOf,
    )
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
