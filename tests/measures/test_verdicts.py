from __future__ import annotations

import pytest

from rgss.errors import DefinitionError
from rgss.measures import Estimate, Verdict, judge, meets
from rgss.requirements import Comparison, Criterion, Statistic


def criterion(comparison: str, threshold: float, unit: str = "s", statistic: str = "value") -> Criterion:
    return Criterion(
        measure="t_e",
        statistic=Statistic(statistic),
        comparison=Comparison(comparison),
        threshold=threshold,
        unit=unit,
    )


def estimate(value: float | None, low: float | None, high: float | None, unit: str = "s") -> Estimate:
    return Estimate(value=value, unit=unit, low=low, high=high, n=3)


@pytest.mark.parametrize(
    ("comparison", "low", "high", "verdict"),
    [
        (">=", 11.0, 13.0, Verdict.MET),
        (">=", 10.0, 13.0, Verdict.MET),
        (">=", 9.0, 13.0, Verdict.INCONCLUSIVE),
        (">=", 7.0, 9.0, Verdict.NOT_MET),
        ("<=", 11.0, 13.0, Verdict.NOT_MET),
        ("<=", 9.0, 13.0, Verdict.INCONCLUSIVE),
        ("<=", 7.0, 10.0, Verdict.MET),
        (">", 10.0, 13.0, Verdict.INCONCLUSIVE),
        ("<", 7.0, 9.0, Verdict.MET),
    ],
)
def test_a_verdict_needs_the_whole_interval_on_one_side(
    comparison: str, low: float, high: float, verdict: Verdict
) -> None:
    assert judge(criterion(comparison, 10.0), estimate((low + high) / 2, low, high)) is verdict


def test_a_value_on_the_other_side_of_its_interval_is_inconclusive() -> None:
    assert judge(criterion(">=", 10.0), estimate(9.0, 10.5, 12.0)) is Verdict.INCONCLUSIVE


def test_one_trial_is_inconclusive() -> None:
    assert judge(criterion(">=", 10.0), estimate(50.0, None, None)) is Verdict.INCONCLUSIVE


@pytest.mark.parametrize(
    ("comparison", "known", "verdict"),
    [
        (">=", estimate(12.0, 11.0, None), Verdict.MET),
        ("<=", estimate(8.0, None, 9.0), Verdict.MET),
        (">=", estimate(8.0, None, 9.0), Verdict.NOT_MET),
        ("<=", estimate(12.0, 11.0, None), Verdict.NOT_MET),
        (">=", estimate(12.0, None, 13.0), Verdict.INCONCLUSIVE),
        ("<=", estimate(8.0, 7.0, None), Verdict.INCONCLUSIVE),
        (">=", estimate(8.0, 7.0, None), Verdict.INCONCLUSIVE),
        ("<=", estimate(12.0, None, 13.0), Verdict.INCONCLUSIVE),
    ],
)
def test_the_end_that_a_verdict_needs_is_enough(comparison: str, known: Estimate, verdict: Verdict) -> None:
    assert judge(criterion(comparison, 10.0), known) is verdict


def test_no_value_is_not_run() -> None:
    assert judge(criterion(">=", 10.0), Estimate.unknown("s")) is Verdict.NOT_RUN


@pytest.mark.parametrize("known", [estimate(12.0, 11.0, 13.0), estimate(5.0, 4.0, 6.0), Estimate.unknown("s")])
def test_old_evidence_is_stale_whatever_else_is_known(known: Estimate) -> None:
    assert judge(criterion(">=", 10.0), known, stale=True) is Verdict.STALE


def test_a_value_of_the_design_alone_is_judged_by_itself() -> None:
    assert judge(criterion("<=", 1.2), Estimate.exact(1.2, "s")) is Verdict.MET


@pytest.mark.parametrize(
    ("statistic", "verdict"),
    [("value", Verdict.INCONCLUSIVE), ("low", Verdict.NOT_MET), ("high", Verdict.MET)],
)
def test_a_criterion_on_an_end_is_judged_by_that_end(statistic: str, verdict: Verdict) -> None:
    assert judge(criterion(">=", 10.0, statistic=statistic), estimate(10.5, 9.0, 12.0)) is verdict


def test_a_criterion_on_an_end_that_is_not_known_is_inconclusive() -> None:
    assert judge(criterion(">=", 10.0, statistic="low"), estimate(12.0, None, None)) is Verdict.INCONCLUSIVE


def test_units_are_converted() -> None:
    assert judge(criterion("<=", 1.0, unit="min"), estimate(59.0, 58.0, 60.0)) is Verdict.MET
    assert meets(criterion(">=", 800.0, unit="g"), 0.8, "kg")


@pytest.mark.parametrize(("comparison", "answer"), [(">=", True), ("<=", True), (">", False), ("<", False)])
def test_binary_rounding_never_decides(comparison: str, answer: bool) -> None:
    for value in (0.1 + 0.2, 0.3, 0.3 - 1e-12):
        assert meets(criterion(comparison, 0.3), value, "s") is answer
    # Of a limit of 0 there is no share.
    for value in (0.3 - (0.1 + 0.2), 0.0, 60_000.1 - 60_000.0 - 0.1):
        assert meets(criterion(comparison, 0.0), value, "s") is answer


def test_a_criterion_in_another_dimension_cannot_judge() -> None:
    with pytest.raises(DefinitionError, match=r"must be in a unit of criterion t_e <= 10 kg, got 's'"):
        judge(criterion("<=", 10.0, unit="kg"), Estimate.exact(1.0, "s"))
