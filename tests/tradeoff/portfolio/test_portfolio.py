"""Portfolios by hand; tests/tradeoff/test_agreement.py compares random ones with trying each."""

from __future__ import annotations

import dataclasses
import json

import numpy as np
import pytest

import rgss.tradeoff.portfolio.checks
import rgss.tradeoff.portfolio.mean
import rgss.tradeoff.portfolio.portfolio
from rgss.errors import TradeoffError
from rgss.reports.decision.json import portfolio_to_json
from rgss.tradeoff import (
    AdditiveValue,
    Agreement,
    CheckKind,
    Cut,
    DecisionStatus,
    PortfolioAim,
    PortfolioProblem,
    PortfolioTask,
    Tchebycheff,
    decide_portfolio,
)


@pytest.fixture
def portfolio(build_problem):
    """A portfolio problem from the values of each design in each task; what is below 0 is infeasible."""

    def build(table, *, weights=None, program=None, **more):
        count = len(next(iter(table.values())))
        weights = weights or [1.0 / count] * count
        tasks = tuple(
            PortfolioTask(
                name=f"t{task}",
                weight=weights[task],
                problem=build_problem(
                    {variant: {"a": row[task]} for variant, row in table.items()},
                    thresholds=[("R", "a", ">=", 0.0)],
                    program=program or AdditiveValue(),
                ),
            )
            for task in range(count)
        )
        return PortfolioProblem(tasks=tasks, **({"at_most": 1} | more))

    return build


TABLE = {1: (0.6, 0.6, 0.6), 2: (1.0, 0.1, 0.0), 3: (0.2, 1.0, 0.9), 4: (0.1, 0.9, 0.2)}


@pytest.mark.parametrize(
    ("at_most", "aim", "members", "objective"),
    [
        (1, PortfolioAim.MEAN, ("3",), 0.7),
        (2, PortfolioAim.MEAN, ("2", "3"), 2.9 / 3),
        (3, PortfolioAim.MEAN, ("2", "3"), 2.9 / 3),
        (1, PortfolioAim.WORST, ("1",), 0.6),
        (2, PortfolioAim.WORST, ("2", "3"), 0.9),
    ],
)
def test_by_hand(portfolio, at_most, aim, members, objective):
    decision = decide_portfolio(portfolio(TABLE, at_most=at_most, aim=aim))
    assert decision.status is DecisionStatus.OPTIMAL
    assert decision.members == members
    assert decision.objective == pytest.approx(objective)
    assert decision.objective_recomputed == pytest.approx(objective)
    assert decision.gap == pytest.approx(0.0, abs=1e-9)
    assert decision.enumeration_agrees is Agreement.AGREED
    # The fourth is nowhere better than the third.
    assert decision.considered == 3


def test_what_another_member_would_add(portfolio):
    decision = decide_portfolio(portfolio(TABLE, at_most=4))
    assert decision.by_size == pytest.approx((0.7, 2.9 / 3, 2.9 / 3, 2.9 / 3))


def test_who_serves_what(portfolio):
    decision = decide_portfolio(portfolio(TABLE, at_most=2))
    assert [(one.task, one.variant, one.value) for one in decision.assignments] == [
        ("t0", 2, 1.0),
        ("t1", 3, 1.0),
        ("t2", 3, 0.9),
    ]


def test_weights_of_the_tasks(portfolio):
    assert decide_portfolio(portfolio(TABLE, weights=[0.8, 0.1, 0.1])).members == ("2",)


def test_one_gripper_for_many_objects(portfolio):
    """A member is a gripper; for each object its best variant serves."""
    table = {1: (0.9, -1.0), 2: (-1.0, 0.8), 3: (0.7, 0.7), 4: (0.6, 0.95)}
    grippers = {1: "wide", 2: "wide", 3: "narrow", 4: "narrow"}
    decision = decide_portfolio(portfolio(table, groups=grippers))
    assert decision.members == ("wide",)
    assert [one.variant for one in decision.assignments] == [1, 2]
    assert decision.objective == pytest.approx(0.85)
    assert decide_portfolio(portfolio(table)).members == ("4",)


