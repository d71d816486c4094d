"""A choice among alternatives by their levels, where runs of the solver are ended."""

from __future__ import annotations

import dataclasses

import pytest

from rgss.errors import TradeoffError
from rgss.tradeoff import Agreement, CheckKind, DecisionStatus, decide
from rgss.tradeoff.milp import RUNS, LimitedRuns, SolverLimitError, solve_program

PROGRAMS = ("additive", "tchebycheff", "lexicographic", "epsilon_constraint", "minimax_regret")


@pytest.fixture
def ended(monkeypatch):
    """Runs over levels that exceed their limit: those with the named options."""

    def make(names):
        def solve(self, problem, run, *, brief):
            if run.name in names:
                raise SolverLimitError("the solver was ended after 30 s of processor time", hint="")
            return solve_program(problem, run)

        monkeypatch.setattr(LimitedRuns, "solve", solve)

    return make


@pytest.mark.parametrize("ends", [1, len(RUNS)])
@pytest.mark.parametrize("program", PROGRAMS)
def test_the_decision_is_the_same_and_the_certificate_names_the_run(cases, seeded, ended, program, ends):
    problem = cases.random_problem(seeded(f"levels {program}"), program, levels=True)
    right = decide(dataclasses.replace(problem, levels=None))
    ended({run.name for run in RUNS[:ends]})
    decision = decide(problem)
    assert (decision.chosen, decision.status) == (right.chosen, right.status)
    assert decision.status in {DecisionStatus.OPTIMAL, DecisionStatus.INFEASIBLE}
    assert decision.certificate.enumeration_agrees is Agreement.AGREED
    (check,) = [check for check in decision.certificate.checks if check.kind is CheckKind.SECOND_RUN]
    assert check.agrees is None
    assert check.text == (
        "second run not finished: an earlier run over levels: the solver was ended after 30 s of processor time"
    )


def test_a_time_limit_that_is_over_decides_by_the_alternatives(cases, seeded):
    """Nothing of the solver is started for levels; the program over alternatives is enumerated as always."""
    problem = cases.random_problem(seeded("levels additive"), "additive", levels=True)
    decision = decide(problem, time_limit=1e-9)
    assert decision.chosen == decide(problem).chosen
    assert "the time limit is reached" in " ".join(check.text for check in decision.certificate.checks)
    with pytest.raises(TradeoffError, match="the time limit must be positive"):
        decide(problem, time_limit=-1.0)
