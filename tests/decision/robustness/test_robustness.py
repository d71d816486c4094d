"""The robustness of a decision, each claim held against deciding anew."""

from __future__ import annotations

import json
import math
from dataclasses import replace

import numpy as np
import pytest

from rgss.assessment.measuring import measure_variants
from rgss.decision.choosing import choose, proportion_measures, trade_problem
from rgss.decision.robustness.assumptions import assumption_findings
from rgss.decision.robustness.cost_box import cost_box
from rgss.decision.robustness.effect_findings import leading_factors
from rgss.decision.robustness.remeasuring import Remeasuring
from rgss.decision.robustness.robustness import analyse_robustness
from rgss.decision.what_if import measured_in, suppose
from rgss.decision.what_if.numbers import assumed_numbers, model_numbers
from rgss.motion import SOURCE_PLANNERS
from rgss.reports.decision.json.robustness import robustness_to_json, scenario_to_json
from rgss.tradeoff import Aim, Comparison, ElicitedInterval, ExponentialValue, Lexicographic
from rgss.tradeoff.problem.evidence_table import tabulated
from rgss.tradeoff.robustness.pareto import Support
from rgss.tradeoff.robustness.posterior_outcomes import PosteriorOutcomes
from rgss.tradeoff.robustness.prices import changes_of_best, step_at


@pytest.fixture(scope="module")
def store(shipped, filled, record_of):
    """Planners take different times, two fingers fail in one of three trials with STRIDE, seeds differ."""

    def record_for(spec):
        pace = {"RRT": 1.0, "TRRT": 0.8, "STRIDE": 0.3}[spec.planner]
        return record_of(
            spec,
            success=not (spec.planner == "STRIDE" and spec.seed == 2 and spec.gripper.geometry.fingers == 2),
            planning_s=pace * (1.0 + 0.2 * spec.seed) + 0.02 * spec.planning_limit_s,
            path_m=0.8 + 0.05 * spec.seed,
        )

    return filled(shipped, record_for)


@pytest.fixture(scope="module")
def measured(shipped, store):
    return measure_variants(shipped, store)


@pytest.fixture(scope="module")
def decision(shipped, measured):
    return choose(shipped, measured)


@pytest.fixture(scope="module")
def found(shipped, measured, decision):
    return analyse_robustness(shipped, measured, decision)


@pytest.fixture(scope="module")
def winners(shipped, measured):
    """The tied best under suppositions."""

    def decide(*texts):
        scenario = suppose(shipped, texts)
        return set(choose(scenario.project, measured_in(scenario, measured)).ties)

    return decide


def of(found, rows):
    return {found.variants[row] for row in rows}


def weights_as_text(found, weights):
    return [f"weight.{measure}={weight:.15f}" for measure, weight in zip(found.measures[:-1], weights, strict=False)]


def test_the_nearest_flip_flips(found, decision, winners):
    """At the nearest weights both are best; a little further the other alone, a little nearer only the chosen."""
    chosen, nearest = found.weighting.shifts[:2]

    assert of(found, chosen.rows) == set(decision.ties)
    for factor, expected in ((0.99, of(found, chosen.rows)), (1.01, of(found, nearest.rows))):
        weights = found.weights + factor * (nearest.nearest - found.weights)
        assert winners(*weights_as_text(found, np.maximum(weights, 0.0))) == expected


def test_a_weight_alone(found, decision, winners):
    for measure, one in zip(found.measures, found.weighting.ranges, strict=True):
        for end, rivals, step in ((one.low, one.below, -1e-4), (one.high, one.above, 1e-4)):
            if rivals:
                assert winners(f"weight.{measure}={end + step:.12f}") == of(found, rivals)
                assert winners(f"weight.{measure}={end - step:.12f}") == set(decision.ties)


def test_regions_and_acceptability(found):
    weighting = found.weighting
    shares = {}
    for variant, region in zip(found.variants, weighting.regions, strict=True):
        key = tuple(np.round(found.values[found.variants.index(variant)], 12))
        shares[key] = region.share
    indices = weighting.acceptability

    assert sum(shares.values()) == pytest.approx(1.0)
    assert indices.ranks.sum(axis=1) + indices.unranked == pytest.approx(np.ones(72))
    assert (found.resamples, found.all_resamples) == (10, True)
    assert weighting.with_noise
    assert not weighting.elicited
    feasible = {found.variants[row] for row in np.flatnonzero(found.feasible)}
    assert {found.variants[point.row] for point in found.front.points} == feasible
    extreme = {point.row for point in found.front.points if point.support is Support.EXTREME}
    assert {row for row, region in enumerate(weighting.regions) if region.share > 0} == extreme


