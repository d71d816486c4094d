"""How far one assumption may move, by hand and against a fine walk."""

from __future__ import annotations

import math

import numpy as np
import pytest

from rgss.tradeoff.robustness.assumption_sensitivity import Standing, linear_range, scanned_range


def two_offers(price):
    """The first is worth 1 - price / 100 and must not cost more than 80; the second is worth 0.6."""
    return Standing(totals=np.array([1.0 - price / 100.0, 0.6]), feasible=np.array([price <= 80.0, True]))


def test_by_hand():
    found = linear_range(two_offers, 0, 10.0, kinks=np.array([80.0]), lowest=0.0, highest=math.inf)

    assert (found.low, found.high, found.below, found.above) == (None, pytest.approx(40.0), (), (1,))
    assert (found.exact, found.always) == (True, False)


@pytest.mark.parametrize("apart", [1, 2, 3])
def test_kinks_that_rounding_tells_apart(apart):
    """One quantity computed in two ways gives two kinks between which there is no number, or hardly one."""
    kinks = [20.0]
    for _ in range(apart):
        kinks.append(math.nextafter(kinks[-1], math.inf))

    found = linear_range(two_offers, 0, 10.0, kinks=np.array([kinks[0], kinks[-1]]), lowest=0.0, highest=math.inf)

    assert (found.high, found.above) == (pytest.approx(40.0), (1,))


def test_a_threshold_may_end_it_first():
    def stand(price):
        return Standing(totals=np.array([1.0 - price / 1000.0, 0.6]), feasible=np.array([price <= 80.0, True]))

    found = linear_range(stand, 0, 10.0, kinks=np.array([80.0]), lowest=0.0, highest=200.0)

    assert (found.high, found.above) == (80.0, (1,))


def test_a_rival_that_becomes_feasible():
    def stand(price):
        return Standing(totals=np.array([0.5, 0.9]), feasible=np.array([True, price <= 5.0]))

    found = linear_range(stand, 0, 10.0, kinks=np.array([5.0]), lowest=0.0, highest=20.0)

    assert (found.low, found.below, found.high) == (5.0, (1,), None)


def test_nothing_is_feasible_any_more():
    def stand(price):
        return Standing(totals=np.array([0.5]), feasible=np.array([price <= 50.0]))

    found = linear_range(stand, 0, 10.0, kinks=np.array([50.0]), lowest=0.0, highest=math.inf)

    assert (found.high, found.above) == (50.0, ())


def test_what_changes_nothing():
    found = linear_range(
        lambda _: Standing(totals=np.array([0.5, 0.5, 0.2]), feasible=np.ones(3, dtype=bool)),
        1,
        10.0,
        kinks=np.array([]),
        lowest=0.0,
        highest=math.inf,
    )

    assert found.always


def test_alternatives_that_stay_tied_do_not_overtake():
    """Equal ones whose sums are added in another order differ by rounding only."""

    def stand(price):
        return Standing(
            totals=np.array([0.1 + 0.2 + price / 3.0, 0.3 + price / 3.0 + 1e-17, 0.0]), feasible=np.ones(3, dtype=bool)
        )

    assert linear_range(stand, 0, 10.0, kinks=np.array([]), lowest=0.0, highest=math.inf).always


def random_market(seed):
    """Six offers whose cost is linear in x, valued piecewise linearly, with a threshold; some tied, some alike."""
    generator = np.random.default_rng(seed)
    base, slope = generator.integers(0, 10, 6).astype(float), generator.integers(-2, 3, 6).astype(float)
    rest = generator.integers(0, 5, 6) / 10
    most = int(generator.integers(5, 15))
    dear, cheap = sorted(generator.choice(np.arange(-5, 20), 2, replace=False))

    def stand(x):
        costs = base + slope * x
        return Standing(totals=rest + 0.5 - 0.5 * np.interp(costs, [dear, cheap], [0.0, 1.0]), feasible=costs <= most)

    kinks = [(level - b) / s for level in (most, dear, cheap) for b, s in zip(base, slope, strict=True) if s]
    return stand, np.array(kinks)


@pytest.mark.parametrize("seed", range(40))
def test_against_a_fine_walk_and_against_bisection(seed):
    stand, kinks = random_market(seed)
    best = stand(2.0).best()
    if not best:
        # The threshold lets nothing pass: there is no choice whose range could be asked for.
        assert not stand(2.0).feasible.any()
        return
    found = linear_range(stand, best[0], 2.0, kinks=kinks, lowest=-10.0, highest=30.0)
    low = -10.0 if found.low is None else found.low
    high = 30.0 if found.high is None else found.high

    for x in np.linspace(low, high, 400):
        assert best[0] in stand(float(x)).best()
    if found.low is not None:
        assert set(stand(low - 1e-6).best()) == set(found.below)
        assert best[0] not in found.below
    if found.high is not None:
        assert set(stand(high + 1e-6).best()) == set(found.above)
        assert best[0] not in found.above
    scanned = scanned_range(stand, best[0], 2.0, lowest=-10.0, highest=30.0)
    assert not scanned.exact
    assert scanned.low == pytest.approx(found.low, abs=1e-6)
    assert scanned.high == pytest.approx(found.high, abs=1e-6)


def test_a_curve_is_bisected():
    """x² reaches 0.5 at √½."""

    def stand(x):
        return Standing(totals=np.array([0.5, x * x]), feasible=np.ones(2, dtype=bool))

    found = scanned_range(stand, 0, 0.1, lowest=0.0, highest=2.0)

    assert (found.low, found.highest, found.above) == (None, 2.0, (1,))
    assert found.high == pytest.approx(math.sqrt(0.5), abs=1e-9)
