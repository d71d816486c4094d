"""Shares of some trials alone, such as the successful ones: those of two alternatives are of different seeds."""

from __future__ import annotations

import numpy as np
import pytest

from rgss.tradeoff import Alternative
from rgss.tradeoff.sequential.evidence import SequentialEvidence
from rgss.tradeoff.sequential.rule import SequentialRule
from rgss.tradeoff.sequential.sequential import Decided, Reason, next_batch
from rgss.tradeoff.sequential.settling import Progress

RULE = SequentialRule(cap=200)
RUNS = 20


@pytest.fixture
def decided(build_problem):
    """Goes on until the rule ends, on shares with seeds that lack a value."""

    def run(rows, worths):
        counts, progress = dict.fromkeys(rows, RULE.pilot), Progress()
        while True:
            alternatives = tuple(
                Alternative(
                    variant=variant,
                    measures={"q": float(np.nanmean(row[: counts[variant]])), "a": worths[variant]},
                    samples={"q": tuple(None if np.isnan(one) else one for one in row[: counts[variant]].tolist())},
                )
                for variant, row in rows.items()
            )
            problem = build_problem(
                {},
                alternatives=alternatives,
                values={"a": (0.0, 1.0), "q": (0.0, 1.0)},
                weights={"a": 0.5, "q": 0.5},
            )
            answer = next_batch(SequentialEvidence.of(problem, {"q"}), RULE, progress)
            if isinstance(answer, Decided):
                return answer
            progress = answer.progress
            counts.update(answer.replicates)

    return run


@pytest.mark.parametrize("fails_the_hard_seeds", [True, False])
def test_what_fails_where_the_other_is_bad_is_not_taken_for_equal(decided, fails_the_hard_seeds):
    """The first has a share of 1 of its successes, the second of 0.8 of all: better by 0.07, above the margin."""
    found = []
    for run in range(RUNS):
        generator = np.random.default_rng(run)
        hard = generator.random(RULE.cap) < 0.2
        fails = hard if fails_the_hard_seeds else generator.random(RULE.cap) < 0.2
        rows = {1: np.where(fails, np.nan, 1.0), 2: np.where(hard, 0.0, 1.0)}
        answer = decided(rows, {1: 0.0, 2: 0.06})
        found.append(answer.reason is Reason.DECIDED and answer.variant)
    assert 2 not in found
    assert found.count(1) >= RUNS - 4
