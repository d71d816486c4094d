"""Answers of the solver over levels that are wrong, by themselves or made so, and what checks them."""

from __future__ import annotations

import cvxpy
import numpy as np
import pytest

import rgss.tradeoff.levels.guard
import rgss.tradeoff.levels.problem
import rgss.tradeoff.levels.selection
from rgss.errors import TradeoffError
from rgss.reports.decision.json import certificate_to_json
from rgss.tradeoff import Agreement, CheckKind, DecisionStatus, decide_levels
from rgss.tradeoff.levels.attempt import Attempt, Outcome
from rgss.tradeoff.levels.bound import interval_bound
from rgss.tradeoff.levels.grid import LevelGrid, compensated_sum
from rgss.tradeoff.levels.guard import GuardedStageSolver
from rgss.tradeoff.levels.search import search_levels
from rgss.tradeoff.levels.selection import LevelModel, LevelSelection
from rgss.tradeoff.milp.limited_runs import LimitedRuns
from rgss.tradeoff.milp.solver_process import SolverLimitError
from rgss.tradeoff.milp.stage import FIRST_RUN, RUNS, SolverRun, StageSolver, solve_program
from rgss.tradeoff.programs.additive import additive_stage

PROGRAMS = ("additive", "tchebycheff", "lexicographic", "epsilon_constraint", "minimax_regret")

OLD_RUN = SolverRun(
    name="old",
    options={
        **FIRST_RUN.options,
        "mip_feasibility_tolerance": 1e-10,
        "primal_feasibility_tolerance": 1e-10,
        "dual_feasibility_tolerance": 1e-10,
    },
)

PINNED = [2, 4, 11, 16]
"""Five factors of four levels that HiGHS 1.15.1 gets wrong with tolerances of 1e-10: infeasible, and not the best."""


@pytest.fixture
def sums_kept(monkeypatch):
    """Measures stay sums of tables, as they are where there are too many combinations to merge them."""
    monkeypatch.setattr(rgss.tradeoff.levels.selection, "LARGEST_TABLE", 100)


@pytest.fixture
def path(monkeypatch):
    """Which checks can be made: of all combinations, of bounds, or of runs and a search alone."""

    def choose(name):
        if name != "enumerated":
            monkeypatch.setattr(rgss.tradeoff.levels.problem, "LARGEST_ENUMERATED", 0)
        if name == "runs":
            monkeypatch.setattr(
                rgss.tradeoff.levels.guard,
                "interval_bound",
                lambda *rest, **more: interval_bound(*rest, **{**more, "most": 0}),
            )

    return choose


def pinned_case(guard_cases, seed):
    return guard_cases.small_case(seed, (4,) * 5, "additive" if seed % 2 == 0 else "tchebycheff")


@pytest.mark.parametrize("run", RUNS, ids=lambda run: run.name)
@pytest.mark.parametrize("seed", PINNED)
def test_the_options_of_the_solver(guard_cases, sums_kept, seed, run):
    case = pinned_case(guard_cases, seed)
    problem = case.problem
    model = LevelModel(
        space=problem.space,
        quantities=problem.tables,
        replicates={},
        alternative_of=problem.alternative,
        levels_of=problem.levels_of,
    )
    solver = StageSolver(select=lambda: LevelSelection(model), constraints=problem.constraints, run=run)
    assert case.missed_by(problem.program.solve(problem, solver)[-1].chosen.variant - 1) <= 1e-9


@pytest.mark.parametrize("name", ["enumerated", "bounds", "runs"])
@pytest.mark.parametrize("seed", PINNED)
def test_the_guard_repairs_what_the_old_options_get_wrong(guard_cases, sums_kept, monkeypatch, path, seed, name):
    path(name)
    monkeypatch.setattr(rgss.tradeoff.levels.guard, "RUNS", (OLD_RUN,) * 3)
    case = pinned_case(guard_cases, seed)
    decision = decide_levels(case.problem)
    assert case.missed_by(decision.variant - 1) <= 1e-9
    if name == "bounds":
        assert decision.status is DecisionStatus.OPTIMAL


def false_infeasible(problem, run):
    return False


