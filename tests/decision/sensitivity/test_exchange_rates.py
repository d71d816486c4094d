"""Exchange rates, against value functions written here and a search of all designs."""

from __future__ import annotations

import math
from types import SimpleNamespace

import numpy as np
import pytest

from rgss.decision.sensitivity import Tornado
from rgss.decision.sensitivity.exchange_rates import exchange_rates_of
from rgss.decision.sensitivity.standings import Standings
from rgss.reports.decision.exchange_sentences import exchange_clause, exchange_rows, exchange_sentences, exchange_title
from rgss.tradeoff import (
    Alternative,
    Comparison,
    ExponentialValue,
    PiecewiseValue,
    TargetValue,
    Threshold,
    TradeProblem,
    Weighting,
)
from rgss.tradeoff.problem import tabulated
from rgss.tradeoff.programs import single_values, violations

UNITS = {"cost": "USD", "payload": "kg", "time": "s", "angle": "rad"}
FUNCTIONS = (
    PiecewiseValue(measure="payload", worst=0.5, best=2.5, interior=((1.0, 0.7),)),
    PiecewiseValue(measure="cost", worst=50_000.0, best=30_000.0),
    ExponentialValue(measure="time", worst=30.0, best=5.0, halfway=20.0),
    TargetValue(measure="angle", target=1.0, too_low=0.5, too_high=2.0),
)


def priced(designs, weights, *, functions=FUNCTIONS, limit=math.inf, reference=None, chosen=None, tied=None):
    """The rates of the design of the highest value whose payload is at most a limit, or of a given one."""
    problem = TradeProblem(
        alternatives=tuple(Alternative(variant=variant, measures=one) for variant, one in designs.items()),
        thresholds=(
            Threshold(requirement="R-1", measure="payload", comparison=Comparison.AT_MOST, value=limit, unit="kg"),
        )
        if math.isfinite(limit)
        else (),
        value_functions=tuple(one for one in functions if one.measure in weights),
        weighting=Weighting(weights=weights),
    )
    table = tabulated(problem.alternatives)
    standings = Standings(
        project=SimpleNamespace(
            measures=SimpleNamespace(measure=lambda name: SimpleNamespace(unit=UNITS[name])),
            study=SimpleNamespace(trade_off=SimpleNamespace(sensitivity=SimpleNamespace(priced_in=reference))),
        ),
        problem=problem,
        table=table,
        values=single_values(problem, table),
        weights=np.array([weights[name] for name in problem.weighting.deciding_measures]),
        feasible=~violations(problem, table).any(axis=1),
        remeasuring=None,
    )
    values = {one: worth_of(quantities, weights) for one, quantities in designs.items()}
    ranked = sorted((one for one in designs if designs[one]["payload"] <= limit), key=lambda one: -values[one])
    chosen, lead = chosen or ranked[0], values[ranked[0]] - values[ranked[1]]
    tornado = Tornado(chosen=chosen, rival=ranked[1], lead=lead, bars=(), without_range=())
    return exchange_rates_of(standings, tornado, tied=tied)


def worth_of(quantities, weights):
    """Weighted value of quantities, by value functions of its own."""
    values = {
        "payload": np.interp(quantities["payload"], [0.5, 1.0, 2.5], [0.0, 0.7, 1.0]),
        "cost": min(max((50_000.0 - quantities["cost"]) / 20_000.0, 0.0), 1.0),
        "time": halved_at(20.0, min(max((30.0 - quantities["time"]) / 25.0, 0.0), 1.0)),
        "angle": np.interp(quantities["angle"], [0.5, 1.0, 2.0], [0.0, 1.0, 0.0]),
    }
    return float(sum(weight * values[measure] for measure, weight in weights.items()))


def halved_at(quantity, share):
    """Exponential value at a share of the range, one half at a quantity of the time; its curvature by bisection."""
    at = (30.0 - quantity) / 25.0
    low, high = 1e-6, 50.0
    for _ in range(200):
        middle = (low + high) / 2.0
        low, high = (low, middle) if (1 - math.exp(-middle * at)) / (1 - math.exp(-middle)) > 0.5 else (middle, high)
    return (1 - math.exp(-low * share)) / (1 - math.exp(-low))


