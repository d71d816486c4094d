"""The programs solved by SCIP, which shares no code with HiGHS: the same objectives."""

from __future__ import annotations

import cvxpy
import pytest

from rgss.tradeoff import DecisionStatus
from rgss.tradeoff.levels.selection import LevelModel, LevelSelection
from rgss.tradeoff.milp.selection import VariantSelection
from rgss.tradeoff.milp.stage import StageSolution, StageSolver

SOLVERS = {
    "HIGHS": {},
    "SCIP": {
        "scip_params": {"numerics/feastol": 1e-6, "limits/gap": 0.0, "limits/absgap": 0.0, "parallel/maxnthreads": 1}
    },
}


class SecondSolver(StageSolver):
    """Solves the same compiled stages by SCIP."""

    def solve(self, stage):
        problem, selection = self.compiled(stage)
        problem.solve(solver=cvxpy.SCIP, **SOLVERS["SCIP"])
        assert problem.status in ("optimal", "infeasible", "infeasible_or_unbounded")
        if problem.status != "optimal":
            return StageSolution(
                name=stage.name,
                status=DecisionStatus.INFEASIBLE,
                alternative=None,
                objective=None,
                gap=None,
                selection_error=0.0,
            )
        alternative, error = selection.read()
        objective = stage.sign * float(problem.value) / stage.scale
        return StageSolution(
            name=stage.name,
            status=DecisionStatus.OPTIMAL,
            alternative=alternative,
            objective=objective if stage.quantity is None else alternative.measures[stage.quantity],
            gap=0.0,
            selection_error=error,
        )


def selections(problem):
    if problem.levels is None:
        return lambda: VariantSelection.of(problem.alternatives)
    model = LevelModel.of(problem.levels, problem.alternatives, tuple(problem.measures_named))
    return lambda: LevelSelection(model)


@pytest.mark.parametrize("levels", [False, True], ids=["variants", "levels"])
@pytest.mark.parametrize(
    "program", ["additive", "lexicographic", "epsilon_constraint", "tchebycheff", "minimax_regret", "risk"]
)
def test_both_solvers_come_to_the_same(cases, seeded, program, levels):
    optimal = 0
    for seed in range(17):
        problem = cases.random_problem(seeded(f"solver {program} {seed}"), program, levels=levels)
        answers = []
        for kind in (StageSolver, SecondSolver):
            solver = kind(select=selections(problem), constraints=problem.constraints)
            answers.append(problem.program.solve(problem, solver))
        first, second = answers
        assert [solution.status for solution in first] == [solution.status for solution in second]
        if first[-1].objective is None:
            assert second[-1].objective is None
            continue
        optimal += 1
        for one, other in zip(first, second, strict=True):
            assert one.objective == pytest.approx(other.objective, rel=1e-6, abs=1e-6)
    assert optimal