def any_point(problem, run):
    """A feasible design, but not the best: nothing is maximised. Its bound is said to be reached."""
    feasible = cvxpy.Problem(cvxpy.Maximize(0.0), problem.constraints)
    feasible.solve(solver=cvxpy.HIGHS, **FIRST_RUN.options)
    problem._value = 0.0
    return feasible.status == cvxpy.OPTIMAL


def no_answer(problem, run):
    raise TradeoffError("the solver ended with the status 'user_limit'", hint="")


def exceeded(problem, run):
    raise SolverLimitError("the solver was ended after 30 s of processor time", hint="")


@pytest.fixture
def doctored(monkeypatch):
    """A solver whose first runs, or all of them, give another answer."""

    def make(answer, *, runs):
        wrong = {run.name for run in RUNS[:runs]}
        gap = rgss.tradeoff.levels.guard.proven_gap
        monkeypatch.setattr(
            LimitedRuns,
            "solve",
            lambda self, problem, run, *, brief: (
                answer(problem, run) if run.name in wrong else solve_program(problem, run)
            ),
        )
        monkeypatch.setattr(
            rgss.tradeoff.levels.guard, "proven_gap", lambda problem: gap(problem) if problem.solver_stats else 0.0
        )

    return make


@pytest.mark.parametrize("name", ["enumerated", "bounds", "runs"])
@pytest.mark.parametrize("program", PROGRAMS)
def test_right_answers_are_right_by_each_check(guard_cases, sums_kept, path, program, name):
    case = guard_cases.small_case(1, (3, 4, 3, 4), program)
    path(name)
    assert case.missed_by(decide_levels(case.problem).variant - 1) <= 1e-9


@pytest.mark.parametrize("answer", [false_infeasible, any_point, no_answer], ids=lambda answer: answer.__name__)
@pytest.mark.parametrize("name", ["enumerated", "bounds", "runs"])
@pytest.mark.parametrize("program", PROGRAMS)
def test_a_wrong_answer_in_every_run_is_caught(guard_cases, sums_kept, path, doctored, program, name, answer):
    case = guard_cases.small_case(1, (3, 4, 3, 4), program)
    path(name)
    doctored(answer, runs=len(RUNS))
    decision = decide_levels(case.problem)
    certificate = decision.certificate
    assert case.missed_by(decision.variant - 1) <= 1e-9
    assert any(not check.agrees for check in certificate.checks)
    expected = {
        "enumerated": (DecisionStatus.OPTIMAL, Agreement.DISAGREED),
        "bounds": (DecisionStatus.OPTIMAL, Agreement.NOT_ENUMERATED),
        "runs": (DecisionStatus.BEST_FOUND, Agreement.NOT_ENUMERATED),
    }[name]
    assert (decision.status, certificate.enumeration_agrees) == expected
    assert (certificate.gap > 0.0) == (name == "runs")
    assert not certificate.enumeration_agrees


@pytest.mark.parametrize("answer", [false_infeasible, any_point], ids=lambda answer: answer.__name__)
@pytest.mark.parametrize("program", PROGRAMS)
def test_a_wrong_first_run_is_outvoted(guard_cases, sums_kept, path, doctored, program, answer):
    """Where neither enumeration nor bounds prove it, two other runs do."""
    case = guard_cases.small_case(1, (3, 4, 3, 4), program)
    path("runs")
    doctored(answer, runs=1)
    decision = decide_levels(case.problem)
    assert case.missed_by(decision.variant - 1) <= 1e-9
    assert decision.status is DecisionStatus.OPTIMAL
    assert {check.kind for check in decision.certificate.checks if not check.agrees} >= {CheckKind.SECOND_RUN}


