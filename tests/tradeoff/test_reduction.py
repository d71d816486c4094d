"""What the reduction leaves out cannot be chosen: for every program the decision stays the same."""

from __future__ import annotations

import numpy as np
import pytest

import rgss.tradeoff.reduction
from rgss.tradeoff import Agreement, decide
from rgss.tradeoff.programs.enumeration import enumerate_alternatives
from rgss.tradeoff.reduction import LARGEST_UNREDUCED, reduced_rows


@pytest.fixture
def reduce_everything(monkeypatch):
    monkeypatch.setattr(rgss.tradeoff.reduction, "LARGEST_UNREDUCED", 0)


def rows_of(problem):
    enumeration = enumerate_alternatives(problem)
    return enumeration.variants[reduced_rows(enumeration)].tolist()


def test_few_alternatives_are_all_considered(payload_and_time):
    assert rows_of(payload_and_time) == [1, 2, 3, 4, 5]


def test_of_many_the_feasible_that_nothing_dominates_are_left(build_problem, reduce_everything):
    problem = build_problem(
        {
            1: {"a": 0.5, "b": 0.5},
            2: {"a": 0.5, "b": 0.4},
            3: {"a": 0.9, "b": 0.1},
            4: {"a": 0.5, "b": 0.5},
            5: {"a": 1.0, "b": 1.0, "c": 1.0},
            6: {"a": 0.1, "b": None},
        }
        | {7: {"a": 0.0, "b": 0.95}},
        thresholds=[("R", "a", "<=", 0.9)],
        values={"a": (0.0, 1.0), "b": (0.0, 1.0)},
        weights={"a": 0.5, "b": 0.5},
    )
    assert rows_of(problem) == [1, 3, 4, 7]
    assert decide(problem).certificate.considered == 4


def test_where_nothing_is_feasible_one_of_each_kind_is_left(build_problem, reduce_everything):
    problem = build_problem(
        {1: {"a": 0.1, "b": 0.9}, 2: {"a": 0.2, "b": 0.8}, 3: {"a": 0.9, "b": 0.1}, 4: {"a": 0.1, "b": 0.1}},
        thresholds=[("R", "a", ">=", 0.5), ("Q", "b", ">=", 0.5)],
    )
    assert rows_of(problem) == [1, 3, 4]
    decision = decide(problem)
    assert (decision.chosen, decision.certificate.considered, decision.certificate.enumeration_agrees) == (
        None,
        3,
        Agreement.AGREED,
    )


@pytest.mark.parametrize(
    "program", ["additive", "lexicographic", "epsilon_constraint", "tchebycheff", "minimax_regret", "risk"]
)
def test_the_decision_stays(cases, seeded, monkeypatch, program):
    less = 0
    for seed in range(12):
        problem = cases.random_problem(seeded(f"reduction {program} {seed}"), program)
        whole = decide(problem, resamples=0)
        with monkeypatch.context() as patch:
            patch.setattr(rgss.tradeoff.reduction, "LARGEST_UNREDUCED", 0)
            reduced = decide(problem, resamples=0)
        assert (reduced.status, reduced.chosen, reduced.ties) == (whole.status, whole.chosen, whole.ties)
        assert reduced.ranking == whole.ranking
        assert whole.certificate.considered == len(problem.alternatives)
        less += reduced.certificate.considered < whole.certificate.considered
    assert less > 2


def test_more_criteria_than_dominance_is_good_for(build_problem, reduce_everything):
    names = [f"m{place}" for place in range(13)]
    rng = np.random.default_rng(0)
    problem = build_problem(
        {variant: dict(zip(names, map(float, rng.random(13)), strict=True)) for variant in range(1, 30)},
        values=dict.fromkeys(names, (0.0, 1.0)),
        weights=dict.fromkeys(names, 1 / 13),
    )
    assert rows_of(problem) == list(range(1, 30))


def test_the_limit_is_where_a_program_is_still_quick():
    assert LARGEST_UNREDUCED == 2_000
