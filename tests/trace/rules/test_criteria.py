"""Each rule of verification: the smallest project that breaks it, and what is said about it."""

from __future__ import annotations

import pytest


@pytest.mark.verifies("SYS-030")
def test_no_method(project):
    project.edit("system.yaml", "    verification: analysis\n", "")
    assert project.findings() == [
        (
            "requirements/system.yaml:2:9: error: system requirement 'SYS-1' has no verification method (give "
            "'verification' one of inspection, analysis, demonstration, test) [trace.no-method]"
        )
    ]


CRITERION = '    criterion: {measure: P, comparison: ">=", threshold: "800 g"}\n'


def test_no_criterion(project):
    project.edit("system.yaml", CRITERION, "")
    assert project.findings() == [
        (
            "requirements/system.yaml:12:19: error: system requirement 'SYS-1' is verified by analysis, but has no "
            "criterion (give it a 'criterion', or say under 'criterion_exemption' why it has none) [trace.no-criterion]"
        )
    ]


def test_an_exemption_from_the_criterion(project):
    project.edit("system.yaml", CRITERION, "    criterion_exemption: The drawing shows it.\n")
    assert project.findings() == []


@pytest.mark.parametrize("method", ["inspection", "demonstration", "test"])
def test_only_analysis_needs_a_criterion(project, method):
    project.edit("system.yaml", CRITERION, "    success: The gripper lifts a cup.\n")
    assert project.edit("system.yaml", "analysis", method).findings() == []


@pytest.mark.parametrize("method", ["inspection", "demonstration", "test"])
def test_other_methods_need_success_in_words(project, method):
    project.edit("system.yaml", CRITERION, "").edit("system.yaml", "analysis", method)
    assert project.findings() == [
        (
            f"requirements/system.yaml:12:19: error: system requirement 'SYS-1' is verified by {method}, but has no "
            "success criterion (say under 'success' what is to be seen, or give it a 'criterion') [trace.no-success]"
        )
    ]


def test_a_test_may_have_a_criterion_too(project):
    assert project.edit("system.yaml", "analysis", "test").findings() == []


@pytest.mark.parametrize(
    ("removed", "missing"),
    [
        (["    facility: desk\n"], "no facility"),
        (["    phase: development\n"], "no phase"),
        (["    facility: desk\n", "    phase: development\n"], "no facility and no phase"),
    ],
)
def test_a_verification_without_place_or_time_is_noted(project, removed, missing):
    for text in removed:
        project.edit("system.yaml", text, "")
    assert project.findings() == [
        (
            f"requirements/system.yaml:12:19: info: the verification of 'SYS-1' has {missing} (the verification matrix "
            "says where and when) [trace.unplanned]"
        )
    ]


@pytest.mark.parametrize(
    ("words", "comparison", "agrees"),
    [
        ("at least", ">=", True),
        ("at least", "<=", False),
        ("more than", ">", True),
        ("more than", "<", False),
        ("no more than", "<=", True),
        ("no more than", ">=", False),
        ("not less than", ">=", True),
        ("not less than", "<=", False),
        ("at most", "<=", True),
        ("at most", ">=", False),
        ("within", "<=", True),
        ("within", ">=", False),
        ("up to", "<=", True),
        ("up to", ">=", True),
        ("worse than", "<=", True),
        ("no faster than", ">=", False),
        ("no faster than", "<=", True),
        ("a minimum of", ">=", True),
        ("a maximum of", ">=", False),
        ("not exceeding", "<=", True),
        ("not exceeding", ">=", False),
        ("loads ≤", "<=", True),
        ("loads ≤", ">=", False),
        ("loads from", ">=", True),
        ("loads of", "<=", True),
    ],
)
def test_bounds_in_words_agree_with_the_comparison(project, words, comparison, agrees):
    project.edit("system.yaml", "at least", words).edit("system.yaml", '">="', f'"{comparison}"')
    project.append("rules.yaml", "  wording.R33: {enabled: false, reason: not its test}\n")
    assert project.rules() == ([] if agrees else ["trace.contradicting-comparison"])


