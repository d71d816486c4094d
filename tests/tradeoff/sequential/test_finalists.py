"""A budget that is spent on the leading alternatives, all with the same seeds."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from rgss.errors import TradeoffError
from rgss.tradeoff import Alternative
from rgss.tradeoff.sequential import Decided, Progress, SequentialEvidence, SequentialRule, next_batch
from rgss.tradeoff.sequential.allocation import leaders, levelled

RULE = SequentialRule(pilot=4, batch=4, cap=40, verdict_cap=4, budget=140, finalists=3)


@pytest.fixture
def evidence_of(build_problem):
    """Evidence of rows of successes, of which each alternative has so many, and a worth that the design fixes."""

    def build(rows, worths, counts=None, *, tolerance=0.0, last_of_equals=False):
        counts = counts or {variant: len(row) for variant, row in rows.items()}
        alternatives = tuple(
            Alternative(
                variant=variant,
                measures={"S": float(np.mean(row[: counts[variant]])), "a": worths[variant]},
                samples={"S": tuple(float(each) for each in row[: counts[variant]])},
            )
            for variant, row in rows.items()
        )
        problem = build_problem(
            {},
            alternatives=alternatives,
            thresholds=[("R-1", "S", ">=", 0.9)],
            values={"a": (0.0, 1.0), "S": (0.8, 1.0)},
            weights={"a": 0.5, "S": 0.5},
        )
        return SequentialEvidence.of(problem, {"S"}, tolerance=tolerance, last_of_equals=last_of_equals)

    return build


def failing(*places, length=40):
    """Successes but for some trials."""
    return [float(place not in places) for place in range(length)]


def test_the_choice_leads_then_who_may_come_to_be_chosen(evidence_of):
    # 35 of 40 are 0.875, and 0.93 with a standard error more: worth 0.5 * 0.9 + 0.5 * 0.65 then, above 0.1 + 0.5 of
    # variant 2. Variant 4 would be worth the most and misses the threshold by far.
    rows = {1: failing(1, 2, 3, 4, 5), 2: failing(), 3: failing(1), 4: failing(*range(30))}
    worths = {1: 0.9, 2: 0.2, 3: 0.9, 4: 1.0}
    evidence = evidence_of(rows, worths)
    assert leaders(evidence, Progress(), 4, cap=41) == (3, 1, 2, 4)
    assert leaders(evidence, Progress(), 2, cap=41) == (3, 1)
    assert leaders(evidence, Progress(dropped={3: "infeasible", 1: "beaten"}), 2, cap=41) == (2, 1)
    assert leaders(evidence, Progress(dropped={3: "infeasible", 1: "infeasible"}), 2, cap=41) == (2, 4)


def test_an_unlucky_pilot_ends_nobody(evidence_of):
    rows = {1: failing(1, 2), 2: failing(*range(20))}
    assert leaders(evidence_of(rows, {1: 0.9, 2: 0.95}, {1: 4, 2: 40}), Progress(), 1, cap=41) == (1,)


def test_equals_of_the_choice_lead_with_it(evidence_of):
    rows = dict.fromkeys((1, 2, 3, 4), failing())
    evidence = evidence_of(rows, {1: 0.5, 2: 0.6, 3: 0.6, 4: 0.6})
    assert leaders(evidence, Progress(), 2, cap=41) == (2, 3, 4)


def test_who_has_as_many_as_are_allowed_gives_up_its_place(evidence_of):
    rows = {1: failing(), 2: failing(1), 3: failing(1, 2), 4: failing(1, 2, 3), 5: failing(*range(4))}
    counts = {1: 40, 2: 40, 3: 12, 4: 40, 5: 4}
    evidence = evidence_of(rows, dict.fromkeys(rows, 0.5), counts)
    assert leaders(evidence, Progress(), 2, cap=41) == (1, 2)
    assert leaders(evidence, Progress(), 2, cap=40) == (1, 2, 4, 3, 5)
    assert levelled(evidence, replace(RULE, budget=1000), (1, 2, 3, 4, 5)) == {5: 8}


def test_an_unlucky_pilot_is_made_up_for_when_the_others_have_all_they_may(evidence_of):
    # Variant 4 is the best and fails in two of its first four trials only: worse, even with a standard error more, than
    # three that hold the places of the finalists to the end.
    rows = {1: failing(9, 19), 2: failing(9, 19), 3: failing(9, 19), 4: failing(0, 1, length=200)}
    rows = {variant: row + [1.0] * (200 - len(row)) for variant, row in rows.items()}
    worths, counts, progress = {1: 0.6, 2: 0.5, 3: 0.4, 4: 0.9}, dict.fromkeys(rows, RULE.pilot), Progress()
    rule = replace(RULE, budget=160)
    while True:
        answer = next_batch(evidence_of(rows, worths, counts), rule, progress)
        progress = answer.progress
        if isinstance(answer, Decided):
            break
        counts.update(answer.replicates)
    assert counts == {1: 40, 2: 40, 3: 40, 4: 40}
    assert answer.variant == 4


def test_hopes_are_estimates_and_a_standard_error(evidence_of):
    rows = {1: failing(0), 2: failing(), 3: failing(0, 1, 2)}
    evidence = evidence_of(rows, dict.fromkeys(rows, 0.5), {1: 4, 2: 40, 3: 4}, tolerance=0.05)
    hopes = evidence.hopes()
    error = math.sqrt((4 / 6) * (2 / 6) / 4)
    assert hopes.values == pytest.approx([0.25 + 0.5 * (0.75 + error - 0.8) / 0.2, 0.75, 0.25])
    assert hopes.shortfalls == pytest.approx([0.0, 0.0, (0.855 - 0.25 - error) / 0.855])


def test_they_are_brought_to_the_same_number(evidence_of):
    rows = {1: failing(), 2: failing(), 3: failing()}
    evidence = evidence_of(rows, dict.fromkeys(rows, 0.5), {1: 12, 2: 4, 3: 8})
    assert levelled(evidence, RULE, (1, 2, 3)) == {2: 8}
    assert levelled(evidence, RULE, (1, 3)) == {3: 12}
    assert levelled(evidence, replace(RULE, budget=26), (1, 2, 3)) == {2: 6}
    assert levelled(evidence, replace(RULE, budget=24), (1, 2, 3)) == {}
    assert levelled(evidence, replace(RULE, cap=4), (2,)) == {}


def test_who_leads_by_a_few_lucky_trials_gets_as_many_as_the_others(evidence_of):
    # Variant 4 has no failure in the pilot and fails in every second trial after it.
    rows = {1: failing(9, 19), 2: failing(9, 19), 3: failing(9), 4: failing(*range(5, 40, 2)), 5: failing(*range(30))}
    worths = {1: 0.6, 2: 0.6, 3: 0.4, 4: 0.7, 5: 1.0}
    counts, progress = dict.fromkeys(rows, RULE.pilot), Progress()
    while True:
        answer = next_batch(evidence_of(rows, worths, counts, last_of_equals=True), RULE, progress)
        progress = answer.progress
        if isinstance(answer, Decided):
            break
        counts.update(answer.replicates)
    assert counts[5] == RULE.pilot
    assert counts[1] == counts[2] == counts[3] > counts[4] > RULE.pilot
    assert sum(counts.values()) <= 140
    assert answer.variant == 2


def test_of_equals_beyond_the_end_of_a_value_function_the_better_one_is_the_choice(evidence_of):
    """As in the decision: all three worths are above 1, of which no more is worth anything."""
    rows = dict.fromkeys((1, 2, 3), failing(length=4))
    for last, expected in ((False, 2), (True, 3)):
        evidence = evidence_of(rows, {1: 1.2, 2: 1.5, 3: 1.5}, last_of_equals=last)
        answer = next_batch(evidence, replace(RULE, budget=12, cap=4), Progress())
        assert answer.variant == expected


def test_one_finalist_is_refused():
    with pytest.raises(TradeoffError, match="finalists must be at least 2, got 1"):
        SequentialRule(finalists=1)