def test_costs_and_other_assumptions_against_deciding_anew(found, decision, winners):
    """A little inside its range the choice stands, a little outside the named ones win."""
    followed = 0
    for one in found.assumptions:
        span = one.range
        assert span is not None
        scale = max(1.0, abs(one.number.value)) if one.number.unit == "USD" else abs(one.number.value)
        for end, rivals, sign in ((span.low, span.below, -1.0), (span.high, span.above, 1.0)):
            if end is None or one.number.name == "force":
                continue
            followed += 1
            inside, outside = end - sign * 1e-4 * scale, end + sign * 1e-4 * scale
            assert set(decision.ties) <= winners(f"{one.number.id}={inside:.9f} {one.number.unit}")
            assert winners(f"{one.number.id}={outside:.9f} {one.number.unit}") == of(found, rivals)
    assert followed >= 4


def test_every_assumption_of_the_catalogue_is_followed(found, shipped):
    marked = {
        f"catalogue.{component.id}.{name}"
        for component in shipped.designs.catalogue.components
        for name in component.assumptions
    }
    by_id = {one.number.id: one for one in found.assumptions}

    assert marked <= set(by_id)
    assert {"measures.a_m", "measures.z_o", "measures.d_f"} == {name for name in by_id if name.startswith("measures")}
    assert by_id["catalogue.ur10.cost"].range.exact
    assert not by_id["measures.a_m"].range.exact
    assert [one.number.id for one in found.assumptions if one.simulated] == ["catalogue.ka-58.mass"]
    assert by_id["catalogue.ka-58.force"].range.low == pytest.approx(10.0)
    assert by_id["catalogue.ka-58.force"].columns == ()


def test_all_costs_together(found, decision, winners):
    """Within the box no random costs change the choice; a hair beyond its worst corner they do."""
    box = found.costs
    assert box.range.factor is not None
    generator = np.random.default_rng(0)
    assumed = np.array([number.value for number in box.numbers])

    def decided(costs):
        return winners(*(f"{one.id}={cost:.9f} USD" for one, cost in zip(box.numbers, costs, strict=True)))

    for _ in range(3):
        signs = generator.choice([-1.0, 1.0], size=len(assumed))
        assert set(decision.ties) <= decided(assumed * (1.0 + 0.999 * box.range.factor * signs))
    lost = decided(assumed + (box.range.corner - assumed) * 1.001)
    assert not set(decision.ties) & lost
    assert lost & of(found, box.range.overtaken_by) or not box.range.overtaken_by
    assert box.unmoved == ("catalogue.rrt.cost", "catalogue.trrt.cost", "catalogue.stride.cost")


def test_prices_against_deciding_anew(found, shipped, winners):
    """Every step of every requirement's list, in its middle."""
    for price in found.prices:
        unit = shipped.measures.measure(price.condition.measure).unit
        for step in changes_of_best(price.steps):
            ends = [end for end in (step.loosest, step.tightest) if math.isfinite(end)]
            middle = sum(ends) / len(ends) if len(ends) == 2 else ends[0] + (1.0 if math.isinf(step.tightest) else 0.0)
            if len(ends) == 1 and math.isinf(step.tightest) and step.tightest < 0:
                middle = ends[0] - 1.0
            text = f"{middle:.12f} {unit}" if unit != "1" else f"{middle:.12f}"
            assert winners(f"{price.condition.requirement}.threshold={text}") == of(found, step.best)
        here = step_at(price.steps, price.condition.limit, at_least=price.condition.sense.value == ">=")
        assert here.feasible == int(found.feasible.sum())


def test_rank_reversal_needs_values_of_the_sample(found):
    assert found.reversals == ()
    assert all(one.swapped for one in found.stretched)


