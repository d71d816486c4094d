"""Minimax regret over bounded weights of many measures, compared with corners and with programs for every pair."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.optimize import linprog

from rgss.errors import TradeoffError
from rgss.tradeoff import (
    Alternative,
    Comparison,
    ElicitedInterval,
    ElicitedOrder,
    MinimaxRegret,
    PiecewiseValue,
    Threshold,
    TradeProblem,
    WeightBounds,
    Weighting,
    best_alternatives,
    decide,
)
from rgss.tradeoff.problem.evidence_table import tabulated
from rgss.tradeoff.programs import minimax_regret, weight_vertices
from rgss.tradeoff.programs.enumeration import enumerate_alternatives
from rgss.tradeoff.programs.program_orderings import orderings_of
from rgss.tradeoff.programs.weight_regret import WeightRegret
from rgss.tradeoff.programs.worst_weights import WeightProgram
from rgss.tradeoff.robustness.acceptability import Outcomes, smaa2
from rgss.tradeoff.robustness.flip import weight_shifts
from rgss.tradeoff.robustness.outcomes import admitted_weights
from rgss.tradeoff.weights import weight_region
from rgss.tradeoff.weights.sampling import Drawing, sample_weights
from rgss.tradeoff.weights.weight_region import ShareBy, winning_regions


def problem_of(seed, count, number, *, fixed=False, grouped=False):
    """Random alternatives of which one in eight is infeasible, with bounds, an order, a group and a fixed weight."""
    rng = np.random.default_rng(seed)
    names = tuple(f"m{place:02}" for place in range(count))
    weights = dict(zip(names, rng.dirichlet(np.ones(count)).tolist(), strict=True))
    heaviest, lightest = max(names, key=weights.get), min(names, key=weights.get)
    intervals = [
        ElicitedInterval(
            name=name,
            measures=(name,),
            least=max(0.0, weights[name] - rng.random() * 0.3),
            most=min(1.0, weights[name] + rng.random() * 0.3),
        )
        for name in names
    ]
    if fixed:
        name = names[1]
        intervals[1] = ElicitedInterval(name=name, measures=(name,), least=weights[name], most=weights[name])
    if grouped:
        group = names[: count // 2]
        share = weights[group[0]] / sum(weights[name] for name in group)
        intervals.append(
            ElicitedInterval(
                name="share", measures=group[:1], within=group, least=0.8 * share, most=min(1.0, 1.2 * share)
            )
        )
    order = ElicitedOrder(
        heavier=heaviest, heavier_measures=(heaviest,), lighter=lightest, lighter_measures=(lightest,)
    )
    quantities = rng.random((number, count)).round(3)
    return TradeProblem(
        alternatives=tuple(
            Alternative(variant=variant, measures=dict(zip(names, row, strict=True)))
            for variant, row in enumerate(quantities.tolist(), start=1)
        ),
        thresholds=(
            Threshold(requirement="R-1", measure=names[0], comparison=Comparison.AT_LEAST, value=0.125, unit="1"),
        ),
        value_functions=tuple(PiecewiseValue(measure=name, worst=0.0, best=1.0) for name in names),
        weighting=Weighting(weights=weights),
        program=MinimaxRegret(),
        weight_bounds=WeightBounds(intervals=tuple(intervals), orders=(order,)),
    )


def values_of(problem):
    table = tabulated(problem.alternatives)
    return np.stack([table.column(measure) for measure in problem.weighting.weights], axis=1)


def feasible_rows(problem):
    return values_of(problem)[:, 0] >= 0.125


def regrets_by_corners(problem):
    values, feasible = values_of(problem), feasible_rows(problem)
    corners = weight_vertices.weight_vertices(*problem.weight_system())
    worths = values @ corners.T
    return (worths[feasible].max(axis=0) - worths).max(axis=1)


def regrets_by_pairs(problem):
    """A program of SciPy's for every pair: nothing is pruned and nothing is shared."""
    values, feasible = values_of(problem), feasible_rows(problem)
    rows, limits = problem.weight_system()
    size = values.shape[1]
    worst = np.full(len(values), -np.inf)
    for at, mine in enumerate(values):
        for other in values[feasible]:
            found = linprog(
                mine - other, A_ub=rows, b_ub=limits, A_eq=np.ones((1, size)), b_eq=[1.0], method="highs-ipm"
            )
            worst[at] = max(worst[at], -found.fun)
    return worst


@pytest.fixture
def generated(monkeypatch):
    """Corners are never listed."""
    monkeypatch.setattr(weight_vertices, "FEW_CANDIDATES", 0)


