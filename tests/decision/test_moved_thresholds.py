"""Repairs of limits on which values are anchored, against the study decided anew with the limits that they need."""

from __future__ import annotations

from dataclasses import replace

import pytest

from rgss.assessment.measuring import measure_variants
from rgss.decision.choosing import choose
from rgss.decision.moved_thresholds import with_thresholds

ANCHORED = (
    "values:",
    "  - {measure: P_max_simulated, weight: 0.25, worst: {requirement: SYS-012}, best: 2.5 kg}",
    "  - {measure: C_total, weight: 0.25, worst: {requirement: SYS-004}, best: 30000 USD}",
    "  - {measure: t_e_simulated, weight: 0.3, worst: {requirement: SYS-005}, best: 5 s}",
    "  - {measure: S, weight: 0.2, worst: 0.8, best: 1.0}",
)
TOLERANT = (*ANCHORED, "tolerance: 10 %")


@pytest.fixture(scope="module")
def measured(shipped, filled, record_of):
    store = filled(
        shipped,
        lambda spec: record_of(
            spec, planning_s=0.5 + 0.05 * (spec.variant % 9) + 0.1 * spec.seed, path_m=0.4 + 0.05 * (spec.variant % 5)
        ),
    )
    return measure_variants(shipped, store)


@pytest.mark.parametrize("choice", [ANCHORED, TOLERANT], ids=["exact", "tolerant"])
@pytest.mark.parametrize(
    "limits",
    [
        {"SYS-004": 38500.0},
        {"SYS-005": 10.0},
        {"SYS-012": 2.0},
        {"SYS-004": 38500.0, "SYS-012": 2.0},
        {"SYS-005": 10.5, "SYS-012": 1.9},
        {"SYS-004": 39000.0, "SYS-005": 10.0, "SYS-012": 1.8},
    ],
    ids="+".join,
)
def test_the_choice_after_a_repair_is_that_of_the_study_with_the_limits_it_needs(
    shipped, measured, read_trade_off_of, choice, limits
):
    project = with_thresholds(replace(shipped, study=read_trade_off_of(*choice)), limits)
    conflicts = choose(project, measured).conflicts

    repairs = [one for one in (*conflicts.repairs, *conflicts.joint_repairs) if one.changes]
    assert repairs
    for repair in repairs:
        needed = {change.requirement: change.needed for change in repair.changes}
        assert choose(with_thresholds(project, needed), measured).chosen == repair.winner


@pytest.mark.parametrize(("worst", "named"), [("99 s", True), ("30 s", False)])
def test_a_repair_at_whose_limit_no_value_is_defined_names_no_choice(
    shipped, filled, record_of, read_trade_off_of, worst, named
):
    """The best end moves with the limit, beyond the worst."""
    slow = measure_variants(shipped, filled(shipped, lambda spec: record_of(spec, motion_s=60.0)))
    anchors = "worst: {requirement: SYS-005}, best: 5 s"
    choice = [line.replace(anchors, f"worst: {worst}, best: {{requirement: SYS-005}}") for line in ANCHORED]
    conflicts = choose(replace(shipped, study=read_trade_off_of(*choice)), slow).conflicts
    (repair,) = [one for one in conflicts.repairs if one.changes]

    assert repair.requirement == "SYS-005"
    assert repair.changes[0].needed > 60.0
    assert repair.unlocked > 0
    assert (repair.winner is not None) is named