def test_effects_on_every_measure(found, measured):
    effects = {one.measure: one for one in found.effects.measures}

    assert found.effects.constants == ("d4", "d5", "d6")
    assert [(factor.id, factor.parameters) for factor in found.effects.factors] == [
        ("gripper_mass", ("d2", "d3")),
        ("fingers", ("d1",)),
        ("velocity", ("d7",)),
        ("planner", ("d8",)),
        ("planning_time", ("d9",)),
    ]
    assert leading_factors(effects["P_max"]) == pytest.approx({"fingers": 1.0})
    planner = next(one for one in effects["t_p"].analysis.effects if one.factors == ("planner",))
    means = [
        np.mean([e.estimates["t_p"].value for e in measured if e.variant.parameters["d8"] == name])
        for name in SOURCE_PLANNERS
    ]
    assert planner.levels == pytest.approx(np.array(means) - effects["t_p"].analysis.mean)
    assert (planner.low <= planner.levels).all()
    assert effects["C_total"].analysis.effects[0].low is None
    assert effects["t_e"].designs == 72
    # STRIDE with two fingers has a success only in resamples that hold seed 1 or 3.
    assert effects["t_e"].analysis.used == pytest.approx(26 / 27)


def test_nothing_feasible_leaves_weights_and_assumptions_out(shipped, measured):
    scenario = suppose(shipped, ["SYS-012.threshold=50 kg"])
    supposed = measured_in(scenario, measured)
    found = analyse_robustness(scenario.project, supposed, choose(scenario.project, supposed))

    assert found.weighting is found.costs is None
    assert set(found.refused) == {"weights", "assumptions", "costs"}
    assert set(found.refused.values()) == {"no variant meets every requirement by its estimates"}
    assert found.front.points == ()
    json.dumps(robustness_to_json(found), allow_nan=False)


def test_a_program_that_has_no_weighted_value(shipped, measured):
    """Prices and removals go by the program itself."""
    choice = Lexicographic(
        aims=(Aim(measure="t_p", sense=Comparison.AT_MOST), Aim(measure="C_total", sense=Comparison.AT_MOST))
    )
    study = replace(shipped.study, trade_off=replace(shipped.study.trade_off, program=choice))
    project = replace(shipped, study=study)
    decision = choose(project, measured)
    found = analyse_robustness(project, measured, decision)

    assert found.refused["weights"] == "the lexicographic program does not choose by weighted value"
    assert found.reversals == ()
    for price in found.prices:
        at_least = price.condition.sense.value == ">="
        here = step_at(price.steps, price.condition.limit, at_least=at_least)
        assert of(found, here.best) == set(decision.ties)


def test_elicited_bounds_cut_the_weights(shipped, measured, decision):
    """With the weight of cost fixed nearby, the regions are shares of what is left."""
    interval = ElicitedInterval(name="C_total", measures=("C_total",), least=0.2, most=0.3)
    study = replace(shipped.study, trade_off=replace(shipped.study.trade_off, intervals=(interval,)))
    found = analyse_robustness(replace(shipped, study=study), measured, decision)
    place = found.measures.index("C_total")

    assert found.weighting.elicited
    for region in found.weighting.regions:
        if region.share > 0.0:
            assert 0.2 - 1e-9 <= region.low[place] <= region.high[place] <= 0.3 + 1e-9


def test_costs_that_decide_through_two_measures(shipped, measured, decision):
    """Supplementary measures may stand on costs as well; then no one box can be followed."""
    problem = trade_problem(shipped, measured)
    remeasuring = Remeasuring.of(shipped, measured, tabulated(problem.alternatives))
    row = remeasuring.table.row_of(decision.chosen)
    weights = {"P_max": 0.5, "S": 0.5}
    without = replace(
        problem,
        weighting=replace(problem.weighting, weights=weights),
        value_functions=tuple(one for one in problem.value_functions if one.measure in weights),
        thresholds=tuple(one for one in problem.thresholds if one.measure != "C_total"),
    )

    assert cost_box(remeasuring, without, row) == "assumed costs decide through no measure"
    free = {one.number.id: one for one in assumption_findings(remeasuring, without, row)}
    assert free["catalogue.ur10.cost"].range.always


