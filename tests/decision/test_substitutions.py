"""Measures of a decision that take another term for one that trials do not observe, and exact ones."""

from __future__ import annotations

from dataclasses import replace

import pytest

from rgss.assessment.measuring import measure_variants
from rgss.decision.choosing import trade_problem
from rgss.decision.robustness.remeasuring import Remeasuring
from rgss.decision.study_decision import decide_study
from rgss.decision.study_decision.substitutions import deciding_substitutions
from rgss.decision.what_if import assumed_numbers
from rgss.designs import sources
from rgss.measures import evaluate
from rgss.reports.decision import decision_lines, trade_document
from rgss.tradeoff.problem import tabulated


@pytest.fixture(scope="module")
def without_bench(shipped, filled, record_of):
    """Records without a payload bench, as kinematic trials have them, some of which failed."""
    return measure_variants(shipped, filled(shipped, lambda spec: record_of(spec, success=spec.seed != 2)))


def with_bench(measured, payload_kg, *, of=range(1, 73)):
    """The same records, in which the bench held a mass."""
    return [
        replace(
            entry,
            records=tuple(
                replace(record, metrics={**record.metrics, "bench_payload_kg": payload_kg}) for record in entry.records
            ),
        )
        if entry.variant.id in of
        else entry
        for entry in measured
    ]


def measured_again(project, measured):
    """The estimates of changed records."""
    return [
        replace(
            entry,
            estimates=evaluate(
                project.measures,
                fixed=sources(entry.variant),
                trials=[record.metrics for record in entry.records],
                variant=entry.variant.id,
            ),
        )
        for entry in measured
    ]


def test_the_page_says_which_requirement_an_equation_decides_for_want_of_a_bench(shipped, without_bench):
    made = decide_study(shipped, without_bench, evidence="evidence.sqlite", analysed=False)
    (found,) = made.substitutions

    assert (found.measure, found.requirements, found.trials) == ("P_max_simulated", ("SYS-012",), 72 * 3)
    assert (found.substitution.missing, found.substitution.taken) == (("bench_payload",), ("P_max_g",))
    assert found.variants == tuple(range(1, 73))
    assert (
        "Caution: 216 trials of all 72 variants have no bench_payload; there P_max_simulated takes P_max_g instead. "
        "SYS-012 is judged by that."
    ) in "\n".join(decision_lines(made))
    (written,) = trade_document(made)["substitutions"]
    assert (written["requirements"], written["missing"], written["trials"]) == (["SYS-012"], ["bench_payload"], 216)
    estimates = {entry.variant.id: entry.estimates for entry in without_bench}
    for variant in (1, 30, 72):
        assert estimates[variant]["P_max_simulated"].value == estimates[variant]["P_max"].value


def test_nothing_is_said_where_every_trial_has_a_bench(shipped, without_bench):
    assert deciding_substitutions(shipped, with_bench(without_bench, 2.0)) == ()


def test_only_the_designs_without_a_bench_are_named(shipped, without_bench):
    (found,) = deciding_substitutions(shipped, with_bench(without_bench, 2.0, of=range(3, 73)))

    assert (found.variants, found.trials) == ((1, 2), 6)


def test_what_a_bench_shows_is_exact_in_a_decision(shipped, without_bench):
    """It has no replicates to draw from, and its threshold no tolerance, whatever the study states."""
    study = replace(shipped.study, trade_off=replace(shipped.study.trade_off, tolerance=0.1))
    problem = trade_problem(replace(shipped, study=study), without_bench)

    assert "P_max_simulated" not in problem.alternatives[0].samples
    limits = {one.requirement: one for one in problem.thresholds}
    assert (limits["SYS-012"].value, limits["SYS-004"].value) == (0.8, 43_000.0)
    assert limits["SYS-024"].value == pytest.approx(0.81)


@pytest.mark.parametrize(("payload_kg", "follows"), [(None, True), (1.5, False)])
def test_an_assumed_number_moves_the_equation_and_not_what_a_bench_showed(shipped, without_bench, payload_kg, follows):
    """Equation 4.8 has the acceleration; the bench was lifted with that of the scene."""
    seen = without_bench if payload_kg is None else measured_again(shipped, with_bench(without_bench, payload_kg))
    table = tabulated(trade_problem(shipped, seen).alternatives)
    (number,) = (one for one in assumed_numbers(shipped) if one.id == "measures.a_m")
    moved = Remeasuring.of(shipped, seen, table).table_with(number, 5.0)

    was, now = (one.column("P_max_simulated") for one in (table, moved))
    expected = was * (9.81 + 1.2) / (9.81 + 5.0) if follows else [1.0] * 72
    assert now == pytest.approx(expected)
