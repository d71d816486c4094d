from __future__ import annotations

import pytest

import rgss.tradeoff.reduction
from rgss.tradeoff import decide
from rgss.tradeoff.reduction import LARGEST_UNREDUCED, reduced_alternatives


def test_few_alternatives_are_all_considered(payload_and_time):
    assert [alternative.variant for alternative in reduced_alternatives(payload_and_time)] == [1, 2, 3, 4, 5]


@pytest.mark.parametrize("threshold", [0.9, -1.0, 2.0])
def test_many_alternatives_lose_the_infeasible_unless_all_are(build_problem, threshold):
    count = LARGEST_UNREDUCED + 1
    problem = build_problem(
        {variant: {"a": (variant % 100) / 100 if variant % 29 else None} for variant in range(count)},
        thresholds=[("R", "a", ">=", threshold)],
    )
    feasible = [alternative.variant for alternative in problem.alternatives if problem.is_feasible(alternative)]
    left = [alternative.variant for alternative in reduced_alternatives(problem)]
    assert left == (feasible or list(range(count)))


def test_reduction_does_not_change_the_decision(seeded, build_problem, monkeypatch):
    rng = seeded(3)
    for _ in range(25):
        problem = build_problem(
            {variant: {"a": rng.randrange(9) / 8, "b": rng.choice([None, 0.1, 0.5])} for variant in range(20)},
            thresholds=[("R", "a", "<=", rng.random())],
            values={"a": (0.0, 1.0), "b": (1.0, 0.0)},
            weights={"a": 0.5, "b": 0.5},
        )
        whole = decide(problem)
        with monkeypatch.context() as patch:
            patch.setattr(rgss.tradeoff.reduction, "LARGEST_UNREDUCED", 5)
            reduced = decide(problem)
        assert (reduced.status, reduced.chosen, reduced.ranking) == (whole.status, whole.chosen, whole.ranking)
        assert reduced.certificate.considered == (len(whole.ranking) or 20)
        assert whole.certificate.considered == reduced.certificate.alternatives == 20
