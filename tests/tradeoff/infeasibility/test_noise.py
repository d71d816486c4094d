"""Whether a conflict stands up to the noise of the replicates."""

from __future__ import annotations

import math
from statistics import NormalDist

import numpy as np
import pytest

from rgss.tradeoff import Alternative, ChanceBound, Comparison, TailBound, decide
from rgss.tradeoff.infeasibility.noise import resampled_tables
from rgss.tradeoff.problem.evidence_table import tabulated
from rgss.tradeoff.problem.resampling import bootstrap


def one(variant, rows, **measures):
    means = {name: sum(row) / len(row) for name, row in rows.items()}
    return Alternative(variant=variant, measures=means | measures, samples=rows)


def draws(replicates, count=1000):
    return bootstrap(replicates, draws=count, generator=np.random.default_rng(3))


def test_a_clear_conflict_survives_and_a_narrow_one_half_of_the_time(build_problem):
    narrow = one(1, {"a": (0.38, 0.46, 0.53, 0.60)})
    problem = build_problem({}, alternatives=(narrow,), thresholds=[("R", "a", ">=", 0.5)])
    survival = decide(problem).conflicts.survival
    # Of the 256 draws of four, those with a mean below 0.5, by counting.
    rows = np.array(np.meshgrid(*[narrow.samples["a"]] * 4)).reshape(4, -1)
    below = float((rows.mean(axis=0) < 0.5).mean())
    # Of four replicates there are C(7, 4) distinct draws, so nothing is left to chance.
    assert (survival.resamples, survival.exact) == (35, True)
    assert survival.nothing_feasible == pytest.approx(below, abs=1e-12)
    assert survival.conflicts == (survival.nothing_feasible,)
    clear = one(1, {"a": (0.1, 0.2, 0.3, 0.2)})
    problem = build_problem({}, alternatives=(clear,), thresholds=[("R", "a", ">=", 0.5)])
    assert decide(problem).conflicts.survival.nothing_feasible == 1.0


def test_each_conflict_has_its_own_share(build_problem):
    """R-a alone is narrow; R-b alone, which follows from the design, is not to be met at all."""
    problem = build_problem(
        {},
        alternatives=(one(1, {"a": (0.3, 0.4, 0.7)}, b=0.0),),
        thresholds=[("R-a", "a", ">=", 0.5), ("R-b", "b", ">=", 0.5)],
    )
    conflicts = decide(problem).conflicts
    assert conflicts.minimal_conflicts == (("R-a",), ("R-b",))
    assert conflicts.survival.nothing_feasible == 1.0
    assert 0.3 < conflicts.survival.conflicts[0] < 0.9
    assert conflicts.survival.conflicts[1] == 1.0


def test_of_many_replicates_draws_are_sampled(build_problem):
    rows = tuple(0.4 + 0.01 * place for place in range(20))
    problem = build_problem({}, alternatives=(one(1, {"a": rows}),), thresholds=[("R", "a", ">=", 0.5)])
    shares = [decide(problem, seed=seed).conflicts.survival for seed in (1, 1, 2)]
    assert (shares[0].resamples, shares[0].exact) == (1000, False)
    assert shares[0] == shares[1] != shares[2]
    assert decide(problem, resamples=0).conflicts.survival is None
    assert decide(problem, resamples=7).conflicts.survival.resamples == 7
    # The mean of 20 draws is about normal around 0.495 with the deviation σ / √20.
    deviation = float(np.std(rows)) / math.sqrt(20)
    expected = NormalDist(0.495, deviation).cdf(0.5)
    assert shares[0].nothing_feasible == pytest.approx(expected, abs=0.05)


def test_without_two_replicates_there_is_no_noise_to_tell(build_problem):
    for alternatives in ((one(1, {"a": (0.3,)}),), (one(1, {}, a=0.3),)):
        problem = build_problem({}, alternatives=alternatives, thresholds=[("R", "a", ">=", 0.5)])
        assert decide(problem).conflicts.survival is None


def test_one_draw_of_seeds_serves_every_alternative():
    """The second is the first plus 1 in each replicate, and so it stays in each draw."""
    table = tabulated((one(1, {"a": (0.1, 0.5, 0.9, 0.3)}), one(2, {"a": (1.1, 1.5, 1.9, 1.3)})))
    means = [drawn.column("a") for drawn in resampled_tables(table, draws(4))]
    assert np.ptp([mean[0] for mean in means]) > 0.1
    for mean in means:
        assert mean[1] - mean[0] == pytest.approx(1.0)


def test_an_end_of_an_interval_moves_with_the_mean():
    shifted = Alternative(variant=1, measures={"S.low": 0.44}, samples={"S.low": (0.44, 0.44, 0.44)})
    for drawn in resampled_tables(tabulated((shifted,)), draws(3)):
        assert drawn.column("S.low").tolist() == [0.44]


def test_fewer_replicates_of_one_alternative():
    table = tabulated(
        (
            Alternative(variant=1, measures={"a": 0.5}, samples={"a": tuple(float(n) for n in range(20))}),
            Alternative(variant=2, measures={"a": 3.0}, samples={"a": (3.0,)}),
            Alternative(variant=3, measures={"a": None}, samples={"a": (None, None)}),
        )
    )
    for drawn in resampled_tables(table, draws(20, count=20)):
        column = drawn.column("a")
        assert column[1] == 3.0
        assert math.isnan(column[2])
        assert drawn.replicates("a").ran.any(axis=1).all()


def test_chances_and_tails_are_drawn_anew_too(build_problem):
    common = {"measure": "a", "comparison": Comparison.AT_LEAST, "unit": "1"}
    chance = ChanceBound(requirement="chance:a", value=0.5, probability=0.75, **common)
    tail = TailBound(requirement="tail:a", value=0.3, share=0.25, **common)
    problem = build_problem({}, alternatives=(one(1, {"a": (0.1, 0.3, 0.7, 0.9)}),), risks=(chance, tail))
    survival = decide(problem).conflicts.survival
    # P[at least 3 of 4 draws are of the two good ones] = 5/16; P[no draw is the worst] = (3/4)^4.
    assert survival.conflicts[0] == pytest.approx(11 / 16)
    assert survival.conflicts[1] == pytest.approx(1 - (3 / 4) ** 4)