@pytest.mark.parametrize("aim", list(PortfolioAim))
@pytest.mark.parametrize("seed", range(8))
def test_what_is_left_out_of_a_task_does_not_serve_it(portfolio, seed, aim):
    """As if it were infeasible there, by brute force over all pairs."""
    random = np.random.default_rng(seed)
    table = {
        variant: tuple(float(value) if keep else -1.0 for value, keep in zip(random.random(3), kept, strict=True))
        for variant, kept in enumerate(random.random((7, 3)) < 0.7, start=1)
    }
    whole = portfolio(table, at_most=2, aim=aim)
    out = [frozenset(variant for variant, row in table.items() if row[task] < 0.0) for task in range(3)]
    tasks = tuple(
        dataclasses.replace(
            task,
            problem=dataclasses.replace(
                task.problem,
                alternatives=tuple(one for one in task.problem.alternatives if one.variant not in left_out),
            ),
            left_out=left_out,
        )
        for task, left_out in zip(whole.tasks, out, strict=True)
    )
    decision = decide_portfolio(dataclasses.replace(whole, tasks=tasks))

    score = np.mean if aim is PortfolioAim.MEAN else min
    pairs = [np.maximum(table[a], table[b]) for a in table for b in table if a <= b]
    scores = [score(best) for best in pairs if min(best) >= 0.0]
    assert decision.objective == (pytest.approx(max(scores)) if scores else None)
    assert decision == decide_portfolio(whole)
    assert all(one.variant not in left_out for one, left_out in zip(decision.assignments, out, strict=True))


def test_too_few_members_to_serve_every_task(portfolio):
    table = {1: (0.9, -1.0), 2: (-1.0, 0.8)}
    decision = decide_portfolio(portfolio(table))
    assert (decision.status, decision.members, decision.objective) == (DecisionStatus.INFEASIBLE, (), None)
    assert (decision.by_size, decision.unserved, decision.enumeration_agrees) == ((None,), (), Agreement.AGREED)
    assert decide_portfolio(portfolio(table, at_most=2)).by_size == (None, pytest.approx(0.85))


def test_a_task_that_no_design_serves(portfolio):
    decision = decide_portfolio(portfolio({1: (0.9, -1.0), 2: (0.5, -0.1)}, at_most=2))
    assert (decision.status, decision.unserved) == (DecisionStatus.INFEASIBLE, ("t1",))


def test_more_portfolios_than_are_enumerated(portfolio, monkeypatch):
    monkeypatch.setattr(rgss.tradeoff.portfolio.checks, "MOST_ENTRIES", 2)
    decision = decide_portfolio(portfolio(TABLE, at_most=3))
    assert (set(decision.members), decision.enumeration_agrees) == ({"2", "3"}, Agreement.NOT_ENUMERATED)
    assert decision.objective == pytest.approx(2.9 / 3)


@pytest.mark.parametrize("aim", list(PortfolioAim))
@pytest.mark.parametrize("answer", [None, (1,)], ids=["false infeasible", "not optimal"])
def test_a_wrong_answer_of_the_solver_is_not_used(portfolio, monkeypatch, answer, aim):
    right = decide_portfolio(portfolio(TABLE, at_most=2, aim=aim))
    monkeypatch.setattr(rgss.tradeoff.portfolio.portfolio, "solved_portfolio", lambda *arguments: answer)
    for most in (20_000_000, 0):
        monkeypatch.setattr(rgss.tradeoff.portfolio.checks, "MOST_ENTRIES", most)
        decision = decide_portfolio(portfolio(TABLE, at_most=2, aim=aim))
        assert (decision.status, decision.members) == (DecisionStatus.OPTIMAL, right.members)
        assert decision.objective == pytest.approx(right.objective)
        assert [check.agrees for check in decision.checks if check.kind is CheckKind.SECOND_RUN] == [False]


def test_a_wrong_bound_is_seen_by_the_solver(portfolio, monkeypatch):
    """The proof is made to end at once with a poor portfolio: the solver's better one contradicts it."""

    def wrong(profits, size, start, tolerance, work):
        return rgss.tradeoff.portfolio.mean.SizeAnswer(rows=(0,), objective=0.6, bound=0.6)

    monkeypatch.setattr(rgss.tradeoff.portfolio.mean, "best_mean", wrong)
    monkeypatch.setattr(rgss.tradeoff.portfolio.checks, "MOST_ENTRIES", 0)
    decision = decide_portfolio(portfolio(TABLE, at_most=2))
    assert (decision.status, set(decision.members)) == (DecisionStatus.BEST_FOUND, {"2", "3"})
    assert not decision.checks[0].agrees
    monkeypatch.setattr(rgss.tradeoff.portfolio.checks, "MOST_ENTRIES", 20_000_000)
    enumerated = decide_portfolio(portfolio(TABLE, at_most=2))
    assert (enumerated.status, enumerated.enumeration_agrees) == (DecisionStatus.OPTIMAL, Agreement.DISAGREED)
    assert set(enumerated.members) == {"2", "3"}


