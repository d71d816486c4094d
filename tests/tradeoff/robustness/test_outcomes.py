"""From a trade-off to tables: values, admitted weights, outcomes of the noise."""

from __future__ import annotations

import numpy as np
import pytest

from rgss.tradeoff import (
    Alternative,
    ChanceBound,
    Comparison,
    ElicitedInterval,
    ElicitedOrder,
    PiecewiseValue,
    Threshold,
    TradeProblem,
    WeightBounds,
    Weighting,
)
from rgss.tradeoff.infeasibility.noise import resampled_tables
from rgss.tradeoff.problem.evidence_table import tabulated
from rgss.tradeoff.problem.resampling import bootstrap
from rgss.tradeoff.programs.columns import single_values
from rgss.tradeoff.robustness.outcomes import (
    admitted_weights,
    common_replicates,
    condition_masks,
    noisy_outcomes,
)


def problem_of(samples, **changes):
    """Two alternatives with a measure t over replicates and a cost that follows from the design."""
    alternatives = []
    for variant, row in enumerate(samples, start=1):
        known = [value for value in row if value is not None]
        alternatives.append(
            Alternative(
                variant=variant,
                measures={"t": sum(known) / len(known) if known else None, "cost": 10.0 * variant},
                samples={"t": tuple(row)},
            )
        )
    given = {
        "alternatives": tuple(alternatives),
        "thresholds": (Threshold(requirement="R-1", measure="t", comparison=Comparison.AT_MOST, value=4.0, unit="s"),),
        "value_functions": (
            PiecewiseValue(measure="t", worst=5.0, best=0.0),
            PiecewiseValue(measure="cost", worst=50.0, best=0.0),
        ),
        "weighting": Weighting(weights={"t": 0.6, "cost": 0.4}),
    }
    return TradeProblem(**{**given, **changes})


def resamples_of(count):
    return bootstrap(count, draws=1, generator=np.random.default_rng(0))


def test_values_of_measures_with_a_weight():
    problem = problem_of([(1.0, 3.0), (2.0, None)])

    assert single_values(problem, tabulated(problem.alternatives)) == pytest.approx(np.array([[0.6, 0.8], [0.6, 0.6]]))
    idle = problem_of([(1.0, 3.0), (2.0, None)], weighting=Weighting(weights={"t": 1.0, "cost": 0.0}))
    assert single_values(idle, tabulated(idle.alternatives)).shape == (2, 1)


def test_outcomes_by_hand():
    """Draws (1, 1), (1, 2) and (2, 2) of two replicates: means 1, 2 and 5 of the first, and what misses 4 s."""
    problem = problem_of([(1.0, 9.0), (2.0, None)])
    found = noisy_outcomes(problem, tabulated(problem.alternatives), resamples_of(2))
    by_counts = dict(zip(map(tuple, resamples_of(2).counts), range(3), strict=True))

    assert found.values[by_counts[2, 0]] == pytest.approx(np.array([[0.8, 0.8], [0.6, 0.6]]))
    assert found.feasible[by_counts[2, 0]].tolist() == [True, True]
    assert found.feasible[by_counts[1, 1]].tolist() == [False, True]
    assert found.feasible[by_counts[0, 2]].tolist() == [False, False]
    assert np.isnan(found.values[by_counts[0, 2]][1, 0])
    assert found.probabilities[by_counts[1, 1]] == pytest.approx(0.5)


def test_demands_on_replicates_are_judged_by_those_of_the_draw():
    chance = ChanceBound(
        requirement="chance:R-1", measure="t", comparison=Comparison.AT_MOST, value=4.0, unit="s", probability=0.5
    )
    problem = problem_of([(1.0, 9.0), (2.0, 3.0)], thresholds=(), risks=(chance,))
    tables = resampled_tables(tabulated(problem.alternatives), resamples_of(2))
    kept = {
        tuple(counts): condition_masks(problem, table)[0].tolist()
        for counts, table in zip(resamples_of(2).counts, tables, strict=True)
    }

    assert kept == {(2, 0): [True, True], (1, 1): [True, True], (0, 2): [False, True]}


def test_admitted_weights_are_what_was_elicited():
    assert admitted_weights(problem_of([(1.0,), (2.0,)])).is_simplex
    bounds = WeightBounds(
        intervals=(ElicitedInterval(name="t", measures=("t",), least=0.5, most=0.7),),
        orders=(
            ElicitedOrder(heavier="t", heavier_measures=("t",), lighter="cost", lighter_measures=("cost",), times=1.2),
        ),
    )
    admitted = admitted_weights(problem_of([(1.0,), (2.0,)], weight_bounds=bounds))
    rows, limits = admitted.conditions()

    for share, inside in ((0.52, False), (0.55, True), (0.69, True), (0.71, False)):
        assert (rows @ np.array([share, 1 - share]) <= limits + 1e-12).all() == inside
    fixed = WeightBounds(intervals=(ElicitedInterval(name="t", measures=("t",), least=0.6, most=0.6),))
    assert admitted_weights(problem_of([(1.0,), (2.0,)], weight_bounds=fixed)).directions().shape == (2, 0)


def test_the_replicates_that_all_alternatives_have():
    assert common_replicates(tabulated(problem_of([(1.0, 3.0), (2.0, None)]).alternatives)) == 2
    assert common_replicates(tabulated(problem_of([(1.0, 3.0, 4.0), (2.0,)]).alternatives)) == 1
