from __future__ import annotations

import math
from statistics import NormalDist

import numpy as np
import pytest

from rgss.measures import bounded_mean_evidence, proportion_evidence
from rgss.measures.mean_limits import mean_limits
from rgss.tradeoff.sequential.tests import (
    difference_above,
    mean_above,
    mean_evidence,
)


def test_evidence_for_a_proportion_is_the_integral_that_it_stands_for():
    from scipy.integrate import quad

    def weight(q):
        return 1.0 / math.sqrt(q * (1.0 - q))

    above = quad(lambda q: q**18 * (1 - q) ** 2 * weight(q), 0.7, 1.0)[0] / quad(weight, 0.7, 1.0)[0]
    assert proportion_evidence(18, 20, 0.7, above=True) == pytest.approx(math.log(above / (0.7**18 * 0.3**2)), rel=1e-6)
    below = quad(lambda q: q**5 * (1 - q) ** 15 * weight(q), 0.0, 0.7)[0] / quad(weight, 0.0, 0.7)[0]
    assert proportion_evidence(5, 20, 0.7, above=False) == pytest.approx(math.log(below / (0.7**5 * 0.3**15)), rel=1e-6)


def test_nothing_is_above_a_certainty_and_a_success_is_above_nothing():
    assert proportion_evidence(10, 10, 1.0, above=True) == -math.inf
    assert proportion_evidence(1, 10, 0.0, above=True) == math.inf
    assert proportion_evidence(0, 10, 0.0, above=True) == 0.0


@pytest.mark.parametrize("chance", [0.5, 0.9, 0.97])
def test_a_proportion_is_seldom_ever_called_above_itself(chance):
    level, trials, runs = 0.1, 200, 1500
    needed = math.log(1.0 / level)
    # Evidence rises with the successes: the fewest that reject at each look is all that is needed.
    reject = np.array(
        [
            next((s for s in range(n + 1) if proportion_evidence(s, n, chance, above=True) >= needed), n + 1)
            for n in range(1, trials + 1)
        ]
    )
    successes = (np.random.default_rng(1).random((runs, trials)) < chance).cumsum(axis=1)
    errors = float((successes >= reject).any(axis=1).mean())
    assert errors <= level + 3.0 * math.sqrt(level * (1.0 - level) / runs)
    assert errors > 0.0


def test_a_normal_mean_is_seldom_ever_outside_of_its_bound_and_a_skewed_one_hardly_more():
    level, runs = 0.1, 600
    generator = np.random.default_rng(2)
    for draw, centre in ((generator.standard_normal, 0.0), (generator.standard_exponential, 1.0)):
        errors = 0
        for _ in range(runs):
            values = draw(120)
            errors += any(mean_above(values[:n], level) < centre for n in range(8, 121, 4))
        assert errors / runs <= level + 3.0 * math.sqrt(level * (1.0 - level) / runs)


def test_the_bound_of_a_mean_is_where_the_evidence_reaches_the_level():
    values = np.random.default_rng(3).normal(5.0, 2.0, 40)
    bound = mean_above(values, 0.01)
    assert mean_evidence(values, bound, above=False) == pytest.approx(math.log(100.0))
    assert bound > values.mean() + NormalDist().inv_cdf(0.99) * values.std(ddof=1) / math.sqrt(40)


def test_too_few_values_prove_nothing_and_equal_ones_all():
    assert mean_above(np.array([1.0]), 0.05) == math.inf
    assert mean_evidence(np.array([1.0]), 0.0, above=True) == -math.inf
    assert mean_evidence(np.array([1.0, 2.0]), 3.0, above=True) == -math.inf
    equal = np.full(20, 2.0)
    assert mean_above(equal, 0.05) == 2.0
    assert mean_evidence(equal, 1.0, above=True) > 10.0


def test_trials_that_never_differ_bound_the_difference_by_the_boldest_bet():
    # Half of the wealth bets all on each seed: (1 - m)^-n / 2 >= 1 / level.
    alone = 1.0 - (0.5 * 0.01) ** (1.0 / 100)
    assert difference_above(0, 0, 100, 0.01) == pytest.approx(alone, rel=0.05)
    assert difference_above(0, 0, 100, 0.01) <= alone
    assert difference_above(0, 0, 0, 0.01) == 1.0
    assert difference_above(0, 60, 100, 0.01) < -0.3


