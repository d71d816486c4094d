"""The decision, against an enumeration that knows nothing of programs."""

from __future__ import annotations

from dataclasses import replace

import pytest

from rgss.assessment.measuring import measure_variants, requirements_with_criteria
from rgss.decision.choosing import choose, double_counting, trade_problem
from rgss.errors import DefinitionError, EvidenceError
from rgss.requirements import Comparison, Statistic


@pytest.fixture(scope="module")
def measured(shipped, filled, record_of):
    """Fast tools and few planning seconds; TRRT fails once in three."""

    def record_for(spec):
        return record_of(
            spec,
            success=not (spec.planner == "TRRT" and spec.seed == 2),
            planning_s=0.2 * (1 + spec.variant % 7),
            path_m=0.4 + 0.01 * (spec.variant % 11),
        )

    return measure_variants(shipped, filled(shipped, record_for))


def with_criterion(project, requirement_id, **changes):
    """A project with another criterion on one requirement."""
    system = tuple(
        replace(item, criterion=replace(item.criterion, **changes)) if item.id == requirement_id else item
        for item in project.requirements.system
    )
    return replace(project, requirements=replace(project.requirements, system=system))


def brute_force(project, measured):
    """Ids of the variants that meet every criterion, with their values, best first."""
    ranking = []
    for entry in measured:
        values = {}
        for anchors in project.study.values:
            quantity = entry.estimates[anchors.measure].value
            share = None if quantity is None else (quantity - anchors.worst) / (anchors.best - anchors.worst)
            values[anchors.measure] = None if share is None else anchors.weight * min(1.0, max(0.0, share))
        feasible = None not in values.values()
        for requirement in requirements_with_criteria(project):
            criterion = requirement.criterion
            estimate = entry.estimates[criterion.measure]
            number = {
                Statistic.VALUE: estimate.value,
                Statistic.LOW: estimate.low,
                Statistic.HIGH: estimate.high,
            }[criterion.statistic]
            threshold = criterion.threshold_in(estimate.unit)
            met = number is not None and (
                number >= threshold if criterion.comparison is Comparison.AT_LEAST else number <= threshold
            )
            feasible = feasible and met
        if feasible:
            ranking.append((-sum(values.values()), entry.variant.id))
    return [(variant, -value) for value, variant in sorted(ranking)]


@pytest.mark.verifies("SYS-038")
def test_the_choice_is_the_one_of_enumeration(shipped, measured):
    decision = choose(shipped, measured)
    expected = brute_force(shipped, measured)

    assert decision.certificate.enumeration_agrees
    assert decision.chosen == expected[0][0]
    assert [ranked.variant for ranked in decision.ranking] == [variant for variant, _ in expected]
    assert [ranked.value for ranked in decision.ranking] == pytest.approx([value for _, value in expected])
    assert len(decision.ranking) + len(decision.infeasible) == 72


def test_a_variant_that_fails_too_often_is_infeasible(shipped, measured):
    decision = choose(shipped, measured)
    trrt = {entry.variant.id for entry in measured if entry.variant.parameters["d8"] == "TRRT"}

    assert trrt <= {alternative.variant for alternative in decision.infeasible}
    assert all("SYS-024" in each.requirements for each in decision.infeasible if each.variant in trrt)


@pytest.mark.parametrize("statistic", [Statistic.LOW, Statistic.HIGH])
def test_a_criterion_may_ask_for_an_end_of_the_interval(shipped, measured, statistic):
    """Three successes of three: the interval of Clopper and Pearson is from 0.29 to 1."""
    project = with_criterion(shipped, "SYS-024", statistic=statistic, threshold=0.25)
    problem = trade_problem(project, measured)
    (threshold,) = (each for each in problem.thresholds if each.requirement == "SYS-024")
    found = {each.variant: each.measures[threshold.measure] for each in problem.alternatives}

    assert threshold.measure == f"S.{statistic.value}"
    assert problem.alternatives[0].measures["S"] == measured[0].estimates["S"].value
    assert found == {entry.variant.id: getattr(entry.estimates["S"], statistic.value) for entry in measured}
    assert choose(project, measured).chosen == brute_force(project, measured)[0][0]
    strict = with_criterion(shipped, "SYS-024", statistic=Statistic.LOW, threshold=0.3)
    assert choose(strict, measured).chosen is None
    assert brute_force(strict, measured) == []


def test_thresholds_are_in_the_units_of_their_measures(shipped, measured):
    project = with_criterion(shipped, "SYS-012", threshold=800.0, unit="g")
    (threshold,) = (each for each in trade_problem(project, measured).thresholds if each.requirement == "SYS-012")

    assert (threshold.value, threshold.unit) == (pytest.approx(0.8), "kg")
    assert choose(project, measured).chosen == choose(shipped, measured).chosen


@pytest.mark.parametrize("comparison", [Comparison.ABOVE, Comparison.BELOW])
def test_a_strict_comparison_is_refused(shipped, measured, comparison):
    project = with_criterion(shipped, "SYS-024", comparison=comparison)

    with pytest.raises(DefinitionError) as caught:
        trade_problem(project, measured)
    assert caught.value.message == f"SYS-024: a program cannot have the strict comparison '{comparison.value}'"
    assert caught.value.hint == "write >= or <="


def test_a_choice_needs_all_evidence(shipped, filled, record_of):
    measured = measure_variants(shipped, filled(shipped, lambda spec: record_of(spec) if spec.seed > 1 else None))

    with pytest.raises(EvidenceError, match=r"72 of 216 trials have no evidence .* \(run 'rgss sweep' first\)"):
        choose(shipped, measured)


def test_a_measure_that_no_trial_gave_makes_infeasible(shipped, filled, record_of):
    def record_for(spec):
        return record_of(spec, success=spec.variant != 7)

    decision = choose(shipped, measure_variants(shipped, filled(shipped, record_for)))
    (seventh,) = (each for each in decision.infeasible if each.variant == 7)

    assert seventh.value is None
    assert "SYS-024" in seventh.requirements


def test_nothing_is_feasible(shipped, measured):
    project = with_criterion(shipped, "SYS-012", threshold=50.0)
    decision = choose(project, measured)

    assert decision.chosen is None
    assert decision.conflicts is not None
    assert "SYS-012" in decision.conflicts.minimal_conflict


def test_planning_counts_twice_where_both_times_are_valued(shipped):
    assert [(overlap.whole, overlap.part) for overlap in double_counting(shipped)] == [("t_e", "t_p")]
