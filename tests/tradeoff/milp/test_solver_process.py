"""Solver runs in a process of their own: the same answers, and an end to what does not return."""

from __future__ import annotations

import math
import multiprocessing
import os

import cvxpy
import numpy as np
import pytest

from rgss.errors import TradeoffError
from rgss.tradeoff.milp import RUNS, LimitedRuns, SolverLimitError, SolverProcess, independent_run, solve_program
from rgss.tradeoff.milp.independent_solver import SolverCheck
from rgss.tradeoff.milp.limited_runs import LONGEST_BRIEF_RUN_S, LONGEST_RUN_S, WALL_FACTOR, highs_request
from rgss.tradeoff.milp.solver_process import RunLimit
from rgss.tradeoff.milp.stage import proven_gap
from tests.fixtures.processes import PATIENCE_S

FAKE = """
import os, signal
from rgss.tradeoff.milp import solver_worker

def solved(request):
    match request["do"]:
        case "sleep":
            signal.pause()
        case "loop":
            while True:
                pass
        case "die":
            os.kill(os.getpid(), signal.SIGKILL)
        case "fail":
            raise ValueError("no such option")
    return {"done": request["do"]}

solver_worker.solved = solved
serve = solver_worker.serve
"""


@pytest.fixture
def fake(tmp_path, monkeypatch):
    """A process with the real worker, whose runs do what they are asked for."""
    (tmp_path / "fake_solver_worker.py").write_text(FAKE, encoding="utf-8")
    monkeypatch.syspath_prepend(tmp_path)
    with SolverProcess("fake_solver_worker") as process:
        yield process


def knapsack(*, feasible=True):
    """Three of five items; or one that no bound allows."""
    chosen = cvxpy.Variable(5, boolean=True)
    share = cvxpy.Variable(2, nonneg=True)
    constraints = [cvxpy.sum(chosen) == 3.0, chosen @ np.array([3.0, 1.0, 4.0, 1.0, 5.0]) <= (9.0 if feasible else 2.0)]
    constraints += [share <= chosen[:2], cvxpy.sum(share) <= 1.5]
    return cvxpy.Problem(cvxpy.Maximize(chosen @ np.array([2.0, 7.0, 1.0, 8.0, 2.0]) + cvxpy.sum(share)), constraints)


@pytest.mark.parametrize("run", RUNS, ids=lambda run: run.name)
def test_the_answers_are_those_of_a_run_in_this_process(run):
    ours, theirs = knapsack(), knapsack()
    with LimitedRuns() as runs:
        assert runs.solve(ours, run)
        assert not runs.solve(knapsack(feasible=False), run)
    assert solve_program(theirs, run)
    assert ours.value == theirs.value
    assert all(
        np.array_equal(one.value, other.value) for one, other in zip(ours.variables(), theirs.variables(), strict=True)
    )
    assert (proven_gap(ours), proven_gap(theirs)) == (0.0, 0.0)


def test_an_independent_solver_runs_there_too():
    problem = knapsack()
    with LimitedRuns() as runs:
        assert runs.solve(problem, independent_run(SolverCheck.SCIP))
        assert not runs.solve(knapsack(feasible=False), independent_run(SolverCheck.SCIP))
    assert problem.value == pytest.approx(18.5)
    assert proven_gap(problem) == 0.0


def test_the_rows_of_a_program():
    data, _, _ = knapsack().get_problem_data(cvxpy.HIGHS)
    request = highs_request(data)
    assert (request["row_lower"] == request["row_upper"]).sum() == 1
    assert np.isneginf(request["row_lower"]).sum() == len(request["row_lower"]) - 1
    assert sum(request["integer"]) == 5
    assert request["column_upper"][request["integer"]].tolist() == [1.0] * 5


@pytest.mark.parametrize(
    ("do", "limit", "words"),
    [
        ("sleep", RunLimit(wall_s=0.01), "the solver was ended after 0.01 s"),
        ("loop", RunLimit(processor_s=0.01), "the solver was ended after 0.01 s of processor time"),
    ],
)
def test_a_run_that_never_returns_is_ended_and_the_next_one_answers(fake, do, limit, words):
    assert fake.solve({"do": "answer"}, limit=RunLimit()) == {"done": "answer"}
    pid = fake.pid
    with pytest.raises(SolverLimitError) as error:
        fake.solve({"do": do}, limit=limit)
    assert error.value.message == words
    assert "--time-limit" in error.value.hint
    assert fake.pid is None
    with pytest.raises(ProcessLookupError):
        os.kill(pid, 0)
    assert fake.solve({"do": "answer"}, limit=RunLimit()) == {"done": "answer"}