@pytest.mark.parametrize(("more", "less"), [(0.05, 0.0), (0.1, 0.1), (0.3, 0.02)])
def test_a_difference_is_seldom_ever_above_its_bound(more, less):
    level, runs, trials = 0.1, 300, 160
    generator = np.random.default_rng(4)
    errors = 0
    for _ in range(runs):
        drawn = generator.random(trials)
        up, down = (drawn < more).cumsum(), (drawn >= 1.0 - less).cumsum()
        errors += any(
            difference_above(int(up[n - 1]), int(down[n - 1]), n, level) < more - less for n in range(8, trials + 1, 8)
        )
    assert errors / runs <= level + 3.0 * math.sqrt(level * (1.0 - level) / runs)


SKEWED = {
    "normal": (lambda draw, size: np.maximum(draw.normal(1.0, 0.2, size), 0.0), 1.0),
    "lognormal": (lambda draw, size: draw.lognormal(0.0, 1.0, size), math.exp(0.5)),
    "outliers": (lambda draw, size: np.where(draw.random(size) < 0.05, 10.0, 1.0) * draw.normal(1.0, 0.1, size), 1.45),
}


@pytest.mark.parametrize("above", [False, True])
@pytest.mark.parametrize("kind", list(SKEWED))
def test_a_mean_of_skewed_values_is_seldom_ever_called_beyond_itself(kind, above):
    draw, mean = SKEWED[kind]
    level, runs, generator = 0.1, 200, np.random.default_rng(8)
    errors = 0
    for _ in range(runs):
        values = draw(generator, 120)
        errors += any(
            bounded_mean_evidence(values[:n], mean, above=above, least=0.0) >= math.log(1.0 / level)
            for n in range(8, 121, 4)
        )
    assert errors / runs <= level + 3.0 * math.sqrt(level * (1.0 - level) / runs)


def test_the_wealth_of_a_bounded_mean_is_that_of_its_bets():
    values, limit, most = [0.2, 0.9, 0.4], 0.8, 1.0
    bets = [0.5 ** (place / 2.0) / (most - limit) for place in range(25)]
    parts = [0.5 ** (place / 2.0) for place in range(25)]
    wealth = sum(
        part / sum(parts) * math.prod(1.0 + bet * (limit - value) for value in values)
        for bet, part in zip(bets, parts, strict=True)
    )
    found = bounded_mean_evidence(np.array(values), limit, above=False, most=most)
    assert found == pytest.approx(math.log(wealth))
    mirrored = bounded_mean_evidence(1.0 - np.array(values), 1.0 - limit, above=True, least=0.0)
    assert mirrored == pytest.approx(found)


def test_bounds_that_lie_on_one_side_prove_at_once_and_few_values_without_a_bound_nothing():
    alone = np.array([2.0])
    assert bounded_mean_evidence(alone, 3.0, above=False, least=2.0, most=2.0) == math.inf
    assert bounded_mean_evidence(alone, 3.0, above=True, least=2.0, most=2.0) < 0.0
    assert bounded_mean_evidence(alone, 2.0, above=False, least=2.0, most=2.0) == -math.inf
    assert bounded_mean_evidence(alone, 3.0, above=False) == -math.inf
    assert bounded_mean_evidence(np.array([]), 3.0, above=False, most=1.0) == -math.inf
    # Two values of 1 are assumed to have no neighbours above 10.
    assert bounded_mean_evidence(np.ones(2), 11.0, above=False) == math.inf
    assert bounded_mean_evidence(np.ones(2), 9.0, above=False) < math.log(20.0)
    # A value beyond a bound refutes the bound.
    assert bounded_mean_evidence(np.array([1.0, 4.0]), 3.5, above=False, most=3.0) < math.log(20.0)
    # A limit of 0 has no scale of its own.
    assert bounded_mean_evidence(np.full(400, -1.0), 0.0, above=False) > math.log(20.0)


@pytest.mark.parametrize("most", [math.inf, 3.0])
def test_a_verdict_over_many_looks_takes_hardly_more_values_than_one_interval(most):
    """The interval of a fixed number of values is the oracle: it has the same assumption and looks once."""
    values = np.minimum(np.random.default_rng(9).normal(1.0, 0.2, 400), 3.0)
    bound = None if math.isinf(most) else most

    def first(holds):
        return next(n for n in range(4, 401, 4) if holds(values[:n]))

    fixed = first(lambda seen: mean_limits(list(seen), least=0.0, most=bound, tail=0.05)[1] <= 1.3)
    over_looks = first(lambda seen: bounded_mean_evidence(seen, 1.3, above=False, least=0.0, most=most) >= math.log(20))
    assert fixed <= over_looks <= 2 * fixed