@pytest.fixture
def by_proofs_alone(monkeypatch):
    """Neither the solver nor enumeration of all portfolios."""
    monkeypatch.setattr(rgss.tradeoff.portfolio.portfolio, "LARGEST_SOLVED", 0)
    monkeypatch.setattr(rgss.tradeoff.portfolio.checks, "MOST_ENTRIES", 0)


def random_table(seed, members, tasks):
    values = np.random.default_rng(seed).random((members, tasks))
    return {row + 1: tuple(values[row].tolist()) for row in range(members)}


@pytest.mark.parametrize("aim", list(PortfolioAim))
def test_a_thousand_designs_for_twenty_tasks_by_twenty_members(portfolio, aim):
    decision = decide_portfolio(portfolio(random_table(0, 1000, 20), at_most=20, aim=aim))
    assert decision.status is DecisionStatus.OPTIMAL
    assert (decision.gap, decision.cut) == (pytest.approx(0.0, abs=1e-9), None)
    assert list(decision.by_size) == sorted(decision.by_size)
    values = np.array(list(random_table(0, 1000, 20).values()))
    ideal = values.max(axis=0).mean() if aim is PortfolioAim.MEAN else values.max(axis=0).min()
    assert decision.objective == pytest.approx(ideal)


@pytest.mark.parametrize("aim", list(PortfolioAim))
@pytest.mark.usefixtures("by_proofs_alone")
def test_an_answer_that_the_work_limit_cuts_has_a_gap_that_holds(portfolio, aim):
    """Every size has a portfolio and a bound, and more work changes neither for the worse."""
    problem = portfolio(random_table(3, 40, 20), at_most=4, aim=aim)
    cut, whole = decide_portfolio(problem, most_work=60_000), decide_portfolio(problem)
    assert (cut.status, cut.cut) == (DecisionStatus.BEST_FOUND, Cut.WORK)
    assert whole.status is DecisionStatus.OPTIMAL
    assert list(cut.by_size) == sorted(cut.by_size)
    assert cut.gap > 0.0
    for found, gap, best in zip(cut.by_size, cut.by_size_gap, whole.by_size, strict=True):
        assert found <= best + 1e-12
        assert best <= found + gap + 1e-9
    assert cut == decide_portfolio(problem, most_work=60_000)


@pytest.mark.parametrize("aim", list(PortfolioAim))
@pytest.mark.usefixtures("by_proofs_alone")
def test_an_answer_that_the_time_limit_cuts_says_so(portfolio, aim):
    decision = decide_portfolio(portfolio(random_table(3, 40, 20), at_most=4, aim=aim), time_limit=1e-9)
    assert (decision.status, decision.cut) == (DecisionStatus.BEST_FOUND, Cut.TIME)
    assert decision.gap > 0.0
    with pytest.raises(TradeoffError, match="the time limit must be positive, got -1 s"):
        decide_portfolio(portfolio(TABLE), time_limit=-1.0)


@pytest.mark.parametrize("aim", list(PortfolioAim))
@pytest.mark.usefixtures("by_proofs_alone")
def test_a_search_that_a_limit_ends_before_it_finds_anything_is_undecided(portfolio, aim):
    values = np.random.default_rng(1).random((40, 24))
    # No three members serve all tasks, which takes some work to prove.
    values[np.random.default_rng(2).random((40, 24)) < 0.8] = -1.0
    table = {row + 1: tuple(values[row].tolist()) for row in range(40)}
    decision = decide_portfolio(portfolio(table, at_most=3, aim=aim), most_work=30)
    assert (decision.status, decision.members, decision.objective) == (DecisionStatus.UNDECIDED, (), None)
    assert decide_portfolio(portfolio(table, at_most=3, aim=aim)).status is DecisionStatus.INFEASIBLE