@pytest.mark.parametrize("name", ["enumerated", "bounds", "runs"])
@pytest.mark.parametrize("program", PROGRAMS)
def test_runs_that_are_ended_agree_with_nothing(guard_cases, sums_kept, path, doctored, program, name):
    """What is proven without the solver stays proven; elsewhere the best that is known has its gap."""
    case = guard_cases.small_case(1, (3, 4, 3, 4), program)
    path(name)
    doctored(exceeded, runs=len(RUNS))
    decision = decide_levels(case.problem)
    certificate = decision.certificate
    assert case.missed_by(decision.variant - 1) <= 1e-9
    assert (decision.status, certificate.enumeration_agrees) == {
        "enumerated": (DecisionStatus.OPTIMAL, Agreement.NOT_COMPARED),
        "bounds": (DecisionStatus.OPTIMAL, Agreement.NOT_ENUMERATED),
        "runs": (DecisionStatus.BEST_FOUND, Agreement.NOT_ENUMERATED),
    }[name]
    assert (certificate.gap > 0.0) == (name == "runs")
    assert None in {check.agrees for check in certificate.checks}
    assert False not in {check.agrees for check in certificate.checks}
    assert any("not finished" in check.text for check in certificate.checks)
    assert not certificate.enumeration_agrees


@pytest.mark.parametrize("name", ["enumerated", "runs"])
def test_one_run_that_is_ended_is_replaced_by_another(guard_cases, sums_kept, path, doctored, name):
    path(name)
    doctored(exceeded, runs=1)
    decision = decide_levels(guard_cases.small_case(1, (3, 4, 3, 4), "additive").problem)
    assert decision.status is DecisionStatus.OPTIMAL
    text = " ".join(check.text for check in decision.certificate.checks)
    assert ("1 run exceeded the limit" if name == "enumerated" else "HiGHS without presolve: not finished") in text


def test_a_run_that_is_needed_gets_more_time(guard_cases, sums_kept, path, monkeypatch):
    """Where nothing else proves the answer, what was ended early is made again with the whole limit."""
    path("runs")
    made = []

    def solve(self, problem, run, *, brief):
        made.append((run.name, brief))
        return exceeded(problem, run) if brief else solve_program(problem, run)

    monkeypatch.setattr(LimitedRuns, "solve", solve)
    case = guard_cases.small_case(1, (3, 4, 3, 4), "additive")
    decision = decide_levels(case.problem)
    assert made[:4] == [(RUNS[0].name, True), (RUNS[1].name, True), (RUNS[2].name, True), (RUNS[0].name, False)]
    assert decision.status is DecisionStatus.OPTIMAL
    assert case.missed_by(decision.variant - 1) <= 1e-9


def test_a_time_limit_ends_the_interval_bound(guard_cases):
    """The bound that is reached when the time is over still holds."""
    problem = guard_cases.small_case(1, (3, 4, 3, 4), "additive").problem
    grid = LevelGrid.of(problem.space, problem.tables)
    stage = additive_stage(problem)
    bound = interval_bound(grid, stage, problem.constraints, known=-np.inf, tolerance=0.0, is_over=lambda: True)
    assert not bound.complete
    assert bound.bound >= grid.best(stage, problem.constraints)[0]
    with pytest.raises(TradeoffError, match="the time limit must be positive"):
        decide_levels(problem, time_limit=0.0)


def test_nothing_found_and_nothing_proved_is_no_decision(guard_cases, path, doctored, monkeypatch):
    path("runs")
    doctored(no_answer, runs=len(RUNS))
    monkeypatch.setattr(rgss.tradeoff.levels.guard, "search_levels", lambda *arguments: None)
    with pytest.raises(TradeoffError, match="no feasible design was found, but infeasibility was not proven"):
        decide_levels(guard_cases.small_case(1, (3, 4, 3), "additive").problem)


@pytest.mark.parametrize("name", ["enumerated", "bounds", "runs"])
def test_infeasible_is_proved_by_each_check(guard_cases, path, name):
    path(name)
    infeasible = next(
        case
        for case in (guard_cases.level_case(seed, largest=15_000) for seed in range(0, 5000, 5))
        if not case.any_feasible
    )
    decision = decide_levels(infeasible.problem)
    assert (decision.status, decision.variant) == (DecisionStatus.INFEASIBLE, None)
    assert decision.enumerated is (name == "enumerated")


@pytest.mark.parametrize("seed", [10, 11, 2, 8, 4])
def test_random_level_problems_against_brute_force(guard, guard_cases, seed):
    """One of each program; benchmarks/tradeoff_guard.py decides 2,000."""
    case = guard_cases.level_case(seed, largest=30_000)
    for name in ("enumerated", "solver"):
        assert guard.level_outcome(case, name, seed=seed) in ("right", "infeasible, right")


