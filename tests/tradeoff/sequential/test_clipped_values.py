"""Means beyond the ends of a value function, where no difference is worth anything: they are not certain there."""

from __future__ import annotations

import numpy as np
import pytest

from rgss.tradeoff import Alternative
from rgss.tradeoff.sequential.evidence import SequentialEvidence
from rgss.tradeoff.sequential.rule import SequentialRule
from rgss.tradeoff.sequential.sequential import Decided, Reason, next_batch
from rgss.tradeoff.sequential.settling import Progress

RULE = SequentialRule()
RUNS = 60
BEST_S, WORST_S = 5.0, 25.0


@pytest.fixture
def decided(build_problem):
    """Goes on until the rule ends, on times of alternatives that are worth as much without them."""

    def run(times, worths, unit=1.0):
        counts, progress = dict.fromkeys(times, RULE.pilot), Progress()
        while True:
            alternatives = tuple(
                Alternative(
                    variant=variant,
                    measures={"t": float(np.mean(row[: counts[variant]])), "a": worths[variant]},
                    samples={"t": tuple(row[: counts[variant]].tolist())},
                )
                for variant, row in times.items()
            )
            problem = build_problem(
                {},
                alternatives=alternatives,
                values={"a": (0.0, 1.0), "t": (WORST_S * unit, BEST_S * unit)},
                weights={"a": 0.5, "t": 0.5},
            )
            answer = next_batch(SequentialEvidence.of(problem, set()), RULE, progress)
            if isinstance(answer, Decided):
                return answer
            progress = answer.progress
            counts.update(answer.replicates)

    return run


def drawn(run, means_s, deviations_s, *, is_shared=False, unit=1.0):
    generator = np.random.default_rng(run)
    common = generator.standard_normal(RULE.cap)
    return {
        variant: unit * (mean + deviation * (common if is_shared else generator.standard_normal(RULE.cap)))
        for variant, (mean, deviation) in enumerate(zip(means_s, deviations_s, strict=True), start=1)
    }


def value_of(mean_s):
    return 0.5 * min(1.0, max(0.0, (WORST_S - mean_s) / (WORST_S - BEST_S)))


@pytest.mark.parametrize("means_s", [(3.0, 4.0), (27.0, 28.0), (3.0, 4.0, 3.5)])
def test_equals_do_not_beat_each_other_until_none_is_left(decided, means_s):
    for run in range(10):
        times = drawn(run, means_s, [0.5] * len(means_s))
        answer = decided(times, dict.fromkeys(times, 0.5))
        assert (answer.reason, answer.variant) == (Reason.DECIDED, 1)
        assert len(answer.contenders) == len(means_s)
        better = decided(times, dict.fromkeys(times, 0.5) | {2: 0.7})
        assert (better.reason, better.variant) == (Reason.DECIDED, 2)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("means_s", "deviations_s", "is_shared"),
    [
        ((9.5, 6.0), (14.0, 0.01), False),
        ((24.9, 20.0), (0.01, 14.0), False),
        ((9.0,) * 5 + (5.5,), (8.0,) * 5 + (0.01,), False),
        ((13.0, 9.0), (9.0, 9.0), False),
        # The noise is common, and one of both is where it is worth nothing.
        ((30.0, 14.0), (12.0, 12.0), True),
        ((3.0, 9.0), (12.0, 12.0), True),
    ],
)
def test_what_is_decided_is_wrong_no_more_often_than_the_rule_says(decided, means_s, deviations_s, is_shared):
    values = [value_of(mean_s) for mean_s in means_s]
    outcomes = [
        decided(drawn(run, means_s, deviations_s, is_shared=is_shared), dict.fromkeys(range(1, len(values) + 1), 0.5))
        for run in range(RUNS)
    ]
    certain = [answer for answer in outcomes if answer.reason is Reason.DECIDED]
    wrong = [answer for answer in certain if max(values) - values[answer.variant - 1] > RULE.margin + 1e-9]
    assert len(wrong) <= RULE.error_rate * RUNS
    assert len(certain) >= 0.8 * RUNS


@pytest.mark.parametrize("unit", [1e-8, 1e-3, 1e9])
def test_the_unit_of_a_measure_decides_nothing(decided, unit):
    for run in range(6):
        means_s, deviations_s = (13.0, 10.0), (7.0, 7.0)
        here = decided(drawn(run, means_s, deviations_s), {1: 0.5, 2: 0.5})
        there = decided(drawn(run, means_s, deviations_s, unit=unit), {1: 0.5, 2: 0.5}, unit)
        assert (there.reason, there.variant, there.progress.looks) == (here.reason, here.variant, here.progress.looks)