@pytest.mark.parametrize("count", [3, 4, 5, 6, 7])
@pytest.mark.parametrize("seed", range(3))
@pytest.mark.usefixtures("generated")
def test_it_agrees_with_all_corners(seed, count):
    problem = problem_of(seed, count, 25, fixed=seed == 1, grouped=seed == 2)
    expected = regrets_by_corners(problem)
    found = WeightRegret(values_of(problem), *problem.weight_system()).of_all(feasible_rows(problem))
    decision = decide(problem)
    best = np.where(feasible_rows(problem), expected, np.inf)

    assert found == pytest.approx(expected, abs=1e-9)
    assert decision.chosen == int(best.argmin()) + 1
    assert decision.certificate.objective == pytest.approx(best.min(), abs=1e-9)
    assert decision.certificate.stages[-1].name == "regret"


@pytest.mark.parametrize(("count", "number"), [(8, 20), (9, 20), (12, 15), (20, 15)])
def test_it_agrees_with_a_program_for_every_pair(count, number):
    """So many measures that their corners cannot be listed."""
    problem = problem_of(count, count, number, fixed=count == 12, grouped=count == 20)
    expected = regrets_by_pairs(problem)
    decision = decide(problem)
    best = np.where(feasible_rows(problem), expected, np.inf)

    assert -enumerate_alternatives(problem).ordering.scores == pytest.approx(expected, abs=1e-8)
    assert decision.chosen == int(best.argmin()) + 1
    assert decision.certificate.objective == pytest.approx(best.min(), abs=1e-8)


def test_other_feasible_sets_start_from_the_same_bounds():
    """Bounds that were found against some rivals hold against others."""
    problem = problem_of(5, 10, 30)
    table = tabulated(problem.alternatives)
    shared = orderings_of(problem.program, problem, table)
    for seed in range(6):
        rivals = np.random.default_rng(seed).random(30) < 0.5
        fresh = WeightRegret(values_of(problem), *problem.weight_system()).of_all(rivals)
        assert -shared(rivals).scores == pytest.approx(fresh, abs=1e-9)


def test_the_best_without_those_before():
    problem = problem_of(3, 9, 20)
    first, second = best_alternatives(problem, 2)
    others = [one for one in problem.alternatives if one.variant != first.solver_choice]
    alone = TradeProblem(
        alternatives=others,
        thresholds=problem.thresholds,
        value_functions=problem.value_functions,
        weighting=problem.weighting,
        program=problem.program,
        weight_bounds=problem.weight_bounds,
    )

    assert second.solver_choice == decide(alone).chosen


def test_unknown_values_and_no_rivals():
    values = np.array([[0.2, 0.8], [np.nan, 0.5], [0.6, 0.1]])
    regret = WeightRegret(values, np.zeros((0, 2)), np.zeros(0))

    assert np.isnan(regret.of_all(np.zeros(3, dtype=bool))).all()
    assert regret.of_all(np.array([True, False, True])) == pytest.approx([0.4, np.nan, 0.7], nan_ok=True)


def test_what_is_not_proven_is_not_an_answer(monkeypatch):
    monkeypatch.setattr(minimax_regret, "MOST_GENERATED", 1)
    with pytest.raises(TradeoffError, match=r"not proven after 1 weights: the best choice so far is"):
        decide(problem_of(3, 9, 20))


def test_bounds_that_contradict_each_other():
    with pytest.raises(TradeoffError, match="no weights satisfy all the elicited bounds"):
        WeightProgram(np.array([[1.0, 1.0]]), np.array([0.5])).maximise(np.ones(2))


def test_multipliers_bound_every_objective():
    rng = np.random.default_rng(2)
    problem = problem_of(4, 9, 2)
    rows, limits = problem.weight_system()
    program = WeightProgram(rows, limits)
    for _ in range(20):
        first, other = rng.normal(size=9), rng.normal(size=9)
        optimum = program.maximise(first)
        bounds = [limits @ optimum.multipliers + (c - rows.T @ optimum.multipliers).max() for c in (first, other)]
        assert (rows @ optimum.weights <= limits + 1e-9).all()
        assert bounds[0] == pytest.approx(optimum.value, abs=1e-9)
        assert bounds[1] >= program.maximise(other).value - 1e-9