@pytest.mark.parametrize("program", PROGRAMS[:2])
def test_the_interval_bound_is_never_exceeded(guard_cases, program):
    """However few partial designs are kept, and with rules and unknown entries too."""
    checked = 0
    for seed in range(12):
        problem = guard_cases.level_case(seed, largest=30_000).problem
        grid = LevelGrid.of(problem.space, problem.tables)
        stage = additive_stage(problem)
        constraints = problem.constraints
        found = grid.best(stage, constraints)
        best = -np.inf if found is None else found[0]
        for most in (0, 10, 100, 1_000_000):
            bound = interval_bound(grid, stage, constraints, known=-np.inf, tolerance=0.0, most=most)
            assert bound.bound >= best - 1e-12
            if bound.complete:
                assert bound.bound == pytest.approx(best, abs=1e-9)
                checked += 1
    assert checked


def test_the_search_meets_what_is_feasible_only_at_one_design(guard_cases):
    """A demand that one design of a thousand meets is found by way of the violations."""
    case = guard_cases.small_case(3, (4,) * 5, "additive")
    grid = LevelGrid.of(case.problem.space, case.problem.tables)
    found = search_levels(grid, additive_stage(case.problem), case.problem.constraints, ())
    assert found is not None
    best = grid.best(additive_stage(case.problem), case.problem.constraints)
    assert found[0] == pytest.approx(best[0], abs=1e-12)


def test_the_sum_of_columns_is_that_of_exact_arithmetic():
    parts = [np.array([1e16, 1.0]), np.array([1.0, 1e-17]), np.array([-1e16, -1.0])]
    assert compensated_sum(parts, 2).tolist() == [1.0, 1e-17]


@pytest.fixture
def answered(monkeypatch):
    """A solver that answers the best design, or the worst feasible one, whatever HiGHS would come to."""

    def make(*, right):
        def attempt(solver, stage, run, *, brief=True):
            grid = solver.grid
            designs = np.concatenate(list(grid.blocks()))
            scores = grid.scores(stage, solver.constraints, designs)
            row = int(scores.argmax() if right else np.where(np.isfinite(scores), scores, np.inf).argmin())
            return Attempt(run=run, outcome=Outcome.PROVEN, score=float(scores[row]), design=designs[row])

        monkeypatch.setattr(GuardedStageSolver, "_attempt", attempt)

    return make


@pytest.mark.parametrize(
    ("right", "search"),
    [
        (True, "primal search agrees: nothing better was found"),
        (False, "primal search DISAGREES: found a better design than HiGHS without presolve"),
    ],
)
def test_the_certificate_lists_the_checks(guard_cases, path, answered, right, search):
    """Each check with its outcome, which here depends on no release of HiGHS."""
    path("bounds")
    answered(right=right)
    case = guard_cases.small_case(1, (3, 4, 3, 4), "additive")
    decision = decide_levels(case.problem)
    certificate = decision.certificate
    document = certificate_to_json(certificate)
    assert document["enumeration_agrees"] == "not enumerated"
    assert [(check["kind"], check["agrees"]) for check in document["checks"]] == [
        ("primal search", right),
        ("dual bound", True),
    ]
    assert [check.text for check in certificate.checks] == [
        search,
        "dual bound agrees: interval branch and bound leaves no better design",
    ]
    assert (decision.status, certificate.gap) == (DecisionStatus.OPTIMAL, 0.0)
    assert case.missed_by(decision.variant - 1) == 0.0


def test_the_certificate_of_what_the_solver_itself_answers(guard_cases, path):
    """Whether it is right or wrong, the search's check says so, and the decision is the optimum."""
    path("bounds")
    case = guard_cases.small_case(1, (3, 4, 3, 4), "additive")
    decision = decide_levels(case.problem)
    search, bound = decision.certificate.checks
    assert search.agrees == (search.detail == "nothing better was found")
    assert bound.agrees
    assert (decision.status, decision.certificate.gap) == (DecisionStatus.OPTIMAL, 0.0)
    assert case.missed_by(decision.variant - 1) == 0.0
