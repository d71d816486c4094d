from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
import pytest

from rgss.errors import DefinitionError
from rgss.findings import Finding
from rgss.measures import (
    Estimate,
    MeasureSet,
    Range,
    design_values,
    evaluate,
    ratio_values,
    replicate_ranges,
    trial_values,
)

Loader = Callable[..., MeasureSet]
Writer = Callable[..., str]

FIXED: Mapping[str, float | str] = {"design.d2": 3.0, "design.d7": 0.5, "design.d8": "RRT"}
MEAN = "{statistic: mean, over: all}"


def estimates(measures: MeasureSet, *trials: Mapping[str, Any], **more: Any) -> dict[str, Estimate]:
    return evaluate(measures, **{"fixed": FIXED, "trials": trials, "variant": 1, **more})


def test_a_measure_of_the_design_is_computed_once(load_entries: Loader, entry: Writer) -> None:
    measures = load_entries(entry("x", "m * g", "kN"))
    assert estimates(measures) == {"x": Estimate(value=0.03, unit="kN", low=0.03, high=0.03, n=0)}


def test_the_order_is_that_of_the_file(load_entries: Loader, entry: Writer) -> None:
    measures = load_entries(entry("z", "y"), entry("y", "a"), entry("a", "m"))
    assert list(estimates(measures)) == ["z", "y", "a"]


def test_only_known_values_of_the_trials_that_count_are_estimated(load_entries: Loader, entry: Writer) -> None:
    measures = load_entries(
        entry("every", "time", "min", estimate=MEAN),
        entry("good", "time", "s", estimate="{statistic: mean, over: successful}"),
    )
    result = estimates(
        measures,
        {"task_time_s": 60.0, "success": 1},
        {"task_time_s": 180, "success": 0},
        {"task_time_s": None, "success": 1},
        {"task_time_s": math.nan, "success": 1},
        {"success": True},
        {"task_time_s": 240.0},
    )
    assert (result["every"].value, result["every"].n) == (pytest.approx(480 / 60 / 3), 3)
    assert result["good"] == Estimate(value=60.0, unit="s", low=None, high=None, n=1)


def test_no_trial_gives_no_value(load_entries: Loader, entry: Writer) -> None:
    measures = load_entries(
        entry("duration", "time", "s", estimate=MEAN),
        entry("share_of", "share", "1", estimate="{statistic: proportion, over: all}"),
    )
    assert estimates(measures) == {"duration": Estimate.unknown("s"), "share_of": Estimate.unknown("1")}


def test_a_proportion_counts_complete_trials(load_entries: Loader, entry: Writer) -> None:
    measures = load_entries(entry("x", "share", "1", estimate="{statistic: proportion, over: all}"))
    result = estimates(measures, {"share": 1}, {"share": 0.875}, {"share": None}, {"share": 1.0}, {"share": 0})
    assert (result["x"].value, result["x"].n) == (0.5, 4)


@pytest.mark.parametrize(("summary", "expected"), [("sum", 15.0), ("mean", 3.0), ("max", 5.0)])
def test_a_row_is_summarised_but_used_as_a_row(
    load_entries: Loader, entry: Writer, summary: str, expected: float
) -> None:
    measures = load_entries(
        entry("x", "row", "m", estimate=MEAN, summary=summary), entry("square", "norm(x)", "m", estimate=MEAN)
    )
    result = estimates(measures, {"path_length_m": (1.0, 2.0, 3.0, 4.0, 5.0)})
    assert result["x"].value == expected
    assert result["square"].value == math.sqrt(55)


def test_an_unknown_entry_makes_the_summary_unknown(load_entries: Loader, entry: Writer) -> None:
    measures = load_entries(entry("x", "row", "m", estimate=MEAN, summary="max"))
    assert estimates(measures, {"path_length_m": [1.0, 2.0, 3.0, 4.0, None]})["x"].n == 0
    assert estimates(measures, {"path_length_m": None})["x"].n == 0


def test_the_values_of_one_trial_can_be_had(load_entries: Loader, entry: Writer) -> None:
    measures = load_entries(entry("x", "row / v", "ms", estimate=MEAN, summary="sum"))
    design = design_values(measures, fixed=FIXED, variant=1)
    assert design == {"g": 10.0, "m": 3.0, "v": 0.5}
    values = trial_values(measures, design=design, trial={"path_length_m": (1, 2, 3, 4, None)})
    assert values["x"] == (2.0, 4.0, 6.0, 8.0, None)
    assert values["time"] is None


def test_the_result_depends_on_evidence_alone(load_entries: Loader, entry: Writer) -> None:
    measures = load_entries(entry("x", "time", "s", estimate=MEAN))
    trials = [{"task_time_s": value} for value in (1.0, 5.0, 2.5, 9.0, 3.3, 4.1, 7.2)]
    first = estimates(measures, *trials)
    assert estimates(measures, *trials[::-1]) == first
    assert estimates(measures, *trials, variant=2) == first


