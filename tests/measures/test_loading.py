from __future__ import annotations

from collections.abc import Callable

import pytest

from rgss.errors import DefinitionError
from rgss.findings import Finding
from rgss.measures import MeasureSet

Loader = Callable[..., MeasureSet]
Finder = Callable[..., tuple[Finding, ...]]
Writer = Callable[..., str]

MEAN = "{statistic: mean, over: all}"
OFFSET = "unit 'degC' is not on a scale that starts at zero"
FIRST_LINE = 12  # of the first measure behind the head of conftest.py


def test_a_small_file_loads(load_entries: Loader, entry: Writer) -> None:
    measures = load_entries(
        entry("speed", "sum(way) / time", "km/h", estimate=MEAN),
        entry("way", "row", "mm", estimate=MEAN, summary="sum"),
        entry("weight", "m * g", "N"),
    )
    assert [measure.id for measure in measures.measures] == ["speed", "way", "weight"]
    assert measures.dependencies("speed") == ("way",)
    assert measures.sources("speed") == ("trial.path_length_m", "trial.task_time_s")
    assert measures.sources("weight") == ("design.d2",)
    assert measures.measure("way").length == 5
    assert measures.measure("way").si_per_unit == 0.001
    assert measures.measure("speed").from_trials
    assert not measures.measure("weight").from_trials
    assert measures.constants[0].value == 10.0
    order = [measure.id for measure in measures.evaluation_order]
    assert order.index("way") < order.index("speed")


def test_constants_come_in_si(load: Loader) -> None:
    measures = load(
        """\
        title: T
        constants:
          - {id: a, value: 35 mm, unit: mm, definition: A., source: S}
          - {id: b, value: 1.5, unit: "1", definition: B., source: S}
          - {id: c, value: 5 %, unit: "1", definition: C., source: S}
        measures:
          - {id: x, kind: supplementary, name: X, definition: X., unit: m, better: none, expression: a * b * c}
        """
    )
    assert [constant.value for constant in measures.constants] == [0.035, 1.5, 0.05]


def test_an_unknown_measure_is_named_with_those_there_are(load_entries: Loader, entry: Writer) -> None:
    measures = load_entries(entry("x", "m"), entry("y", "m"))
    for ask in (measures.measure, measures.dependencies, measures.sources, measures.assumptions_of):
        with pytest.raises(DefinitionError, match=r"no measure 'z' is defined \(measures: x, y\)"):
            ask("z")


@pytest.mark.parametrize(
    ("expression", "unit", "rule", "message"),
    [
        ("m * nothing", "kg", "measures.unknown-symbol", "unknown symbol 'nothing'"),
        ("m * v", "kg", "measures.unit", "the expression gives kg·m·s^-1, the measure's unit is kg"),
        ("2 * foo(m)", "kg", "measures.unknown-function", "unknown function 'foo'"),
        ("m + sum(v)", "kg", "measures.shape", "sum() of a single number; it needs a row"),
        ("m + v", "kg", "measures.unit", "cannot add values in kg and m·s^-1"),
        ("abs(m, m)", "kg", "measures.arguments", "abs() takes one argument, not 2"),
        ("m.real", "kg", "measures.expression", "attribute access is not allowed in an expression"),
        ("m +", "kg", "measures.expression", "not an expression: invalid syntax"),
    ],
)
def test_a_wrong_expression_is_a_finding(
    load_entries: Loader, entry: Writer, findings_of: Finder, expression: str, unit: str, rule: str, message: str
) -> None:
    (finding,) = findings_of(load_entries, entry("x", expression, unit))
    assert (finding.file, finding.line, finding.rule, finding.message) == ("measures.yaml", FIRST_LINE, rule, message)


@pytest.mark.parametrize(
    ("written", "column"),
    [
        ("expression: m + nowt", 21),
        ('expression: "m + nowt"', 22),
        ("expression: 'm + nowt'", 22),
        ("expression: >-\n      m +\n      nowt", 17),
    ],
)
def test_a_finding_points_into_the_expression(load: Loader, findings_of: Finder, written: str, column: int) -> None:
    text = (
        "title: T\ninputs:\n  - {id: m, source: design.d2, unit: kg, definition: M.}\nmeasures:\n"
        "  - id: x\n    kind: supplementary\n    name: X\n    definition: X.\n    unit: kg\n    better: none\n"
        f"    {written}\n"
    )
    (finding,) = findings_of(load, text)
    assert (finding.line, finding.column) == (11, column)
    assert finding.hint == "define it as a constant, an input or a measure"


def test_a_near_symbol_is_suggested(load_entries: Loader, entry: Writer, findings_of: Finder) -> None:
    (finding,) = findings_of(load_entries, entry("x", "2 * tim", "s"))
    assert finding.hint == "did you mean 'time'?"