@pytest.mark.parametrize(
    ("do", "words"),
    [
        ("die", "the process of the solver ended by itself with the status -9"),
        ("fail", "the solver failed: ValueError: no such option"),
    ],
)
def test_a_run_that_fails_is_no_limit(fake, do, words):
    with pytest.raises(TradeoffError) as error:
        fake.solve({"do": do}, limit=RunLimit(processor_s=60.0, wall_s=60.0))
    assert error.value.message == words
    assert error.value.hint
    assert not isinstance(error.value, SolverLimitError)
    assert fake.solve({"do": "answer"}, limit=RunLimit()) == {"done": "answer"}


def test_a_process_that_does_not_start(monkeypatch):
    def refused(*rest, **more):
        raise OSError(11, "Resource temporarily unavailable")

    monkeypatch.setattr("subprocess.Popen", refused)
    with pytest.raises(TradeoffError, match="was not started: Resource temporarily unavailable") as error:
        SolverProcess().solve({}, limit=RunLimit())
    assert error.value.hint


def test_it_ends_with_its_parent_even_during_a_run(fake):
    """The parent's end of the pipe is closed, as it is however the parent ends."""
    fake.solve({"do": "answer"}, limit=RunLimit())
    fake._connection.send({"do": "sleep", "processor_s": math.inf, "wall_s": math.inf})
    fake._connection.close()
    assert fake._process.wait(timeout=PATIENCE_S) == 0


def _in_a_daemon():
    with LimitedRuns() as runs:
        os._exit(7 if runs.solve(knapsack()) else 8)


def test_a_daemonic_worker_may_have_it():
    """A child of multiprocessing would be refused there."""
    worker = multiprocessing.get_context("spawn").Process(target=_in_a_daemon, daemon=True)
    worker.start()
    worker.join()
    assert worker.exitcode == 7


def test_the_limits_without_a_time_limit(fake):
    first, second = RUNS[:2]
    runs = LimitedRuns(process=fake)
    assert runs.limit_of(first, brief=True) == RunLimit(
        processor_s=LONGEST_BRIEF_RUN_S, wall_s=WALL_FACTOR * LONGEST_BRIEF_RUN_S
    )
    assert runs.limit_of(first, brief=False).processor_s == LONGEST_RUN_S
    assert not runs.half_over()()

    def exceeded(request, *, limit):
        raise SolverLimitError("ended", hint="")

    fake.solve = exceeded
    with pytest.raises(SolverLimitError):
        runs.solve(knapsack(), second, brief=True)
    assert runs.limit_of(second, brief=True).processor_s == LONGEST_BRIEF_RUN_S / 2.0
    assert runs.limit_of(second, brief=False).processor_s == LONGEST_RUN_S
    assert runs.limit_of(first, brief=True).processor_s == LONGEST_BRIEF_RUN_S


def test_a_time_limit_is_shared_by_the_runs(fake):
    now = [0.0]
    runs = LimitedRuns(8.0, process=fake, clock=lambda: now[0])
    over = runs.half_over()
    assert runs.limit_of(RUNS[0], brief=True) == RunLimit(wall_s=2.0)
    assert runs.limit_of(RUNS[0], brief=False) == RunLimit(wall_s=4.0)
    assert not over()
    now[0] = 4.0
    assert over()
    assert runs.limit_of(RUNS[0], brief=False).wall_s == 2.0
    now[0] = 9.0
    with pytest.raises(SolverLimitError, match="the time limit is reached") as error:
        runs.solve(knapsack())
    assert error.value.hint
    assert fake.pid is None


@pytest.mark.parametrize("limit", [0.0, -1.0, math.nan, math.inf])
def test_a_time_limit_is_positive(limit):
    with pytest.raises(TradeoffError, match="the time limit must be positive, got") as error:
        LimitedRuns(limit)
    assert error.value.hint