def test_a_time_is_never_negative_and_a_length_may_be(load_entries: Loader, entry: Writer) -> None:
    measures = load_entries(entry("t", "time", "s", estimate=MEAN), entry("v_gain", "time * g", "m/s", estimate=MEAN))
    result = estimates(measures, {"task_time_s": 2.0}, {"task_time_s": 3.0})
    assert 0.0 < result["t"].low < result["t"].value
    assert result["v_gain"].low < 0.0 < result["v_gain"].value


def test_a_time_that_is_seen_below_zero_has_no_such_bound(load_entries: Loader, entry: Writer) -> None:
    measures = load_entries(entry("lead", "time - 2 * time", "s", estimate=MEAN))
    assert estimates(measures, {"task_time_s": 2.0}, {"task_time_s": 3.0})["lead"].low < -10.0


def test_declared_bounds_limit_the_interval(load_entries: Loader, entry: Writer) -> None:
    rule = "{statistic: mean, over: all, least: 1 s, most: 0.1 min}"
    measures = load_entries(entry("x", "time", "s", estimate=rule))
    result = estimates(measures, *[{"task_time_s": 3.0}] * 4)["x"]
    share = 1.0 - 0.025**0.25
    assert (result.low, result.high) == pytest.approx((3.0 - 2.0 * share, 3.0 + 3.0 * share))


def test_a_value_outside_the_declared_bounds_is_an_error(load_entries: Loader, entry: Writer) -> None:
    measures = load_entries(entry("x", "time", "s", estimate="{statistic: mean, over: all, most: 2 s}"))
    with pytest.raises(DefinitionError, match=r"variant 1 gives x = 3 s, outside the bounds that the measure declares"):
        estimates(measures, {"task_time_s": 3.0})


def bench(load: Loader, more: str = "") -> MeasureSet:
    """Measures of what a bench holds, of a time, and of both."""
    rule = "definition: D., better: higher, kind: supplementary, name: N, estimate: {statistic: mean, over: all}"
    return load(f"""\
        title: Test
        inputs:
          - {{id: m, source: design.d2, unit: kg, {more} definition: Mass.}}
          - {{id: held, source: trial.held_kg, unit: kg, of_design: true, definition: Mass that the bench holds.}}
          - {{id: time, source: trial.task_time_s, unit: s, definition: Time.}}
        measures:
          - {{id: least, expression: "min(m, held / 2)", unit: kg, {rule}}}
          - {{id: rate, expression: held / time, unit: kg/s, {rule}}}
    """)


def test_what_trials_compute_from_the_design_alone_is_exact(load: Loader) -> None:
    found = estimates(bench(load), *[{"held_kg": 4.0, "task_time_s": 2.0 + each} for each in range(3)])
    assert found["least"] == Estimate(value=2.0, unit="kg", low=2.0, high=2.0, n=3)
    assert found["rate"].low < found["rate"].value < found["rate"].high
    assert estimates(bench(load))["least"] == Estimate.unknown("kg")
    assert estimates(bench(load), {"task_time_s": 1.0}, {"held_kg": 4.0})["least"].n == 1


def test_the_values_that_a_replicate_may_have_are_the_bounds_of_the_interval(
    load: Loader, load_entries: Loader, entry: Writer
) -> None:
    bounded = load_entries(
        entry("x", "time", "s", estimate="{statistic: mean, over: all, least: 1 s, most: 0.1 min}"),
        entry("t", "time", "s", estimate=MEAN),
        entry("gain", "time * g", "m/s", estimate=MEAN),
    )
    trials = [{"task_time_s": 3.0}] * 2
    found = replicate_ranges(bounded, fixed=FIXED, estimates=estimates(bounded, *trials), variant=1)
    assert found["x"] == Range(low=1.0, high=6.0)
    assert found["t"] == Range(low=0.0)
    assert found["gain"].high == math.inf
    exact = bench(load)
    known = estimates(exact, {"held_kg": 4.0, "task_time_s": 2.0})
    found = replicate_ranges(exact, fixed=FIXED, estimates=known, variant=1)
    assert found["least"] == Range(low=2.0, high=2.0)


def test_trials_that_differ_in_what_is_of_the_design_are_an_error(load: Loader) -> None:
    message = (
        "trials of variant 1 give least = 1.5 and 2 kg, but its inputs are declared as of_design "
        "(remove 'of_design' from the input in the measures file)"
    )
    with pytest.raises(DefinitionError) as caught:
        estimates(bench(load), {"held_kg": 4.0}, {"held_kg": 3.0})
    assert str(caught.value) == message


