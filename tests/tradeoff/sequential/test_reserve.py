"""A reserve is spent while the choice is doubtful, and on nothing else."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from rgss.errors import TradeoffError
from rgss.tradeoff import Alternative
from rgss.tradeoff.sequential import (
    Decided,
    Progress,
    Reason,
    SequentialEvidence,
    SequentialRule,
    next_batch,
    next_batch_with_reserve,
    probability_of_good_selection,
)

LENGTH = 80
RULE = SequentialRule(pilot=4, batch=4, cap=LENGTH, verdict_cap=4, budget=40, finalists=2)
RESERVED = replace(RULE, reserve=60, good_selection=0.9)


@pytest.fixture
def sweep(build_problem):
    """Replicates by the rule, of which alternatives have a share of success of 0.9 or more required of them."""

    def run(rows, worths, rule, look, **settings):
        counts, progress = dict.fromkeys(rows, rule.pilot), Progress()
        while True:
            alternatives = tuple(
                Alternative(
                    variant=variant,
                    measures={"S": float(np.mean(row[: counts[variant]])), "a": worths[variant]},
                    samples={"S": tuple(row[: counts[variant]])},
                )
                for variant, row in rows.items()
            )
            problem = build_problem(
                {},
                alternatives=alternatives,
                thresholds=[("R-1", "S", ">=", 0.8)],
                values={"a": (0.0, 1.0), "S": (0.5, 1.0)},
                weights={"a": 0.5, "S": 0.5},
            )
            evidence = SequentialEvidence.of(problem, {"S"})
            answer = look(evidence, rule, progress, **settings)
            progress = answer.progress
            if isinstance(answer, Decided):
                return answer, counts, evidence
            counts.update(answer.replicates)

    return run


def rows_of(*failures):
    """Successes but for the failures of each alternative."""
    return {variant: [float(place not in places) for place in range(LENGTH)] for variant, places in failures}


# Each of the two fails in one of five trials, by other seeds: nobody knows which one keeps 0.8.
DOUBTFUL = rows_of((1, set(range(0, LENGTH, 5))), (2, set(range(2, LENGTH, 5))))
CLEAR = rows_of((1, {2, 9}), (2, set(range(0, LENGTH, 2))))
WORTHS = {1: 0.9, 2: 0.2}


def test_a_doubtful_choice_gets_the_reserve_and_ends_with_it(sweep):
    before, fewer, _ = sweep(DOUBTFUL, WORTHS, RULE, next_batch)
    after, more, evidence = sweep(DOUBTFUL, WORTHS, RESERVED, next_batch_with_reserve, seed=3)
    assert before.reason is after.reason is Reason.BUDGET
    assert sum(fewer.values()) == 40
    assert sum(more.values()) == 100
    assert probability_of_good_selection(evidence, after.variant, margin=RULE.margin, seed=3) < 0.9


def test_a_choice_that_is_probable_enough_leaves_the_reserve(sweep):
    _, fewer, evidence = sweep(CLEAR, WORTHS, RULE, next_batch)
    reached = probability_of_good_selection(evidence, 1, margin=RULE.margin, seed=3)
    assert 0.5 < reached < 1.0
    for wanted, spends in ((reached - 1e-6, False), (min(reached + 1e-4, 0.9999), True)):
        rule = replace(RESERVED, good_selection=wanted)
        answer, counts, _ = sweep(CLEAR, WORTHS, rule, next_batch_with_reserve, seed=3)
        assert answer.variant == 1
        assert (sum(counts.values()) > sum(fewer.values())) is spends


def test_it_ends_at_the_first_look_that_is_probable_enough(sweep):
    # Fails twice in the pilot and never again: the more replicates, the surer.
    rows = rows_of((1, {0, 1}), (2, set(range(0, LENGTH, 2))))
    answer, counts, evidence = sweep(rows, WORTHS, RESERVED, next_batch_with_reserve, seed=3)
    assert answer.reason is Reason.BUDGET
    assert 40 < sum(counts.values()) < 100
    assert probability_of_good_selection(evidence, 1, margin=RULE.margin, seed=3) >= 0.9


def test_without_a_reserve_or_while_the_budget_lasts_it_is_the_rule_itself(sweep):
    for rule in (RULE, replace(RULE, budget=None, finalists=None)):
        plain = sweep(DOUBTFUL, WORTHS, rule, next_batch)
        same = sweep(DOUBTFUL, WORTHS, rule, next_batch_with_reserve, seed=3)
        assert plain[:2] == same[:2]


@pytest.mark.parametrize(
    ("numbers", "message"),
    [
        ({"reserve": 10}, "reserve must be at least 1 replicate beyond a budget, got 10"),
        ({"reserve": 0, "budget": 20}, "reserve must be at least 1 replicate beyond a budget, got 0"),
        ({"good_selection": 0.0}, "good selection must be between 0 and 1, got 0"),
        ({"good_selection": 1.0}, "good selection must be between 0 and 1, got 1"),
    ],
)
def test_numbers_out_of_range_are_refused(numbers, message):
    with pytest.raises(TradeoffError, match=message):
        SequentialRule(**numbers)
