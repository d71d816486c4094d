"""SCIP as a further opinion beside the runs of HiGHS: plumbing with doubles, and SCIP itself."""

from __future__ import annotations

import sys

import pytest

import rgss.tradeoff.levels.guard
import rgss.tradeoff.levels.problem
from rgss.errors import TradeoffError
from rgss.reports.decision.json import certificate_to_json
from rgss.tradeoff import (
    Agreement,
    CheckKind,
    DecisionStatus,
    SolverCheck,
    decide,
    decide_levels,
    independent_run,
)
from rgss.tradeoff.levels.bound import interval_bound
from rgss.tradeoff.milp.limited_runs import LimitedRuns
from rgss.tradeoff.milp.stage import RUNS

PROGRAMS = ("additive", "tchebycheff", "lexicographic", "epsilon_constraint", "minimax_regret")


@pytest.fixture
def scip():
    return independent_run(SolverCheck.SCIP)


@pytest.fixture
def runs_alone(monkeypatch):
    """Nothing but runs and the search checks a level problem."""
    monkeypatch.setattr(rgss.tradeoff.levels.problem, "LARGEST_ENUMERATED", 0)
    monkeypatch.setattr(
        rgss.tradeoff.levels.guard,
        "interval_bound",
        lambda *rest, **more: interval_bound(*rest, **{**more, "most": 0}),
    )


def opinions(certificate):
    return [check for check in certificate.checks if check.kind is CheckKind.INDEPENDENT_SOLVER]


@pytest.mark.parametrize("program", PROGRAMS)
def test_scip_is_named_where_it_agrees(guard_cases, runs_alone, scip, program):
    case = guard_cases.small_case(1, (3, 4, 3, 4), program)
    decision = decide_levels(case.problem, independent=(scip,))
    assert case.missed_by(decision.variant - 1) <= 1e-9
    assert decision.status is DecisionStatus.OPTIMAL
    assert decision.certificate.solver == "HIGHS and SCIP"
    assert opinions(decision.certificate)
    assert all(check.agrees for check in opinions(decision.certificate))


@pytest.mark.parametrize("program", PROGRAMS)
def test_of_enumerated_designs_too(cases, seeded, scip, program):
    problem = cases.random_problem(seeded(f"independent {program}"), program)
    plain, checked = decide(problem), decide(problem, independent=(scip,))
    assert checked.chosen == plain.chosen
    assert plain.certificate.solver == "HIGHS"
    assert checked.certificate.solver == "HIGHS and SCIP"
    (check,) = opinions(checked.certificate)
    assert check.text == "independent solver agrees: SCIP comes to the same answer"


def test_scip_cuts_off_no_feasible_design(guard_cases, runs_alone, scip):
    """With a tolerance of 1e-9 SCIP proved 2.5 for this problem's first stage, where brute force finds 4."""
    case = guard_cases.level_case(22, largest=1e5)
    decision = decide_levels(case.problem, independent=(scip,))
    assert case.missed_by(decision.variant - 1) <= 1e-9
    assert opinions(decision.certificate)
    assert all(check.agrees for check in opinions(decision.certificate))


def test_without_the_option_nothing_is_different(guard_cases, runs_alone):
    case = guard_cases.small_case(1, (3, 4, 3, 4), "additive")
    certificate = decide_levels(case.problem).certificate
    assert certificate.solver == "HIGHS"
    assert not opinions(certificate)
    assert "independent solver" not in str(certificate_to_json(certificate))


def doctored(monkeypatch, wrong):
    """The named solvers call everything infeasible."""
    real = LimitedRuns.solve
    monkeypatch.setattr(
        LimitedRuns,
        "solve",
        lambda self, problem, run, *, brief: False if run.solver in wrong else real(self, problem, run, brief=brief),
    )


def test_an_opinion_that_is_wrong_is_shown_and_the_proof_stays(guard_cases, runs_alone, monkeypatch, scip):
    doctored(monkeypatch, {"SCIP"})
    case = guard_cases.small_case(1, (3, 4, 3, 4), "additive")
    decision = decide_levels(case.problem, independent=(scip,))
    assert case.missed_by(decision.variant - 1) <= 1e-9
    assert (decision.status, decision.certificate.solver) == (DecisionStatus.OPTIMAL, "HIGHS")
    (check,) = opinions(decision.certificate)
    assert check.text == "independent solver DISAGREES: SCIP: infeasible"


def test_one_opinion_alone_proves_nothing(guard_cases, runs_alone, monkeypatch, scip):
    """HiGHS is wrong in every run; what SCIP comes to is used and called best found."""
    doctored(monkeypatch, {RUNS[0].solver})
    case = guard_cases.small_case(1, (3, 4, 3, 4), "additive")
    decision = decide_levels(case.problem, independent=(scip,))
    assert case.missed_by(decision.variant - 1) <= 1e-9
    assert (decision.status, decision.certificate.solver) == (DecisionStatus.BEST_FOUND, "SCIP")
    assert decision.certificate.enumeration_agrees is Agreement.NOT_ENUMERATED


def test_an_independent_solver_that_gives_no_answer(cases, seeded, monkeypatch, scip):
    import rgss.tradeoff.milp.stage

    real = rgss.tradeoff.milp.stage.solve_program

    def failing(problem, run):
        if run.solver == "SCIP":
            raise TradeoffError("the solver ended with the status 'user_limit'", hint="")
        return real(problem, run)

    monkeypatch.setattr(rgss.tradeoff.milp.stage, "solve_program", failing)
    decision = decide(cases.random_problem(seeded("no answer"), "additive"), independent=(scip,))
    assert decision.certificate.solver == "HIGHS"
    (check,) = opinions(decision.certificate)
    assert check.text == "independent solver DISAGREES: SCIP: the solver ended with the status 'user_limit'"


def test_a_missing_extra_is_one_line(monkeypatch):
    monkeypatch.setitem(sys.modules, "pyscipopt", None)
    with pytest.raises(TradeoffError) as caught:
        independent_run(SolverCheck.SCIP)
    assert str(caught.value) == (
        "the solver check 'scip' needs the package pyscipopt, which is not installed (pip install 'rgss[scip]')"
    )