def test_costs_that_decide_by_their_limit_or_by_a_curved_value(shipped, measured, decision):
    problem = trade_problem(shipped, measured)
    remeasuring = Remeasuring.of(shipped, measured, tabulated(problem.alternatives))
    row = remeasuring.table.row_of(decision.chosen)
    weights = {"P_max": 0.5, "S": 0.5}
    limited = replace(
        problem,
        weighting=replace(problem.weighting, weights=weights),
        value_functions=tuple(one for one in problem.value_functions if one.measure in weights),
    )
    assert cost_box(remeasuring, limited, row) == "C_total has no value function, and decides by its limit alone"
    curved = ExponentialValue(measure="C_total", worst=44000.0, best=38000.0, halfway=42000.0)
    others = tuple(one for one in problem.value_functions if one.measure != "C_total")
    bent = replace(problem, value_functions=(*others, curved))
    assert cost_box(remeasuring, bent, row) == "the value of C_total is not piecewise linear"


def test_remeasuring_is_measuring_the_changed_project(shipped, measured):
    """One number of each kind: a cost, a property, a constant under trials."""
    problem = trade_problem(shipped, measured)
    remeasuring = Remeasuring.of(shipped, measured, tabulated(problem.alternatives))
    numbers = {number.id: number for number in model_numbers(shipped)}
    for name in ("catalogue.kg-3-light.cost", "catalogue.ka-58.mass", "measures.d_f", "measures.a_m"):
        number = numbers[name]
        value = 1.7 * number.value
        scenario = suppose(shipped, [f"{name}={value:.15g} {number.unit}"])
        expected = tabulated(trade_problem(scenario.project, measured_in(scenario, measured)).alternatives)
        table = remeasuring.table_with(number, value)

        assert table.quantities == pytest.approx(expected.quantities, rel=1e-12, nan_ok=True)
        for column, samples in expected.samples.items():
            assert table.samples[column].values == pytest.approx(samples.values, rel=1e-12, nan_ok=True)


def test_the_same_evidence_gives_the_same_document(shipped, measured, decision, found):
    again = analyse_robustness(shipped, measured, decision)

    assert json.dumps(robustness_to_json(again)) == json.dumps(robustness_to_json(found))


def test_the_document_is_plain_and_complete(found, shipped):
    document = json.loads(json.dumps(robustness_to_json(found), allow_nan=False))

    assert len(document["weight_changes"]["regions"]) == 72
    assert [one["id"] for one in document["assumptions"]] == [one.id for one in assumed_numbers(shipped)]
    assert document["weights"] == pytest.approx({"P_max": 0.25, "C_total": 0.25, "t_e": 0.2, "t_p": 0.1, "S": 0.2})
    for price in document["prices"]:
        assert price["steps"][-1]["best"] == []
    scenario = suppose(shipped, ["weight.t_e=0.4"])
    assert json.loads(json.dumps(scenario_to_json(scenario), allow_nan=False))["changes"] == [
        {"id": "weight.t_e", "before": 0.2, "after": 0.4, "unit": "1"}
    ]


def test_noise_by_hand(shipped, measured, found):
    """The probability of being best is counted over posterior draws, drawn here once more and ranked one by one."""
    one = found.weighting.uncertainty
    problem = trade_problem(shipped, measured)
    drawn = PosteriorOutcomes.of(
        problem, tabulated(problem.alternatives), proportion_measures(shipped), generator=np.random.default_rng(5)
    )
    best = np.zeros(72)
    for values, feasible in zip(drawn.outcomes.values, drawn.outcomes.feasible, strict=True):
        totals = [
            float(value @ found.weights) if there else -1.0 for value, there in zip(values, feasible, strict=True)
        ]
        best += [total >= 0.0 and total >= max(totals) - 1e-9 for total in totals]
    # Two sets of 1,000 draws.
    assert one.best == pytest.approx(best / len(drawn.outcomes.values), abs=0.07)
    assert one.good >= one.best[one.chosen]


def test_the_error_of_first_is_that_of_another_study_and_not_of_the_draws(found):
    errors, indices = found.weighting.first_errors, found.weighting.acceptability
    best = int(np.nanargmax(indices.first))
    assert errors[best] > 5.0 * indices.rank_errors[best, 0]
    assert (errors >= indices.rank_errors[:, 0]).all()
