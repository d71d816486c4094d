"""Criteria: comparison and conversion."""

from __future__ import annotations

from dataclasses import replace

import pytest

from rgss.errors import QuantityError
from rgss.requirements import Comparison, Criterion, Statistic


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


@pytest.mark.parametrize(("unit", "text"), [("kg", "P_max >= 0.8 kg"), ("1", "P_max >= 0.8")])
def test_a_criterion_reads_as_an_inequality(unit, text):
    assert str(criterion(0.8, unit)) == text


@pytest.mark.parametrize("statistic", [Statistic.LOW, Statistic.HIGH])
def test_an_end_of_the_interval_is_named_in_the_inequality(statistic):
    assert str(replace(criterion(0.8, "kg"), statistic=statistic)) == f"{statistic.value}(P_max) >= 0.8 kg"
