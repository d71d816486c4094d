"""Criteria: comparison and conversion."""

from __future__ import annotations

import re
from dataclasses import replace

import pytest

from rgss.errors import QuantityError
from rgss.requirements import Comparison, Criterion, Statistic
from rgss.requirements.fields import split_quantity


def criterion(threshold: float, unit: str) -> Criterion:
    return Criterion(
        measure="P_max", statistic=Statistic.VALUE, comparison=Comparison.AT_LEAST, threshold=threshold, unit=unit
    )


@pytest.mark.parametrize(
    ("comparison", "below", "equal", "above"),
    [(">=", False, True, True), ("<=", True, True, False), (">", False, False, True), ("<", True, False, False)],
)
def test_comparisons(comparison, below, equal, above):
    comparison = Comparison(comparison)
    assert [comparison.holds(value, 2.0) for value in (1.0, 2.0, 3.0)] == [below, equal, above]


@pytest.mark.parametrize(
    ("threshold", "unit", "wanted", "converted"),
    [(800.0, "g", "kg", 0.8), (35.0, "mm", "m", 0.035), (90.0, "%", "1", 0.9), (1.0, "min", "s", 60.0)],
)
def test_the_threshold_converts_to_the_unit_of_its_measure(threshold, unit, wanted, converted):
    assert criterion(threshold, unit).threshold_in(wanted) == converted


def test_a_threshold_of_another_dimension_does_not_convert():
    with pytest.raises(QuantityError, match="unit 'kg' does not measure what 's' measures"):
        criterion(0.8, "kg").threshold_in("s")


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("0.8 kg", (0.8, "kg")),
        ("95 %", (0.95, "%")),
        ("3", (3.0, "1")),
        ("90 1/h", (90.0, "1/h")),
        ("9e1/h", (90.0, "1/h")),
    ],
)
def test_a_threshold_is_read_in_the_unit_in_which_it_is_written(text, expected):
    number, unit = split_quantity(text)
    assert (number if unit != "%" else number / 100, unit) == expected


@pytest.mark.parametrize("text", ["90 1 h", "1,5 kg", "3 (", "h", "1/h/2"])
def test_what_is_no_threshold_has_a_hint_that_is_read(text):
    with pytest.raises(QuantityError) as caught:
        split_quantity(text)
    for example in re.findall(r'"(.*)"', caught.value.hint):
        assert split_quantity(example) == (1.0, "kg")


def test_a_threshold_with_the_sign_of_a_currency_is_answered_with_its_code():
    with pytest.raises(QuantityError) as caught:
        split_quantity("43000 €")
    assert "the code of its currency" in caught.value.hint


def test_a_threshold_is_in_any_currency():
    assert split_quantity("43000 EUR") == (43000.0, "EUR")


@pytest.mark.parametrize(("unit", "text"), [("kg", "P_max >= 0.8 kg"), ("1", "P_max >= 0.8")])
def test_a_criterion_reads_as_an_inequality(unit, text):
    assert str(criterion(0.8, unit)) == text


@pytest.mark.parametrize("statistic", [Statistic.LOW, Statistic.HIGH])
def test_an_end_of_the_interval_is_named_in_the_inequality(statistic):
    assert str(replace(criterion(0.8, "kg"), statistic=statistic)) == f"{statistic.value}(P_max) >= 0.8 kg"