@pytest.mark.parametrize("behind", ["or less", "at most", "or lighter"])
def test_a_bound_behind_the_number_contradicts_too(project, behind):
    project.edit("system.yaml", "at least 0.8 kg", f"0.8 kg {behind}")
    assert project.rules() == ["trace.contradicting-comparison"]


def test_a_bound_in_a_condition_is_not_what_is_required(project):
    project.edit("system.yaml", "    text: ", "    text: When the load is at most 0.8 kg, and full, ")
    assert "trace.contradicting-comparison" not in project.rules()


def test_a_contradicting_comparison_in_words(project):
    project.edit("system.yaml", '">="', '"<="')
    assert project.findings() == [
        (
            "requirements/system.yaml:4:11: error: text of 'SYS-1' says 'at least 0.8 kg', but its criterion says "
            "'P <= 800 g' (make them agree) [trace.contradicting-comparison]"
        )
    ]


def test_unknown_measure(project):
    project.edit("system.yaml", "measure: P,", "measure: Q,")
    assert project.findings() == [
        (
            "requirements/system.yaml:15:26: error: criterion of 'SYS-1' bounds 'Q', which is not a measure "
            "(known measures: P, P_g) [trace.unknown-measure]"
        )
    ]


def test_unit_of_another_dimension(project):
    project.change("P", unit="s")
    assert project.findings() == [
        (
            "requirements/system.yaml:15:58: error: criterion of 'SYS-1' has the unit 'g', but 'P' is measured in 's' "
            "(give the threshold in s or a unit that converts to it) [trace.criterion-unit]"
        )
    ]


def test_a_bare_number_is_no_mass(project):
    project.edit("system.yaml", '"800 g"', "0.8").edit("system.yaml", "0.8 kg.", "a cup.")
    assert [finding.rsplit(" ", 1)[1] for finding in project.findings()] == ["[trace.criterion-unit]"]


def test_contradicting_number(project):
    project.edit("system.yaml", "0.8 kg", "0.9 kg at 2 m/s")
    assert project.findings() == [
        (
            "requirements/system.yaml:4:11: error: text of 'SYS-1' says '0.9 kg', but its criterion says 'P >= 800 g' "
            "(make them agree) [trace.contradicting-number]"
        )
    ]


@pytest.mark.parametrize("text", ["0.8 kg", "800 g", "0.80 kg within 3 s", "a cup of 0.2 kg filled to 0.8 kg", "a cup"])
def test_numbers_that_do_not_contradict(project, text):
    assert project.edit("system.yaml", "0.8 kg", text).findings() == []


@pytest.mark.parametrize(
    ("text", "threshold", "agrees"),
    [
        ("a score of at least 0.9", "0.9", True),
        ("a score of at least 90 %", "0.9", True),
        ("a score of at least 0.8", "0.9", False),
        ("a score of at least 0.8", '"80 %"', True),
        ("a score within 60 s", "0.9", True),
        ("0.9 in a row", "0.9", True),
    ],
)
def test_pure_numbers_agree_with_pure_thresholds(project, text, threshold, agrees):
    project.change("P", unit="1").edit("system.yaml", '"800 g"', threshold).edit("system.yaml", "0.8 kg", text)
    expected = [] if agrees else ["[trace.contradicting-number]"]
    assert [finding.rsplit(" ", 1)[1] for finding in project.findings()] == expected


@pytest.mark.parametrize(
    ("unit", "text", "threshold", "agrees"),
    [
        ("K", "20 degC", "293.15 K", True),
        ("K", "20 °C", "293.15 K", True),
        ("K", "68 degF", "293.15 K", True),
        ("K", "20 degC", "20 K", True),
        ("K", "20 degC", "293 K", False),
        ("1", "62 dB", "62", True),
        ("1", "62 dB", "60", False),
    ],
)
def test_a_temperature_is_a_point_or_a_difference_and_a_level_a_pure_number(project, unit, text, threshold, agrees):
    project.change("P", unit=unit).edit("system.yaml", '"800 g"', threshold).edit("system.yaml", "0.8 kg", text)
    expected = [] if agrees else ["[trace.contradicting-number]"]
    assert [finding.rsplit(" ", 1)[1] for finding in project.findings()] == expected