def some_designs(seed):
    draw = np.random.default_rng(seed)
    return {
        int(variant): {
            "payload": float(draw.uniform(0.4, 2.7)),
            "cost": float(draw.choice([31_000, 35_500, 41_000, 49_000, 52_000])),
            "time": float(draw.uniform(4.0, 31.0)),
            "angle": float(draw.uniform(0.4, 2.1)),
        }
        for variant in draw.permutation(np.arange(1, 31))
    }


@pytest.mark.parametrize("seed", range(40))
def test_a_step_and_its_price_cancel(seed):
    designs, draw = some_designs(seed), np.random.default_rng(seed + 1000)
    weights = dict(zip(UNITS, draw.dirichlet(np.ones(4)).tolist(), strict=True))
    found = priced(designs, weights)
    assert (found.reference, found.unit, found.more_is_better) == ("cost", "USD", False)
    assert [rate.measure for rate in found.rates] == ["payload", "time", "angle"]
    mine = designs[found.variant]
    before = worth_of(mine, weights)

    def after(rate, amount):
        there = {**mine, "cost": mine["cost"] + amount}
        return worth_of({**there, rate.measure: mine[rate.measure] + rate.step}, weights)

    for rate in found.rates:
        assert rate.quantity == mine[rate.measure]
        assert rate.gain == pytest.approx(after(rate, 0.0) - before, abs=1e-12)
        assert rate.gain >= 0.0
        amount = rate.worth.amount
        if rate.worth.is_bound:
            assert mine["cost"] + amount == pytest.approx(max(mine["cost"], 50_000.0))
            assert after(rate, 1e9) > before
        else:
            assert after(rate, amount) == pytest.approx(before, abs=1e-8)
            assert amount == 0.0 or after(rate, 0.99 * amount) > before
    lead = before - max(worth_of(one, weights) for variant, one in designs.items() if variant != found.variant)
    if not found.lead.is_bound:
        assert worth_of({**mine, "cost": mine["cost"] + found.lead.amount}, weights) == pytest.approx(before - lead)


@pytest.mark.parametrize("seed", range(40))
def test_the_better_design_is_the_cheapest_of_the_feasible_ones(seed):
    designs, limit = some_designs(seed), 1.6
    weights = dict.fromkeys(UNITS, 0.25)
    found = priced(designs, weights, limit=limit)
    mine = designs[found.variant]
    # A target has another range on each side: the value, not the distance, says what is better.
    to_target = (lambda q: q, lambda q: -q, lambda q: -(1.0 - q) / 0.5 if q < 1.0 else -(q - 1.0) / 1.0)
    for rate, ahead in zip(found.rates, to_target, strict=True):
        better = [one for one in designs if ahead(designs[one][rate.measure]) > ahead(mine[rate.measure])]
        feasible = [one for one in better if designs[one]["payload"] <= limit]
        among = feasible or better
        if not among:
            assert rate.better is None
            continue
        best = min(among, key=lambda one: (designs[one]["cost"], -worth_of(designs[one], weights), one))
        assert rate.better.variant == best
        assert rate.better.extra == designs[best]["cost"] - mine["cost"]
        assert rate.better.value_change == pytest.approx(worth_of(designs[best], weights) - worth_of(mine, weights))
        assert rate.better.misses == (() if feasible else ("R-1",))


TWO = {
    1: {"payload": 1.0, "cost": 40_000.0, "time": 10.0, "angle": 1.0},
    2: {"payload": 1.0, "cost": 41_000.0, "time": 9.0, "angle": 1.0},
}


def test_without_money_the_greatest_weight_pays_and_a_target_cannot():
    weights = {"payload": 0.3, "angle": 0.5, "time": 0.2}
    assert priced(TWO, weights).reference == "payload"
    assert priced(TWO, weights, reference="time").reference == "time"
    assert priced(TWO, weights).more_is_better


def test_one_measure_or_targets_alone_have_no_rates():
    assert priced(TWO, {"cost": 1.0}) is None
    assert priced(TWO, {"angle": 1.0}) is None


