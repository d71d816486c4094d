from __future__ import annotations

import warnings

import cvxpy
import numpy as np
import pytest

from rgss.errors import TradeoffError
from rgss.tradeoff import DecisionStatus
from rgss.tradeoff.milp.selection import VariantSelection
from rgss.tradeoff.milp.stage import StageSolver, solve_program
from rgss.tradeoff.programs.additive import additive_stage


@pytest.fixture
def solve():
    """Solve the stage of the weighted value of a problem."""

    def run(problem):
        solver = StageSolver(select=lambda: VariantSelection.of(problem.alternatives), constraints=problem.constraints)
        return solver.solve(additive_stage(problem))

    return run


def test_constraints_are_named(payload_and_time):
    assert [constraint.name for constraint in payload_and_time.constraints] == [
        "R-1: P >= 0.8 kg",
        "R-2: cost <= 100 kg",
        "evidence:t",
    ]


def test_optimum(payload_and_time, solve):
    solution = solve(payload_and_time)
    assert (solution.status, solution.chosen.variant) == (DecisionStatus.OPTIMAL, 1)
    assert solution.objective == pytest.approx(0.5, abs=1e-12)
    assert solution.selection_error <= 1e-9
    assert solution.gap == pytest.approx(0.0, abs=1e-12)


def test_infeasible_is_an_outcome(build_problem, solve):
    solution = solve(build_problem({1: {"a": 0.4}, 2: {"a": None}}, thresholds=[("R", "a", ">=", 0.5)]))
    assert (solution.status, solution.alternative, solution.objective) == (DecisionStatus.INFEASIBLE, None, None)
    with pytest.raises(TradeoffError, match=r"stage 'value' is infeasible \(check its status first\)"):
        _ = solution.chosen


@pytest.mark.parametrize(
    "status", ["optimal_inaccurate", "infeasible_inaccurate", "infeasible_or_unbounded", "unbounded", "user_limit"]
)
def test_only_a_proven_status_is_accepted(payload_and_time, solve, monkeypatch, status):
    monkeypatch.setattr(cvxpy.Problem, "status", property(lambda self: status))
    with pytest.raises(TradeoffError) as error:
        solve(payload_and_time)
    assert error.value.message == f"the solver ended with the status {status!r}"
    assert error.value.hint.startswith("only a proven optimum is accepted")


@pytest.mark.parametrize(
    ("status", "text"),
    [
        ("optimal_inaccurate", "Solution may be inaccurate. Try another solver"),
        ("infeasible_or_unbounded", "\n    The problem is either infeasible or unbounded, but the solver"),
    ],
)
def test_a_warning_of_the_solver_becomes_its_status(payload_and_time, solve, monkeypatch, status, text):
    monkeypatch.setattr(cvxpy.Problem, "solve", lambda self, **options: warnings.warn(text, stacklevel=1))
    monkeypatch.setattr(cvxpy.Problem, "status", property(lambda self: status))
    with pytest.raises(TradeoffError, match=status):
        solve(payload_and_time)


def test_other_warnings_are_not_hidden(payload_and_time, solve, monkeypatch):
    monkeypatch.setattr(cvxpy.Problem, "solve", lambda self, **options: warnings.warn("something else", stacklevel=1))
    with pytest.raises(UserWarning, match="something else"):
        solve(payload_and_time)


def test_solver_that_fails_or_is_missing(payload_and_time, solve, monkeypatch):
    def fail(self, **options):
        raise cvxpy.SolverError("The solver HIGHS is\n not installed.")

    monkeypatch.setattr(cvxpy.Problem, "solve", fail)
    with pytest.raises(TradeoffError) as error:
        solve(payload_and_time)
    assert error.value.message == "the solver failed: The solver HIGHS is not installed."
    assert "highspy" in error.value.hint


def test_an_answer_that_selects_two_is_refused(payload_and_time, solve, monkeypatch):
    def select_two(self, **options):
        self.variables()[0].value = np.array([1.0, 1.0, 0.0, 0.0, 0.0])

    monkeypatch.setattr(cvxpy.Problem, "solve", select_two)
    monkeypatch.setattr(cvxpy.Problem, "status", property(lambda self: "optimal"))
    with pytest.raises(TradeoffError) as error:
        solve(payload_and_time)
    assert error.value.message == "the solver's answer selects no single alternative (off by 1)"
    assert error.value.hint.startswith("the answer is not used")


def test_the_solver_prints_nothing(payload_and_time, solve, capfd):
    solve(payload_and_time)
    assert capfd.readouterr() == ("", "")


def test_a_difference_just_above_a_tie_is_seen(build_problem, solve):
    problem = build_problem({variant: {"a": 0.5 + (3e-9 if variant == 40 else 0.0)} for variant in range(1, 73)})
    assert solve(problem).chosen.variant == 40


def test_a_feasible_program_that_the_presolve_of_the_solver_calls_infeasible():
    """Three factors of two levels, of whose combinations only p, q, p meets a demand; met in the random tests.

    HiGHS 1.15.1 says "infeasible" with its presolve and finds the optimum without.
    """
    levels = cvxpy.Variable((3, 2), boolean=True)
    designs, pairs = cvxpy.Variable(8, nonneg=True), cvxpy.Variable(4, nonneg=True)
    values = np.array([74.6636606747705, 27.9620815722955, 17.5001896661665, 193.525074781746])
    values = np.append(values, [180.385238478017, 142.070827582152, 243.571825627305, 52.1293046281797])
    place = np.arange(8)
    bits = np.stack([place // 4, place // 2 % 2, place % 2])
    constraints = [cvxpy.sum(levels[factor]) == 1.0 for factor in range(3)]
    constraints += [
        cvxpy.sum(designs[np.flatnonzero(bits[factor] == level)]) == levels[factor, level]
        for factor in range(3)
        for level in range(2)
    ]
    constraints += [pairs[0] + pairs[1] == levels[0, 0], pairs[2] + pairs[3] == levels[0, 1]]
    constraints += [pairs[0] + pairs[2] == levels[1, 0], pairs[1] + pairs[3] == levels[1, 1]]
    constraints += [np.where(place == 2, 1.0, -1.0) @ designs >= 0.0]
    program = cvxpy.Problem(cvxpy.Maximize(values @ designs + 118.344784257423 * pairs[3]), constraints)
    assert solve_program(program)
    assert program.value == pytest.approx(17.5001896661665)
    assert designs.value == pytest.approx(np.eye(8)[2])
