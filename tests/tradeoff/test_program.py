from __future__ import annotations

import warnings

import cvxpy
import numpy as np
import pytest

from rgss.errors import TradeoffError
from rgss.tradeoff import DecisionStatus
from rgss.tradeoff.program import choice_program


@pytest.fixture
def program(payload_and_time):
    return choice_program(payload_and_time, payload_and_time.alternatives)


def test_constraints_are_named(program):
    assert [constraint.name for constraint in program.constraints] == [
        "choose exactly one",
        "R-1: P >= 0.8 kg",
        "R-2: cost <= 100 kg",
        "evidence:t",
    ]


def test_optimum(program):
    solution = program.solve()
    assert (solution.status, solution.variant) == (DecisionStatus.OPTIMAL, 1)
    assert solution.objective == pytest.approx(0.5, abs=1e-12)
    assert solution.selection_error <= 1e-9


def test_infeasible_is_an_outcome(build_problem):
    problem = build_problem({1: {"a": 0.4}, 2: {"a": None}}, thresholds=[("R", "a", ">=", 0.5)])
    solution = choice_program(problem, problem.alternatives).solve()
    assert (solution.status, solution.variant, solution.objective) == (DecisionStatus.INFEASIBLE, None, None)


@pytest.mark.parametrize(
    "status", ["optimal_inaccurate", "infeasible_inaccurate", "infeasible_or_unbounded", "unbounded", "user_limit"]
)
def test_only_a_proven_status_is_accepted(program, monkeypatch, status):
    monkeypatch.setattr(cvxpy.Problem, "status", property(lambda self: status))
    with pytest.raises(TradeoffError) as error:
        program.solve()
    assert error.value.message == f"the solver ended with the status {status!r}"
    assert error.value.hint.startswith("only a proven optimum is accepted")


@pytest.mark.parametrize(
    ("status", "text"),
    [
        ("optimal_inaccurate", "Solution may be inaccurate. Try another solver"),
        ("infeasible_or_unbounded", "\n    The problem is either infeasible or unbounded, but the solver"),
    ],
)
def test_a_warning_of_the_solver_becomes_its_status(program, monkeypatch, status, text):
    monkeypatch.setattr(cvxpy.Problem, "solve", lambda self, **options: warnings.warn(text, stacklevel=1))
    monkeypatch.setattr(cvxpy.Problem, "status", property(lambda self: status))
    with pytest.raises(TradeoffError, match=status):
        program.solve()


def test_other_warnings_are_not_hidden(program, monkeypatch):
    monkeypatch.setattr(cvxpy.Problem, "solve", lambda self, **options: warnings.warn("something else", stacklevel=1))
    with pytest.raises(UserWarning, match="something else"):
        program.solve()


def test_solver_that_fails_or_is_missing(program, monkeypatch):
    def fail(self, **options):
        raise cvxpy.SolverError("The solver HIGHS is\n not installed.")

    monkeypatch.setattr(cvxpy.Problem, "solve", fail)
    with pytest.raises(TradeoffError) as error:
        program.solve()
    assert error.value.message == "the solver failed: The solver HIGHS is not installed."
    assert "highspy" in error.value.hint


def test_an_answer_that_selects_two_is_refused(program, monkeypatch):
    def select_two(self, **options):
        self.variables()[0].value = np.array([1.0, 1.0, 0.0, 0.0, 0.0])

    monkeypatch.setattr(cvxpy.Problem, "solve", select_two)
    monkeypatch.setattr(cvxpy.Problem, "status", property(lambda self: "optimal"))
    monkeypatch.setattr(cvxpy.Problem, "value", property(lambda self: 500.0))
    with pytest.raises(TradeoffError) as error:
        program.solve()
    assert error.value.message == "the solver's answer selects no single alternative (off by 1)"
    assert error.value.hint.startswith("the answer is not used")


def test_the_solver_prints_nothing(program, capfd):
    program.solve()
    assert capfd.readouterr() == ("", "")


def test_a_difference_just_above_a_tie_is_seen(build_problem):
    problem = build_problem({variant: {"a": 0.5 + (3e-9 if variant == 40 else 0.0)} for variant in range(1, 73)})
    assert choice_program(problem, problem.alternatives).solve().variant == 40