@pytest.mark.parametrize("seed", range(25))
def test_random_portfolios_against_all_portfolios(guard_cases, guard, seed, monkeypatch):
    """Once with the enumeration of the product, and once by its proofs alone."""
    case = guard_cases.portfolio_case(seed)
    assert guard.portfolio_outcome(case) in ("right", "infeasible, right")
    monkeypatch.setattr(rgss.tradeoff.portfolio.checks, "MOST_ENTRIES", 0)
    monkeypatch.setattr(rgss.tradeoff.portfolio.portfolio, "LARGEST_SOLVED", 0)
    assert guard.portfolio_outcome(case) in ("right", "infeasible, right")


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"tasks": ()}, "a portfolio without tasks has nothing to do"),
        ({"at_most": 0}, "a portfolio of at most 0 designs serves no task"),
        ({"groups": {1: "x"}}, "variant 2 belongs to no group"),
    ],
)
def test_ill_posed(portfolio, change, message):
    with pytest.raises(TradeoffError) as error:
        dataclasses.replace(portfolio(TABLE), **change)
    assert error.value.message == message
    assert error.value.hint


def test_tasks_that_do_not_fit(portfolio):
    whole = portfolio(TABLE)
    fewer = portfolio({1: (0.5,)}, weights=[1.0]).tasks[0]
    for tasks, message in (
        ((whole.tasks[0], whole.tasks[0]), "task 't0' is given twice"),
        ((dataclasses.replace(whole.tasks[0], weight=0.4),), "weights must sum to 1, got 0.4"),
        (
            (dataclasses.replace(whole.tasks[0], weight=0.5), dataclasses.replace(fewer, name="t1", weight=0.5)),
            "variant 2 is not among the alternatives of every task",
        ),
    ):
        with pytest.raises(TradeoffError) as error:
            PortfolioProblem(tasks=tasks, at_most=1)
        assert error.value.message == message
    with pytest.raises(TradeoffError, match="task 't0' is decided by the tchebycheff program"):
        portfolio(TABLE, program=Tchebycheff())


def test_an_answer_that_selects_half_a_member_is_not_used(portfolio, monkeypatch):
    def half(problem, run):
        for variable in problem.variables():
            variable.save_value(np.full(variable.shape, 0.5))
        return True

    monkeypatch.setattr(rgss.tradeoff.portfolio.checks, "solve_program", half)
    decision = decide_portfolio(portfolio(TABLE))
    assert decision.members == ("3",)
    assert "the solver's answer selects no portfolio (off by 0.5)" in decision.checks[0].detail


def test_as_plain_values(portfolio):
    document = json.loads(json.dumps(portfolio_to_json(decide_portfolio(portfolio(TABLE, at_most=2))), allow_nan=False))
    assert document["members"] == ["2", "3"]
    assert document["assignments"][0] == {"study": "t0", "member": "2", "variant": 2, "value": 1.0}
    assert document["enumeration_agrees"] == "agreed"
    nothing = portfolio_to_json(decide_portfolio(portfolio({1: (-1.0,)})))
    assert (nothing["status"], nothing["value"], nothing["unserved"]) == ("infeasible", None, ["t0"])


def test_solvers_get_the_time_that_is_left(portfolio, monkeypatch):
    given = []
    module = rgss.tradeoff.portfolio.portfolio
    solved = module.solved_portfolio
    monkeypatch.setattr(module, "solved_portfolio", lambda *of: given.append(of[-1].options) or solved(*of))
    decide_portfolio(portfolio(TABLE), time_limit=60.0)
    decide_portfolio(portfolio(TABLE))

    assert 0.0 < given[0]["time_limit"] <= 60.0
    assert "time_limit" not in given[1]


def test_a_solver_that_is_not_run_contradicts_nothing(portfolio):
    other = dataclasses.replace(rgss.tradeoff.portfolio.checks.PORTFOLIO_RUN, name="SCIP")
    table = portfolio(random_table(3, 101, 25), at_most=2)
    large = decide_portfolio(table, most_work=1_000, independent=(other,))
    late = decide_portfolio(portfolio(TABLE), time_limit=1e-9, independent=(other,))

    told = [(check.agrees, check.detail) for check in (*large.checks, *late.checks) if check.detail.startswith("SCIP")]
    assert [agrees for agrees, _ in told] == [None, None]
    assert told[0][1] == "SCIP not run: the program has 2525 values, and at most 2500 are solved"
    assert told[1][1] == "SCIP not run: the time limit is spent"