def test_cycles_are_named_in_the_direction_of_use(load_entries: Loader, entry: Writer, findings_of: Finder) -> None:
    findings = findings_of(load_entries, entry("a", "c"), entry("b", "a"), entry("c", "b + m"), entry("d", "d"))
    assert [(finding.line, finding.rule, finding.message) for finding in findings] == [
        (FIRST_LINE, "measures.cycle", "measures must not depend on each other in a cycle: a → c → b → a"),
        (FIRST_LINE + 3, "measures.cycle", "measures must not depend on each other in a cycle: d → d"),
    ]


def test_what_stands_on_a_broken_measure_is_not_blamed(
    load_entries: Loader, entry: Writer, findings_of: Finder
) -> None:
    findings = findings_of(
        load_entries, entry("a", "m +"), entry("b", "2 * a", estimate=MEAN), entry("c", "b * v", "kg*m/s")
    )
    assert [finding.line for finding in findings] == [FIRST_LINE]


def test_a_measure_is_checked_against_what_another_declares(
    load_entries: Loader, entry: Writer, findings_of: Finder
) -> None:
    (finding,) = findings_of(load_entries, entry("a", "m * v", "kg"), entry("b", "a + m", "kg"))
    assert finding.line == FIRST_LINE


@pytest.mark.parametrize(
    ("more", "rule", "message"),
    [
        ({}, "measures.estimate", "measure 'x' varies from trial to trial and has no 'estimate'"),
        (
            {"estimate": MEAN, "summary": "sum"},
            "measures.summary",
            "measure 'x' is a single number",
        ),
        (
            {"estimate": "{statistic: proportion, over: all}"},
            "measures.estimate",
            'a proportion needs a single number in unit "1"',
        ),
        (
            {"estimate": "{statistic: ratio, over: all}"},
            "measures.estimate",
            "a ratio needs an expression that is a quotient of two numbers",
        ),
        (
            {"estimate": "{statistic: mean, over: all, least: 3 s, most: 50 ms}"},
            "measures.estimate",
            "'least' must be below 'most', got 3 and 0.05 s",
        ),
        (
            {"estimate": "{statistic: mean, over: all, most: 5 kg}"},
            "measures.estimate",
            "unit 'kg' does not measure what 's' measures",
        ),
    ],
)
def test_a_measure_of_trials_says_how_it_is_estimated(
    load_entries: Loader, entry: Writer, findings_of: Finder, more: dict[str, str], rule: str, message: str
) -> None:
    (finding,) = findings_of(load_entries, entry("x", "time", "s", **more))
    assert (finding.rule, finding.message) == (rule, message)


def test_a_proportion_has_its_bounds(load_entries: Loader, entry: Writer, findings_of: Finder) -> None:
    rule = "{statistic: proportion, over: all, most: 0.9}"
    (finding,) = findings_of(load_entries, entry("x", "time / time", "1", estimate=rule))
    assert (finding.message, finding.hint) == ("a proportion is always between 0 and 1", "remove the bound")


def test_a_row_says_how_it_is_summarised(load_entries: Loader, entry: Writer, findings_of: Finder) -> None:
    (finding,) = findings_of(load_entries, entry("x", "row", "m", estimate=MEAN))
    assert (finding.rule, finding.message) == ("measures.summary", "measure 'x' is a row of 5 and has no 'summary'")


def test_a_measure_of_the_design_is_not_estimated(load_entries: Loader, entry: Writer, findings_of: Finder) -> None:
    (finding,) = findings_of(load_entries, entry("x", "m", estimate=MEAN))
    assert finding.message == "measure 'x' follows from the design alone; there is nothing to estimate"


def test_a_proportion_of_a_row_is_refused(load_entries: Loader, entry: Writer, findings_of: Finder) -> None:
    rule = "{statistic: proportion, over: all}"
    (finding,) = findings_of(load_entries, entry("x", "row / row", "1", estimate=rule, summary="mean"))
    assert finding.message == 'a proportion needs a single number in unit "1"'


@pytest.mark.parametrize(
    ("kind", "more", "rule", "message"),
    [
        ("moe", {}, "measures.trace", "measure of effectiveness 'x' traces to no stakeholder need"),
        ("mop", {}, "measures.contribution", "measure of performance 'x' contributes to no measure of effectiveness"),
        ("mop", {"contributes_to": "[y]"}, "measures.contribution", "'y' does not depend on 'x'"),
        ("mop", {"contributes_to": "[z]"}, "measures.contribution", "'z' is not a measure of effectiveness"),
        (
            "supplementary",
            {"traces": "[STK-001]"},
            "measures.trace",
            "only a measure of effectiveness traces to stakeholder needs",
        ),
        (
            "supplementary",
            {"contributes_to": "[y]"},
            "measures.contribution",
            "a supplementary measure contributes to no measure of effectiveness",
        ),
        (
            "moe",
            {"traces": "[STK-001]", "contributes_to": "[y]"},
            "measures.contribution",
            "'y' does not depend on 'x'",
        ),
        ("supplementary", {"equation": '"1.1"'}, "measures.equation", "equation '1.1' is not listed"),
    ],
)
def test_a_measure_says_what_its_kind_calls_for(
    load_entries: Loader, entry: Writer, findings_of: Finder, kind: str, more: dict[str, str], rule: str, message: str
) -> None:
    findings = findings_of(
        load_entries, entry("x", "m", kind=kind, **more), entry("y", "m", kind="moe", traces="[STK-001]")
    )
    assert [(finding.line, finding.rule, finding.message) for finding in findings] == [(FIRST_LINE, rule, message)]