@pytest.mark.parametrize("count", [8, 12, 20])
def test_regions_and_acceptability_of_many_bounded_measures(monkeypatch, count):
    """Bounds that rejection cannot draw from: shares sum to 1, draws keep the bounds, first ranks agree with shares."""
    monkeypatch.setattr(weight_region, "WALKED_SAMPLES", 1_000)
    problem = problem_of(count, count, 12, fixed=count == 12)
    admitted, values, feasible = admitted_weights(problem), values_of(problem), feasible_rows(problem)
    rng = np.random.default_rng(0)
    regions = winning_regions(values, feasible, admitted, generator=rng)
    indices = smaa2(Outcomes.certain(values, feasible), admitted, iterations=1_000, generator=rng)
    shifts = weight_shifts(values, feasible, np.array(list(problem.weighting.weights.values())), among=admitted)
    drawn = sample_weights(admitted, 500, rng)
    rows, limits = problem.weight_system()

    assert drawn.drawn_by is indices.drawn_by is Drawing.HIT_AND_RUN
    assert (drawn.weights @ rows.T <= limits + 1e-8).all()
    assert drawn.weights.sum(axis=1) == pytest.approx(np.ones(500))
    assert sum(region.share for region in regions) == pytest.approx(1.0)
    assert {region.share_by for region in regions if region.share_error} <= {ShareBy.HIT_AND_RUN}
    for region, first in zip(regions, indices.first, strict=True):
        assert region.share == pytest.approx(first, abs=0.08)
        assert region.centre is not None or first == 0.0
    assert shifts[0].distance == 0.0


INTERVALS = {
    0: (0.06, 0.25),
    1: (0.04, 0.16),
    2: (0.02, 0.2),
    3: (0.01, 0.24),
    6: (0.03, 0.2),
    7: (0.09, 0.15),
    8: (0.05, 0.12),
    9: (0.06, 0.19),
    10: (0.01, 0.24),
}
"""Bounds of nine of eleven weights."""

LEADS = (
    (-0.5432006867, -2.59e-08, -0.2161272711, 0.0, -0.4739758204, -1.149e-07, 0.0, 0.0, 0.0, 0.4364198097, 0.0),
    (-0.5432006867, -2.07938e-05, -0.1817484786, 0.0, -0.4739758204, 2.375e-07, 0.0, 2 / 3, 0.0, 1.0, 0.0),
    (-0.5432006867, -0.0016196023, -0.0802721993, 0.0, -0.4739758204, 2.379e-07, 0.0, 1 / 3, 0.0, 0.0, 0.0),
    (-0.5432006867, -0.003436011, -0.1453775692, 0.0, -0.4739758204, -0.7314088865, 0.0, 1 / 3, 0.0, 0.0, 0.0),
    (-0.5432006867, -0.0875714598, -0.0095579735, 0.0, -0.3307315826, 2.378e-07, 0.0, 0.0, 0.0, 1.0, 0.0),
    (-0.5842165931, 0.0, -0.0368526109, 0.0, -0.4739758204, -4.46406e-05, 0.0, 0.0, 0.0, 0.0, 0.0),
    (-0.5842165931, 0.0, -0.1308787113, 0.0, -0.4739758204, 2.379e-07, 0.0, 0.0, 0.0, 1.0, 2e-10),
    (-0.5842165931, 0.0, -0.2088579505, 0.0, -0.4739758204, -2.789e-06, 0.0, -1 / 3, 0.0, 0.0, 0.0),
    (-0.5842165931, 0.0, -0.0263464864, 0.0, -0.3332410836, 2.379e-07, 0.0, -1 / 3, 0.0, 0.8087108581, 2e-10),
    (-0.5842165931, 0.0, -0.2992061875, 0.0, -0.1809149163, 1.793e-07, 0.0, 2 / 3, 0.0, 1.0, 0.0),
)
"""Leads of one design after another, the last of which HiGHS 1.15 does not solve from the optimum of those before."""


def test_a_program_that_ends_without_an_answer_is_solved_from_scratch():
    rows = np.array([sign * np.eye(11)[place] for place in INTERVALS for sign in (1.0, -1.0)])
    limits = np.array([end for least, most in INTERVALS.values() for end in (most, -least)])
    least = np.array([INTERVALS.get(place, (0.0, 1.0))[0] for place in range(11)])
    most = np.array([INTERVALS.get(place, (0.0, 1.0))[1] for place in range(11)])
    program = WeightProgram(rows, limits)
    for lead in map(np.array, LEADS):
        # What is left beyond the least weights goes to the greatest leads first.
        weights, rest = least.copy(), 1.0 - least.sum()
        for place in np.argsort(-lead):
            more = min(rest, most[place] - least[place])
            weights[place] += more
            rest -= more
        assert program.maximise(lead).value == pytest.approx(float(lead @ weights), abs=1e-9)
