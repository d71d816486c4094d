"""Alternatives that only a requirement keeps from being chosen, under programs that compare with all others."""

from __future__ import annotations

import dataclasses
import random

import pytest

from rgss.tradeoff import Aim, Comparison, Lexicographic, MinimaxRegret, decide

PROGRAMS = {
    "minimax_regret": MinimaxRegret(),
    "lexicographic": Lexicographic(
        aims=(
            Aim(measure="a", sense=Comparison.AT_LEAST, absolute=0.2),
            Aim(measure="b", sense=Comparison.AT_LEAST, absolute=0.1),
            Aim(measure="c", sense=Comparison.AT_LEAST),
        )
    ),
}


@pytest.mark.parametrize("program", list(PROGRAMS))
@pytest.mark.parametrize("seed", range(12))
def test_what_is_excluded_would_be_chosen_if_it_were_feasible_too(build_problem, program, seed):
    """The oracle decides anew, over the feasible alternatives and the one, without any requirement."""
    rng = random.Random(seed)  # noqa: S311 - a sample, no secret
    measures = {number: {name: rng.random() for name in "abcd"} for number in range(1, 13)}
    problem = dataclasses.replace(
        build_problem(
            measures,
            thresholds=[("R-1", "d", ">=", 0.5)],
            values=dict.fromkeys("abc", (0.0, 1.0)),
            weights={"a": 0.3, "b": 0.3, "c": 0.4},
        ),
        program=PROGRAMS[program],
    )
    decision = decide(problem)
    allowed = [one for one in problem.alternatives if measures[one.variant]["d"] >= 0.5]
    expected = set()
    for out in problem.alternatives:
        if out not in allowed:
            among = dataclasses.replace(problem, alternatives=(*allowed, out), thresholds=())
            expected |= {out.variant} & set(decide(among).ties)
    assert {one.variant for one in decision.excluded_better} == expected
    assert decision.counts.excluded_better == len(expected)