def test_ids_are_symbols_and_stand_once(load: Loader, findings_of: Finder) -> None:
    findings = findings_of(
        load,
        """\
        title: T
        constants:
          - {id: g, value: 1 m, unit: m, definition: G., source: S}
          - {id: g, value: 2 m, unit: m, definition: G., source: S}
        inputs:
          - {id: sum, source: design.d1, unit: m, definition: D.}
          - {id: lambda, source: design.d1, unit: m, definition: D.}
        assumptions:
          - {id: one, statement: S., rationale: R., concerns: [g]}
          - {id: one, statement: S., rationale: R., concerns: [nowhere]}
        equations:
          - {id: "1.1", relation: x = g}
          - {id: "1.1", relation: x = g}
        measures:
          - {id: g, kind: supplementary, name: X, definition: X., unit: m, better: none, expression: 2 * g}
          - {id: x.y, kind: supplementary, name: X, definition: X., unit: m, better: none, expression: g,
             equation: "1.1"}
        """,
    )
    assert [(finding.line, finding.message) for finding in findings] == [
        (4, "id 'g' is already in line 3"),
        (6, "'sum' is the name of a function"),
        (7, "'lambda' cannot be a symbol"),
        (10, "id 'one' is already in line 9"),
        (10, "'nowhere' is not a constant, an input, a measure or an equation"),
        (13, "id '1.1' is already in line 12"),
        (15, "id 'g' is already in line 3"),
        (15, "measures must not depend on each other in a cycle: g → g"),
        (16, "'x.y' cannot be a symbol"),
    ]


def test_constants_inputs_and_equations_are_checked(load: Loader, findings_of: Finder) -> None:
    findings = findings_of(
        load,
        """\
        title: T
        constants:
          - {id: a, value: 1 kg, unit: m, definition: A., source: S}
          - {id: b, value: 1e308 km, unit: km, definition: B., source: S}
          - {id: c, value: 1 m, unit: m, definition: C.}
          - {id: d, value: 3, unit: m, definition: D., source: S}
          - {id: e, value: 20 degC, unit: degC, definition: E., source: S}
        inputs:
          - {id: f, source: elsewhere.f, unit: m, definition: F.}
          - {id: h, source: design.d1, unit: m, length: 5, definition: H.}
          - {id: i, source: trial.temperature, unit: degC, definition: I.}
        equations:
          - {id: "1.1", relation: x = f}
        measures:
          - {id: x, kind: supplementary, name: X, definition: X., unit: m, better: none, expression: f}
        """,
    )
    assert [(finding.line, finding.rule, finding.message) for finding in findings] == [
        (3, "measures.unit", "unit 'kg' does not measure what 'm' measures"),
        (4, "measures.unit", "the number is too large"),
        (5, "measures.unsourced", "constant 'c' has neither a source nor an assumption"),
        (6, "measures.unit", "'3' has no unit"),
        (7, "measures.unit", OFFSET),
        (9, "measures.source", "'elsewhere.f' is not a source"),
        (10, "measures.source", "only a trial's metric can be a row"),
        (11, "measures.unit", OFFSET),
        (13, "measures.equation", "no measure realises equation 1.1"),
    ]


@pytest.mark.parametrize("key", ["kind", "better", "unit", "expression", "name"])
def test_a_measure_needs_its_keys(load_entries: Loader, entry: Writer, findings_of: Finder, key: str) -> None:
    findings = findings_of(load_entries, entry("x", "m", **{key: None}))
    assert f"key {key!r} is missing" in [finding.message for finding in findings]


def test_a_file_needs_a_measure(load: Loader, findings_of: Finder) -> None:
    (finding,) = findings_of(load, "title: T\nmeasures: []\n")
    assert (finding.line, finding.rule) == (2, "document.value")


def test_the_measures_of_one_text_are_those_that_were_built_of_it(load_entries: Loader, entry: Writer) -> None:
    """Studies of one project share a file, and a file that has changed is built anew."""
    first, again = (load_entries(entry("x", "m", "kg")) for _ in range(2))
    other = load_entries(entry("x", "2 * m", "kg"))

    assert again is first
    assert other.measure("x").expression != first.measure("x").expression
    assert load_entries(entry("x", "m", "kg")) is first


def test_what_is_wrong_is_told_each_time(load_entries: Loader, entry: Writer, findings_of: Finder) -> None:
    told = [findings_of(load_entries, entry("x", "m + time", "kg")) for _ in range(2)]

    assert told[0]
    assert told[1] == told[0]
