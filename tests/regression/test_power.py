"""The stated power beside simulation: the whole procedure on drawn trials, knowing nothing of the formula."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
import pytest

from rgss.regression import paired
from rgss.regression.comparing import Outcome
from rgss.regression.looking import settle
from rgss.regression.power import TARGET, mean_power, powers, success_power

RUNS = 300


def found_share(candidate, draw, looks, others, *, error_rate=0.05, runs=RUNS, seed=1):
    """The share of simulated comparisons in which the first metric is called worse."""
    generator = np.random.default_rng(seed)
    found = 0
    for _ in range(runs):
        old, new = draw(generator)

        def at(look, _runs, old=old, new=new):
            count = looks[look - 1]
            rest = [
                candidate([0.0] * count, [(-1.0) ** place * 9 for place in range(count)], metric=f"m{other}")
                for other in range(others)
            ]
            return [make_success(candidate, old[:count], new[:count]), *rest]

        settled = settle(at, looks=len(looks), error_rate=error_rate)
        found += any(one.outcome is Outcome.WORSE for one in settled.comparisons.values() if one.guard.is_success)
    return found / runs


def make_success(candidate, old, new):
    return candidate(
        old.tolist(), new.tolist(), success=True, higher=True, margin=0.25, phase="trial", metric="success"
    )


@pytest.mark.parametrize(("looks", "others"), [((8, 40), 3), ((6, 24), 0)])
@pytest.mark.parametrize("rate", [1.0, 0.9])
def test_the_power_of_success_is_what_simulation_finds(candidate, rate, looks, others, monkeypatch):
    """A success rate that falls by a quarter: by losses alone, and with each seed drawn anew."""
    monkeypatch.setattr(paired, "DRAWS", 500)
    monkeypatch.setattr(paired, "_counts", lru_cache(paired._counts.__wrapped__))
    size, levels = looks[-1], (0.05 * 0.25, 0.05 * 0.75)
    share = (0.5 if others else 1.0) * 0.8

    def independent(generator):
        return (generator.random(size) < rate) * 1.0, (generator.random(size) < rate - 0.25) * 1.0

    now = rate - 0.25
    stated = success_power(rate * (1.0 - now), now * (1.0 - rate), 0.25, looks, levels, share)
    simulated = found_share(candidate, independent, looks, others)
    # A part of the error rate that another comparison frees is not in the formula.
    assert abs(simulated - stated) < 4.0 * (0.25 / RUNS) ** 0.5


def test_the_least_of_both_models_is_stated(candidate):
    old = np.array([1.0] * 18 + [0.0] * 2)
    (power,) = powers([make_success(candidate, old, old)], {"r": [8, 24]}, error_rate=0.05).values()
    models = ((0.25, 0.0), (0.9 * 0.35, 0.65 * 0.1))
    both = [success_power(*model, 0.25, (8, 24), (0.0125, 0.0375), 0.8) for model in models]
    assert power.probability == pytest.approx(min(both))
    assert min(both) < max(both)
    assert power.loss == 0.25


def test_other_comparisons_take_their_part(candidate):
    one = make_success(candidate, np.ones(24), np.ones(24))
    others = [candidate([1.0, 2.0], [1.0, 2.0], metric=f"m{place}") for place in range(3)]
    alone, among = (powers(each, {"r": [8, 24]}, error_rate=0.05) for each in ([one], [one, *others]))
    assert among[one.subject].probability < alone[one.subject].probability


@pytest.mark.parametrize("shape", ["normal", "exponential"])
def test_the_power_of_a_mean_is_what_simulation_finds(candidate, shape):
    """Independent draws on both sides, worse by twice the margin, one comparison at one look."""
    generator = np.random.default_rng(3)
    draw = {"normal": generator.normal, "exponential": generator.exponential}[shape]
    baseline = draw(size=24)
    one = candidate(baseline.tolist(), baseline.tolist(), margin=0.8)
    (power,) = powers([one], {"r": [24]}, error_rate=0.05).values()
    spread = float(np.std(baseline, ddof=1)) * 2.0**0.5
    assert power.probability == pytest.approx(mean_power(0.8, spread, 24, 0.05 * 0.8))
    found = 0
    for _ in range(RUNS):
        old, new = draw(size=24), draw(size=24) + 1.6
        settled = settle(
            lambda _look, _runs, old=old, new=new: [candidate(old.tolist(), new.tolist(), margin=0.8)],
            looks=1,
            error_rate=0.05,
        )
        found += next(iter(settled.comparisons.values())).outcome is Outcome.WORSE
    true = mean_power(0.8, 2.0**0.5, 24, 0.05 * 0.8)
    assert found / RUNS == pytest.approx(true, abs=0.12)


def test_a_mean_may_be_called_the_same_at_an_earlier_look(candidate):
    """A lower bound of the power over all looks is below that of the last one by the error rates of the others."""
    baseline = np.random.default_rng(3).normal(size=24).tolist()
    one = candidate(baseline, baseline, margin=0.8)
    (power,) = powers([one], {"r": [8, 24]}, error_rate=0.05).values()
    spread = float(np.std(baseline, ddof=1)) * 2.0**0.5
    assert power.probability == pytest.approx(mean_power(0.8, spread, 24, 0.0375 * 0.8) - 0.0125)


def test_the_seeds_that_are_recommended_reach_the_target_and_fewer_do_not(candidate):
    one = make_success(candidate, np.ones(12), np.ones(12))
    (power,) = powers([one], {"r": [4, 12]}, error_rate=0.05).values()
    assert power.probability < TARGET
    levels = (0.05 * 0.75,)

    def alone(seeds):
        return success_power(0.25, 0.0, 0.25, (seeds,), levels, 0.8)

    assert alone(power.seeds_needed) >= TARGET > alone(power.seeds_needed - 1)


def test_what_cannot_be_lost_or_told_has_no_power(candidate):
    failing = make_success(candidate, np.zeros(8), np.zeros(8))
    alone = candidate([1.0], [1.0])
    unknown = candidate([None, None], [None, None], metric="slip_m")
    assert powers([failing, alone, unknown], {"r": [8]}, error_rate=0.05) == {}


@pytest.mark.parametrize("looks", [(24,), (8, 24)])
def test_the_detectable_loss_is_found_as_often_as_stated(candidate, looks):
    """Independent draws on both sides, worse by that much: the formula knows the spread of the baseline alone."""
    baseline = np.random.default_rng(3).normal(size=24)
    one = candidate(baseline.tolist(), baseline.tolist(), margin=0.8)
    (power,) = powers([one], {"r": looks}, error_rate=0.05).values()
    spread, last, before = float(np.std(baseline, ddof=1)) * 2.0**0.5, 0.05, 0.0
    if len(looks) > 1:
        last, before = 0.0375, 0.0125
    reached = mean_power(power.detectable - 0.8, spread, 24, last * 0.8) - before
    assert reached == pytest.approx(TARGET, abs=0.003)
    assert power.detectable > power.loss


def test_the_detectable_loss_of_quiet_values_is_just_beyond_the_margin(candidate):
    still = candidate([2.0] * 24, [2.0] * 24, margin=0.8)
    (power,) = powers([still], {"r": [24]}, error_rate=0.05).values()
    assert 0.8 < power.detectable < 0.81


def test_without_noise_any_loss_is_found(candidate):
    still = candidate([2.0] * 6, [2.0] * 6)
    (power,) = powers([still], {"r": [6]}, error_rate=0.05).values()
    assert power.probability > 0.999
    assert power.seeds_needed <= 6


def test_a_loss_that_no_number_of_seeds_finds(candidate):
    noisy = candidate(np.random.default_rng(1).normal(size=20).tolist(), [0.0] * 20, margin=0.01)
    (power,) = powers([noisy], {"r": [20]}, error_rate=0.05).values()
    assert (power.seeds_needed, power.probability < 0.1) == (None, True)