def test_words_of_steps_bounds_and_designs():
    designs = {**TWO, 3: {"payload": 3.0, "cost": 39_000.0, "time": 4.0, "angle": 1.0}}
    weights = {"payload": 0.7, "cost": 0.1, "time": 0.1, "angle": 0.1}
    found = priced(designs, weights, limit=2.0, chosen=1)
    # 2 s at a tenth of the weight, paid in the cost at the same weight over its range of 20,000 USD.
    in_time = 20_000.0 * (worth_of({**TWO[1], "time": 8.0}, {"time": 1.0}) - worth_of(TWO[1], {"time": 1.0}))
    assert exchange_title(found) == "What a step for the better is worth to variant 1, paid in more cost"
    assert [row.cells for row in exchange_rows(found)] == [
        ("payload", "1 kg", "+0.2 kg", "5,600 USD", "3: 3 kg for -1,000 USD, misses R-1"),
        ("time", "10 s", "-2 s", f"{in_time:,.0f} USD", "2: 9 s for +1,000 USD"),
        ("angle", "1 rad", "at its best", "–", "none"),
    ]
    assert "one that misses requirements is named where no feasible one is better" in exchange_sentences(found)[-1]
    assert exchange_clause(found, code="`").startswith("+0.2 kg of `payload` 5,600 USD, -2 s of `time` ")
    steep = priced(designs, {"payload": 0.98, "cost": 0.02}, limit=2.0, chosen=2)
    # The whole range of the cost that is left, 9,000 USD, is worth 0.009; the step 0.0392.
    assert exchange_rows(steep)[0].worth == "> 9,000 USD"


@pytest.mark.parametrize("scale", [1e-15, 1.0, 1e12])
def test_the_least_worsening_counts_at_any_magnitude_of_the_reference(scale):
    """Variant 3 costs a third more of the reference than 2 does, and is worth more by its time."""
    functions = (
        PiecewiseValue(measure="payload", worst=0.0, best=4.0),
        PiecewiseValue(measure="cost", worst=9.0 * scale, best=1.0 * scale),
        PiecewiseValue(measure="time", worst=30.0, best=5.0),
    )
    designs = {
        1: {"payload": 1.0, "cost": 2.0 * scale, "time": 5.0, "angle": 1.0},
        2: {"payload": 2.0, "cost": 3.0 * scale, "time": 29.0, "angle": 1.0},
        3: {"payload": 2.0, "cost": 4.0 * scale, "time": 6.0, "angle": 1.0},
    }
    found = priced(designs, {"payload": 0.1, "cost": 0.3, "time": 0.6}, functions=functions, chosen=1)
    assert found.rates[0].better.variant == 2
    assert found.rates[0].better.extra == pytest.approx(scale)


def test_a_better_design_that_the_evidence_does_not_separate_is_tied():
    weights = {"time": 0.5, "cost": 0.5}
    unknown, apart, near = (priced(TWO, weights, chosen=1, tied=tied) for tied in (None, {1}, {1, 2}))
    assert [one.rates[0].better.is_tied for one in (unknown, apart, near)] == [None, False, True]
    cells = [exchange_rows(one)[0].cells[-1] for one in (unknown, apart, near)]
    assert cells == ["2: 9 s for +1,000 USD"] * 2 + ["2: 9 s for +1,000 USD, tied"]
    assert "does not separate its value" in exchange_sentences(near)[-1]
    assert "does not separate its value" not in exchange_sentences(apart)[-1]


def test_on_both_sides_of_a_target_the_design_of_the_higher_value_is_better():
    """1.4 and 1.5 are farther from the target of 1 than 0.7 is, and worth more."""
    function = TargetValue(measure="angle", target=1.0, too_low=0.5, too_high=2.0)
    designs = {
        1: {"payload": 2.5, "cost": 30_000.0, "time": 5.0, "angle": 0.7},
        2: {"payload": 0.5, "cost": 40_000.0, "time": 30.0, "angle": 1.4},
        3: {"payload": 0.5, "cost": 31_000.0, "time": 30.0, "angle": 1.5},
    }
    weights = {"payload": 0.3, "cost": 0.3, "time": 0.3, "angle": 0.1}
    assert function.value_at(0.7) < function.value_at(1.5) < function.value_at(1.4)

    from_below = {rate.measure: rate.better for rate in priced(designs, weights).rates}["angle"]
    assert (from_below.variant, from_below.quantity) == (3, 1.5)

    designs[1]["angle"], designs[2]["angle"], designs[3]["angle"] = 1.4, 0.7, 0.75
    from_above = {rate.measure: rate.better for rate in priced(designs, weights).rates}["angle"]
    assert from_above is None
