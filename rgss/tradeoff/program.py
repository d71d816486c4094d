"""The mixed-integer choice: terms put together, solved by HiGHS, accepted only when proven."""

from __future__ import annotations

import warnings
from dataclasses import dataclass

from rgss.errors import TradeoffError
from rgss.tradeoff.problem import Alternative, TradeProblem
from rgss.tradeoff.status import DecisionStatus
from rgss.tradeoff.terms import (
    ChooseOne,
    ConstraintTerm,
    EvidenceConstraint,
    ObjectiveTerm,
    Selection,
    ThresholdConstraint,
    WeightedValue,
)

OBJECTIVE_SCALE = 1e3
"""Values from 0 to 1 are scaled by it in the solver, so that its tolerances lie far below a tie's."""

INTEGRALITY_TOLERANCE = 1e-6
"""How far a boolean variable may be from 0 or 1 in an answer that is accepted."""

# HiGHS stops by default within 1e-4 of the optimum; here the optimum itself is wanted.
_HIGHS_OPTIONS = {
    "mip_rel_gap": 0.0,
    "mip_abs_gap": 0.0,
    "mip_feasibility_tolerance": 1e-10,
    "primal_feasibility_tolerance": 1e-10,
    "dual_feasibility_tolerance": 1e-10,
}


@dataclass(frozen=True, slots=True, kw_only=True)
class Solution:
    """What the solver answered.

    Attributes:
        status: Optimal or infeasible.
        variant: The selected alternative; None if infeasible.
        objective: Its value as the solver has it; None if infeasible.
        selection_error: How far the solver's variables are from selecting exactly that
            alternative: the largest difference from 0 or 1; 0 if infeasible.
    """

    status: DecisionStatus
    variant: int | None
    objective: float | None
    selection_error: float


@dataclass(frozen=True, slots=True, kw_only=True)
class Program:
    """Maximise the sum of the objective terms under all constraints.

    Attributes:
        alternatives: What can be selected.
        objective: The terms that are summed.
        constraints: The conditions; one of them must say how many are selected.
    """

    alternatives: tuple[Alternative, ...]
    objective: tuple[ObjectiveTerm, ...]
    constraints: tuple[ConstraintTerm, ...]

    def solve(self) -> Solution:
        """Solve the program to proven optimality or proven infeasibility.

        Returns:
            The solver's answer.

        Raises:
            TradeoffError: The solver is missing, failed, or proved neither.
        """
        import cvxpy

        selection = Selection(
            alternatives=self.alternatives, variable=cvxpy.Variable(len(self.alternatives), boolean=True)
        )
        objective = sum(term.compile(selection) for term in self.objective)
        problem = cvxpy.Problem(
            cvxpy.Maximize(OBJECTIVE_SCALE * objective), [term.compile(selection) for term in self.constraints]
        )
        try:
            with warnings.catch_warnings():
                # These two only repeat the status, which is judged below.
                warnings.filterwarnings("ignore", message=r"\s*Solution may be inaccurate")
                warnings.filterwarnings("ignore", message=r"\s*The problem is either infeasible or unbounded")
                problem.solve(solver=cvxpy.HIGHS, **_HIGHS_OPTIONS)
        except cvxpy.SolverError as error:
            raise TradeoffError(
                f"the solver failed: {' '.join(str(error).split())}",
                hint="check that highspy is installed: pip install 'cvxpy>=1.7' highspy",
            ) from error
        if problem.status == cvxpy.INFEASIBLE:
            return Solution(status=DecisionStatus.INFEASIBLE, variant=None, objective=None, selection_error=0.0)
        if problem.status != cvxpy.OPTIMAL:
            raise TradeoffError(
                f"the solver ended with the status {problem.status!r}",
                hint="only a proven optimum is accepted; look for measures of extreme magnitude",
            )
        return self._read([float(entry) for entry in selection.variable.value], float(problem.value))

    def _read(self, selected: list[float], scaled_objective: float) -> Solution:
        index = max(range(len(selected)), key=selected.__getitem__)
        selection_error = max(abs(entry - float(at == index)) for at, entry in enumerate(selected))
        if selection_error > INTEGRALITY_TOLERANCE:
            raise TradeoffError(
                f"the solver's answer selects no single alternative (off by {selection_error:.3g})",
                hint="the answer is not used; look for measures of extreme magnitude",
            )
        return Solution(
            status=DecisionStatus.OPTIMAL,
            variant=self.alternatives[index].variant,
            objective=scaled_objective / OBJECTIVE_SCALE,
            selection_error=selection_error,
        )


def choice_program(problem: TradeProblem, alternatives: tuple[Alternative, ...]) -> Program:
    """The program that chooses one alternative by weighted additive value under the thresholds.

    Args:
        problem: The trade-off.
        alternatives: Those of its alternatives that are left after an exact reduction.

    Returns:
        The program, ready to be solved.
    """
    weights = problem.weighting.weights
    return Program(
        alternatives=alternatives,
        objective=tuple(
            WeightedValue(function=problem.value_function(measure), weight=weights[measure])
            for measure in problem.weighting.deciding_measures
        ),
        constraints=(
            ChooseOne(),
            *(ThresholdConstraint(threshold=threshold) for threshold in problem.thresholds),
            *(EvidenceConstraint(measure=measure) for measure in problem.evidence_measures),
        ),
    )
