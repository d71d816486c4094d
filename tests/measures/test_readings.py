"""Alternative readings of a measure, and the simulated twin of an equation."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from rgss.errors import DefinitionError
from rgss.findings import Finding
from rgss.measures import Estimate, MeasureSet, evaluate, model_gaps, with_alternative

Loader = Callable[..., MeasureSet]
Finder = Callable[..., tuple[Finding, ...]]
Writer = Callable[..., str]

MEAN = "{statistic: mean, over: all}"
FIXED: dict[str, float | str] = {"design.d2": 3.0, "design.d7": 0.5}


def value_of(measures: MeasureSet, measure: str, *trials: dict[str, float]) -> float | None:
    return evaluate(measures, fixed=FIXED, trials=trials, variant=1)[measure].value


def test_what_depends_on_a_measure_follows_its_reading(load_entries: Loader, entry: Writer) -> None:
    alternatives = "[{id: halved, expression: m / 2, rationale: So it may be read.}]"
    measures = load_entries(
        entry("weight", "m * g", "N", alternatives="[]"),
        entry("twice", "2 * mass", "kg"),
        entry("mass", "m", "kg", alternatives=alternatives),
    )

    read = with_alternative(measures, "mass", "halved")

    assert (value_of(measures, "twice"), value_of(read, "twice")) == (6.0, 3.0)
    assert value_of(read, "weight") == value_of(measures, "weight")
    assert measures.measure("mass").alternatives[0].rationale == "So it may be read."


def test_a_reading_may_use_other_measures_and_symbols(load_entries: Loader, entry: Writer) -> None:
    measures = load_entries(
        entry("a", "m", "kg", alternatives="[{id: whole, expression: b, rationale: R.}]"),
        entry("b", "3 * m", "kg"),
    )

    read = with_alternative(measures, "a", "whole")

    assert value_of(read, "a") == 9.0
    assert read.used["a"] >= {"b", "m"}
    assert [one.id for one in read.evaluation_order] == ["b", "a"]


def test_a_reading_may_change_the_estimate_alone(load_entries: Loader, entry: Writer) -> None:
    alternatives = f"[{{id: mean, estimate: {MEAN}, rationale: R.}}]"
    rule = "{statistic: proportion, over: all}"
    measures = load_entries(entry("s", "share", "1", estimate=rule, alternatives=alternatives))
    trials: tuple[dict[str, float], ...] = ({"share": 1.0}, {"share": 0.5})

    assert value_of(measures, "s", *trials) == 0.5
    assert value_of(with_alternative(measures, "s", "mean"), "s", *trials) == 0.75


def test_a_reading_of_a_measure_of_trials_may_follow_from_the_design(load_entries: Loader, entry: Writer) -> None:
    alternatives = "[{id: stated, expression: m / 2, rationale: R.}]"
    measures = load_entries(
        entry("s", "m * share", "kg", estimate=MEAN, alternatives=alternatives),
        entry("twice", "2 * s", "kg", estimate=MEAN),
    )
    stated = with_alternative(measures, "s", "stated")

    assert stated.measure("s").estimate is None
    assert value_of(measures, "s", {"share": 0.1}) == pytest.approx(0.3)
    assert (value_of(stated, "s"), value_of(stated, "s", {"share": 0.1})) == (1.5, 1.5)
    assert value_of(stated, "twice", {"share": 0.1}) == 3.0


def test_two_readings_that_need_each_other_cannot_be_taken_together(load_entries: Loader, entry: Writer) -> None:
    measures = load_entries(
        entry("a", "m", "kg", alternatives="[{id: other, expression: b, rationale: R.}]"),
        entry("b", "m", "kg", alternatives="[{id: other, expression: a, rationale: R.}]"),
    )
    read = with_alternative(measures, "a", "other")

    with pytest.raises(DefinitionError, match="would depend on each other in a cycle: a → b → a"):
        with_alternative(read, "b", "other")


@pytest.mark.parametrize(
    ("measure", "message"),
    [
        ("a", r"measure 'a' has no alternative 'none' \(alternatives: half\)"),
        ("b", r"measure 'b' has no alternative 'none' \(b has no alternatives\)"),
    ],
)
def test_an_unknown_alternative_names_those_there_are(
    load_entries: Loader, entry: Writer, measure: str, message: str
) -> None:
    measures = load_entries(
        entry("a", "m", "kg", alternatives="[{id: half, expression: m / 2, rationale: R.}]"), entry("b", "m", "kg")
    )

    with pytest.raises(DefinitionError, match=message):
        with_alternative(measures, measure, "none")


@pytest.mark.parametrize(
    ("alternatives", "rule", "message"),
    [
        ("[{id: x, rationale: R.}]", "measures.alternative", "alternative 'x' of 'a' changes nothing"),
        (
            "[{id: x, expression: m / 2, rationale: R.}, {id: x, expression: m / 3, rationale: R.}]",
            "measures.alternative",
            "alternative 'x' of 'a' is defined twice",
        ),
        (
            "[{id: x, expression: m * v, rationale: R.}]",
            "measures.unit",
            "alternative 'x' of 'a': the expression gives kg·m·s^-1, the measure's unit is kg",
        ),
        (
            "[{id: x, expression: n + 1, rationale: R.}]",
            "measures.unknown-symbol",
            "alternative 'x' of 'a': unknown symbol 'n'",
        ),
        (
            "[{id: x, expression: m +, rationale: R.}]",
            "measures.expression",
            "alternative 'x' of 'a': not an expression",
        ),
        (
            "[{id: x, expression: a, rationale: R.}]",
            "measures.cycle",
            "alternative 'x' of 'a': measures must not depend on each other in a cycle: a → a",
        ),
        (
            f"[{{id: x, estimate: {MEAN}, rationale: R.}}]",
            "measures.estimate",
            "alternative 'x' of 'a': measure 'a' follows from the design alone; there is nothing to estimate",
        ),
    ],
)
def test_a_wrong_alternative_is_a_finding_in_its_line(
    load_entries: Loader, entry: Writer, findings_of: Finder, alternatives: str, rule: str, message: str
) -> None:
    found = findings_of(load_entries, entry("a", "m", "kg", alternatives=alternatives))

    assert found[-1].rule == rule
    assert found[-1].message.startswith(message)
    assert (found[-1].file, found[-1].line) == ("measures.yaml", 12)


@pytest.mark.parametrize(
    ("twin", "message"),
    [
        ("nothing", "'nothing' is not another measure"),
        ("a", "'a' is not another measure"),
        ("speed", "'speed' is measured in 'm/s', 'a' in 's'"),
        ("design_time", "'design_time' depends only on the design, not on simulation"),
    ],
)
def test_a_simulated_twin_is_a_measure_of_trials_in_the_same_dimension(
    load_entries: Loader, entry: Writer, findings_of: Finder, twin: str, message: str
) -> None:
    found = findings_of(
        load_entries,
        entry("a", "m / m * time", "s", estimate=MEAN, simulated_as=twin),
        entry("speed", "sum(row) / time", "m/s", estimate=MEAN),
        entry("design_time", "v / g", "s"),
    )

    assert [(one.rule, one.message) for one in found] == [("measures.simulated-as", message)]


def test_the_gap_is_in_the_unit_of_the_equation(load_entries: Loader, entry: Writer) -> None:
    measures = load_entries(
        entry("by_equation", "v / g", "s", simulated_as="simulated"),
        entry("simulated", "time", "ms", estimate=MEAN),
    )

    def gap(equation: float | None, simulated: float | None):
        estimates = {
            "by_equation": Estimate(value=equation, unit="s", low=None, high=None, n=0),
            "simulated": Estimate(value=simulated, unit="ms", low=None, high=None, n=3),
        }
        return model_gaps(measures, estimates)

    (found,) = gap(10.0, 11_500.0)
    assert (found.unit, found.simulated, found.is_notable) == ("s", pytest.approx(11.5), True)
    assert found.relative == pytest.approx(0.15)
    assert not gap(10.0, 10_999.0)[0].is_notable
    assert gap(10.0, 8_900.0)[0].is_notable
    assert gap(0.0, 1.0)[0].is_notable
    assert not gap(0.0, 0.0)[0].is_notable
    assert gap(10.0, None) == gap(None, 10.0) == ()


def test_the_readings_of_the_source_are_alternatives(reference: MeasureSet) -> None:
    found = {(measure.id, one.id) for measure in reference.measures for one in measure.alternatives}

    assert found >= {
        ("S", "share_of_states"),
        ("P_max", "force_of_the_hand"),
        ("P_max_simulated", "force_of_the_hand"),
        ("P_max_simulated", "equation"),
        ("t_e", "without_planning"),
        ("t_e", "simulated"),
        ("t_e_simulated", "without_planning"),
        ("P_max", "simulated"),
    }
    assert {measure.id: measure.simulated_as for measure in reference.measures if measure.simulated_as} == {
        "t_e": "t_e_simulated",
        "P_max": "P_max_simulated",
        "t_m": "t_m_simulated",
        "t_gc": "t_gc_simulated",
        "v_m": "v_m_peak",
    }
