"""Minimax regret over bounded weights of a choice of levels, with more measures than corners can be listed for."""

from __future__ import annotations

import numpy as np
import pytest

from rgss.tradeoff import (
    DecisionStatus,
    ElicitedInterval,
    LevelFactor,
    LevelProblem,
    LevelSpace,
    LevelTable,
    MinimaxRegret,
    PiecewiseValue,
    WeightBounds,
    Weighting,
    decide_levels,
)
from rgss.tradeoff.programs.enumeration import enumerate_alternatives


def problem_of(count, seed):
    rng = np.random.default_rng(seed)
    factors = [f"f{place}" for place in range(3)]
    space = LevelSpace(factors=tuple(LevelFactor(id=one, levels=("a", "b", "c")) for one in factors), rules=())
    measures = [f"m{place}" for place in range(count)]
    return LevelProblem(
        space=space,
        tables={
            measure: tuple(
                LevelTable(
                    factors=(factor,),
                    entries={(level,): float(rng.uniform(0.0, 1.0 / 3.0)) for level in ("a", "b", "c")},
                )
                for factor in factors
            )
            for measure in measures
        },
        thresholds=(),
        value_functions=tuple(PiecewiseValue(measure=measure, worst=0.0, best=1.0) for measure in measures),
        weighting=Weighting(weights=dict.fromkeys(measures, 1.0 / count)),
        program=MinimaxRegret(),
        weight_bounds=WeightBounds(
            intervals=tuple(
                ElicitedInterval(name=measure, measures=(measure,), least=0.3 / count, most=min(1.0, 3.0 / count))
                for measure in measures
            )
        ),
    )


@pytest.mark.parametrize("count", [8, 12, 20])
def test_of_many_measures_as_by_enumeration(count):
    problem = problem_of(count, seed=count)
    decision = decide_levels(problem)
    assert decision.status is DecisionStatus.OPTIMAL
    assert decision.certificate.enumeration_agrees
    every = enumerate_alternatives(problem.enumerated())
    regrets = [every.ordering.at(row)[-1] for row in range(len(every.table))]
    assert decision.certificate.objective == pytest.approx(min(regrets), abs=1e-9)


@pytest.mark.parametrize("seed", range(4))
def test_weights_that_are_generated_come_to_what_all_corners_do(monkeypatch, seed):
    problem = problem_of(4, seed)
    by_corners = decide_levels(problem).certificate.objective
    monkeypatch.setattr("rgss.tradeoff.programs.weight_vertices.FEW_CANDIDATES", 0)
    by_programs = decide_levels(problem).certificate
    assert by_programs.objective == pytest.approx(by_corners, abs=1e-9)
    assert by_programs.enumeration_agrees