@pytest.mark.parametrize(
    ("threshold", "hint"),
    [
        ("40 degC", 'write "313.15 K", or use delta_degC for a difference'),
        ("14 degF", 'write "263.15 K", or use delta_degF for a difference'),
        ("62 dB", "write the level as a pure number, 62, and give its measure the unit 1"),
        ("3 dBm", "write the level as a pure number, 3, and give its measure the unit 1"),
    ],
)
def test_a_threshold_with_an_offset_or_a_logarithm_is_refused_where_it_is_read(project, threshold, hint):
    (finding,) = project.edit("system.yaml", '"800 g"', threshold).found()
    unit = threshold.split()[1]
    assert finding.message == f"threshold: unit '{unit}' is not on a scale that starts at zero ({hint})"


def test_a_difference_of_temperatures_is_a_threshold(project):
    project.change("P", unit="K").edit("system.yaml", '"800 g"', "5 delta_degC").edit("system.yaml", "0.8 kg", "5 K")
    assert not project.findings()


@pytest.mark.parametrize(
    ("text", "threshold", "agrees"),
    [
        ("0,5 kg", "5 kg", False),
        ("0,5 kg", "0.5 kg", True),
        ("2,5 kg", "5 kg", False),
        ("2,5 kg", "2.5 kg", True),
        ("5 × 10^2 g", "2 g", False),
        ("5 × 10^2 g", "0.5 kg", True),
        ("5 x 10^-1 kg", "0.5 kg", True),
        ("1 500 g", "1.5 kg", True),
        ("1 500 g", "5 kg", False),
        ("1\u00a0500 g", "1.5 kg", True),
        ("1\u00a0500 g", "0.5 kg", False),
        ("1\u202f500 g", "1.5 kg", True),
        ("1,500 kg", "1.5 kg", True),
        ("1,500 kg", "1500 kg", True),
        ("1,500 kg", "500 kg", False),
        ("10³ g", "1 kg", True),
        ("1.500.000 g", "5 kg", True),
        ("1/2 kg", "0.5 kg", True),
        ("10^6 cycles of 0.8 kg", "0.8 kg", True),
    ],
)
def test_a_number_is_compared_as_a_whole(project, text, threshold, agrees):
    project.edit("system.yaml", "0.8 kg", text).edit("system.yaml", "800 g", threshold)
    assert project.rules() == ([] if agrees else ["trace.contradicting-number"])


@pytest.mark.parametrize(("text", "agrees"), [("10^6 cycles", True), ("10⁶ cycles", True), ("10^5 cycles", False)])
def test_a_count_is_compared_with_a_pure_threshold(project, text, agrees):
    project.change("P", unit="1").edit("system.yaml", '"800 g"', "1000000").edit("system.yaml", "0.8 kg", text)
    assert project.rules() == ([] if agrees else ["trace.contradicting-number"])


@pytest.mark.parametrize(
    ("text", "agrees"),
    [
        ("at least 43000 USD", True),
        ("at least USD 43,000", True),
        ("at least $43000", True),
        ("at least $43k", True),
        ("at least USD 90000", False),
        ("at least 90000 EUR", False),
        ("at least 43000 EUR", False),
        ("at least 43000 USD, which were 40000 EUR", True),
    ],
)
def test_money_is_compared_with_its_currency(project, text, agrees):
    project.change("P", unit="USD").edit("system.yaml", "800 g", "43000 USD")
    project.edit("system.yaml", "at least 0.8 kg", text)
    assert project.rules() == ([] if agrees else ["trace.contradicting-number"])


@pytest.mark.parametrize(
    ("text", "agrees"), [("at least 43000 EUR", True), ("at least €43k", True), ("at least 43000 USD", False)]
)
def test_a_threshold_in_euro_is_compared_with_euro(project, text, agrees):
    project.change("P", unit="EUR").edit("system.yaml", "800 g", "43000 EUR")
    project.edit("system.yaml", "at least 0.8 kg", text)
    assert project.rules() == ([] if agrees else ["trace.contradicting-number"])


def test_a_bound_in_a_condition_behind_the_response_is_not_what_is_required(project):
    project.edit("system.yaml", "at least 0.8 kg", "at least 0.8 kg while the load is at most 0.8 kg")
    assert "trace.contradicting-comparison" not in project.rules()