def test_an_input_of_the_design_needs_no_word_of_it(
    load: Loader, findings_of: Callable[..., tuple[Finding, ...]]
) -> None:
    (found,) = findings_of(lambda: bench(load, "of_design: true,"))
    assert found.message == "design.d2 is a design value already; 'of_design' is for values computed by trials"
    assert (found.rule, found.hint) == ("measures.estimate", "remove 'of_design'")


def test_missing_values_of_the_design_are_named_together(load_entries: Loader, entry: Writer) -> None:
    measures = load_entries(entry("x", "m"))
    with pytest.raises(DefinitionError, match=r"variant 7 has no value for design\.d2, design\.d7 \(give it in"):
        estimates(measures, fixed={}, variant=7)


@pytest.mark.parametrize("value", ["heavy", math.inf])
def test_a_value_of_the_design_must_be_a_number(load_entries: Loader, entry: Writer, value: float | str) -> None:
    measures = load_entries(entry("x", "m"))
    with pytest.raises(DefinitionError, match=r"design\.d2 of variant 1 is .*; the measures' input 'm' needs a number"):
        estimates(measures, fixed={**FIXED, "design.d2": value})


def test_a_design_for_which_a_measure_is_not_defined_is_an_error(load_entries: Loader, entry: Writer) -> None:
    measures = load_entries(entry("x", "m / (v - v)", "kg*s/m"))
    message = r"measure 'x' is not defined for variant 1: m / \(v - v\) \(look for a division by zero"
    with pytest.raises(DefinitionError, match=message):
        estimates(measures)


def test_a_trial_for_which_a_measure_is_not_defined_has_no_value(load_entries: Loader, entry: Writer) -> None:
    measures = load_entries(entry("x", "1 / time", "1/s", estimate=MEAN))
    result = estimates(measures, {"task_time_s": 0.0}, {"task_time_s": 4.0})
    assert (result["x"].value, result["x"].n) == (0.25, 1)


@pytest.mark.parametrize(
    ("metric", "value", "message"),
    [
        ("path_length_m", (1.0, 2.0), r"trial\.path_length_m has 2 entries; input 'row' declares 5"),
        ("path_length_m", 1.0, r"trial\.path_length_m is one number; input 'row' declares 5"),
        ("path_length_m", (1, 2, 3, 4, "5"), r"trial\.path_length_m is '5'; input 'row' needs a number"),
        ("task_time_s", (1.0, 2.0), r"trial\.task_time_s has 2 entries; input 'time' declares one number"),
        ("task_time_s", "long", r"trial\.task_time_s is 'long'; input 'time' needs a number"),
    ],
)
def test_a_metric_of_another_shape_is_an_error(
    load_entries: Loader, entry: Writer, metric: str, value: object, message: str
) -> None:
    measures = load_entries(entry("x", "m"))
    with pytest.raises(DefinitionError, match=message):
        estimates(measures, {metric: value})


PICKS = "{statistic: ratio, over: all}"


def test_a_ratio_is_the_sum_of_its_numerators_over_that_of_its_denominators(
    load_entries: Loader, entry: Writer
) -> None:
    measures = load_entries(entry("rate", "share / time", "1/h", estimate=PICKS))
    result = estimates(
        measures,
        {"share": 1, "task_time_s": 10.0},
        {"share": 0, "task_time_s": 40.0},
        {"share": 1, "task_time_s": 14.0},
        {"share": None, "task_time_s": 99.0},
    )["rate"]

    # Two picks in 64 s; the mean of the trials' rates would be 206 an hour.
    assert (result.value, result.n) == (pytest.approx(2 * 3600 / 64), 3)
    assert result.low is not None
    assert result.high is not None
    assert result.low < result.value < result.high


def test_a_ratio_of_nothing_is_unknown(load_entries: Loader, entry: Writer) -> None:
    measures = load_entries(entry("rate", "share / time", "1/h", estimate=PICKS))

    assert estimates(measures, {"share": 1, "task_time_s": 0.0})["rate"] == Estimate.unknown("1/h")
    assert estimates(measures, {"share": 1})["rate"] == Estimate.unknown("1/h")


def test_the_linearised_values_of_a_ratio_have_its_value_as_mean_and_its_variance(
    load_entries: Loader, entry: Writer
) -> None:
    measures = load_entries(entry("rate", "share / time", "1/s", estimate=PICKS))
    rng = np.random.default_rng(3)
    picks, times = rng.integers(0, 2, size=(4000, 200)), rng.uniform(5.0, 20.0, size=(4000, 200))
    rows = [{"share": float(a), "time": float(b)} for a, b in zip(picks[0], times[0], strict=True)]

    values = [value for value in ratio_values(measures.measure("rate"), rows) if value is not None]

    assert math.fsum(values) / 200 == pytest.approx(picks[0].sum() / times[0].sum())
    spread = (picks.sum(axis=1) / times.sum(axis=1)).std()
    assert np.std(values) / math.sqrt(200) == pytest.approx(spread, rel=0.15)
