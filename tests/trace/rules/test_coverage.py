"""Each rule of coverage: the smallest project that breaks it, and what is said about it."""

from __future__ import annotations

import pytest

from rgss.trace import MeasureKind

NEED = """\
  - id: STK-2
    kind: design
    text: The system shall fit on a table.
    rationale: R
    source: S
    priority: low
    status: draft
    owner: O
"""
REQUIREMENT = """\
  - id: SYS-2
    group: gripper
    text: The gripper shall open.
    rationale: A closed one holds on.
    source: catalogue
    priority: low
    status: draft
    owner: engineer
    derived_from: [STK-1]
    satisfied_by: [BLK-1]
    verification: test
    success: It opens.
    facility: desk
    phase: development
"""


@pytest.mark.verifies("SYS-030")
def test_the_sound_project_has_no_findings(project):
    assert project.findings() == []


@pytest.mark.verifies("SYS-030")
def test_orphan(project):
    project.append("system.yaml", REQUIREMENT.replace("    derived_from: [STK-1]\n", ""))
    assert project.findings() == [
        (
            f"{project.position('system.yaml', 'SYS-2')}: error: system requirement 'SYS-2' derives from no "
            "stakeholder requirement (name its parent under 'derived_from') [trace.orphan]"
        )
    ]


def test_a_requirement_that_derives_from_an_orphan_is_one_too(project):
    project.append("system.yaml", REQUIREMENT.replace("    derived_from: [STK-1]\n", ""))
    again = REQUIREMENT.replace("STK-1", "SYS-2").replace("id: SYS-2", "id: SYS-3").replace("open", "close")
    project.append("system.yaml", again)
    assert [finding.split(" derives")[0].rsplit(" ", 1)[1] for finding in project.findings()] == ["'SYS-2'", "'SYS-3'"]


def test_a_requirement_may_derive_from_a_need_over_steps(project):
    project.append("system.yaml", REQUIREMENT.replace("STK-1", "SYS-1"))
    assert project.findings() == []


@pytest.mark.verifies("SYS-030")
def test_childless(project):
    project.append("stakeholder.yaml", NEED).change("P", traces=("STK-1", "STK-2"))
    assert project.findings() == [
        (
            "requirements/stakeholder.yaml:10:9: error: no system requirement derives from stakeholder requirement "
            "'STK-2' (name it under 'derived_from' of one that does) [trace.childless]"
        )
    ]


@pytest.mark.verifies("SYS-030")
def test_need_without_measure_of_effectiveness(project):
    project.append("stakeholder.yaml", NEED).edit("system.yaml", "[STK-1]", "[STK-1, STK-2]")
    assert project.findings() == [
        (
            "requirements/stakeholder.yaml:10:9: error: no measure of effectiveness traces to stakeholder requirement "
            "'STK-2' (name it under 'traces' of one that does) [trace.no-moe]"
        )
    ]


def test_a_measure_of_performance_does_not_stand_for_a_need(project):
    project.append("stakeholder.yaml", NEED).edit("system.yaml", "[STK-1]", "[STK-1, STK-2]")
    project.change("P_g", traces=("STK-2",))
    assert [finding.rsplit(" ", 1)[1] for finding in project.findings()] == ["[trace.no-moe]"]


@pytest.mark.verifies("SYS-030")
def test_measure_of_effectiveness_without_need(project):
    project.add("C", MeasureKind.MOE, observed=True)
    assert project.findings() == [
        (
            "requirements/measures.yaml:4:5: error: measure of effectiveness 'C' traces to no stakeholder requirement "
            "(name one under 'traces') [trace.moe-without-need]"
        )
    ]


@pytest.mark.verifies("SYS-030")
def test_measure_of_effectiveness_without_measure_of_performance(project):
    project.add("S", MeasureKind.MOE, traces=("STK-1",))
    assert project.findings() == [
        (
            "requirements/measures.yaml:4:5: error: no other measure contributes to measure of effectiveness "
            "'S' (compute it from one, or from the trials themselves) [trace.moe-without-mop]"
        )
    ]


def test_a_measure_that_is_observed_needs_no_measure_of_performance(project):
    assert project.add("S", MeasureKind.MOE, traces=("STK-1",), observed=True).findings() == []


def test_measure_of_performance_that_contributes_to_nothing(project):
    project.add("M", MeasureKind.MOP)
    assert project.findings() == [
        (
            "requirements/measures.yaml:4:5: warning: measure of performance 'M' contributes to no measure of "
            "effectiveness (use it in one, or make it supplementary) [trace.mop-without-moe]"
        )
    ]


def test_a_supplementary_measure_need_not_trace(project):
    assert project.add("t_m", MeasureKind.SUPPLEMENTARY).findings() == []


@pytest.mark.verifies("SYS-030")
def test_unallocated(project):
    project.append("system.yaml", REQUIREMENT.replace("    satisfied_by: [BLK-1]\n", ""))
    assert project.findings() == [
        (
            f"{project.position('system.yaml', 'SYS-2')}: error: system requirement 'SYS-2' is satisfied by no block "
            "or behaviour (name one under 'satisfied_by') [trace.unallocated]"
        )
    ]


def test_an_element_that_satisfies_nothing_is_listed(project):
    behaviour = "  - {id: UC-1, name: Lift, kind: use_case, text: Lifts., allocated_to: [BLK-1]}\n"
    project.append("architecture.yaml", f"behaviours:\n{behaviour}")
    assert project.findings() == [
        "requirements/architecture.yaml:4:10: info: 'UC-1' satisfies no system requirement [trace.idle-element]"
    ]


def test_a_behaviour_that_no_block_does(project):
    project.append("architecture.yaml", "behaviours:\n  - {id: UC-1, name: Lift, kind: use_case, text: Lifts.}\n")
    project.edit("system.yaml", "[BLK-1]", "[BLK-1, UC-1]")
    assert project.findings() == [
        (
            "requirements/architecture.yaml:4:10: warning: behaviour 'UC-1' is allocated to no block (name one under "
            "'allocated_to') [trace.unallocated-behaviour]"
        )
    ]


def test_a_chain_of_derivations_of_any_length_answers_its_need(project):
    links = [REQUIREMENT.replace("SYS-2", f"SYS-{n}").replace("STK-1", f"SYS-{n - 1}") for n in range(2, 400)]
    texts = [link.replace("open", f"open at station {n} of the line") for n, link in enumerate(links)]
    assert project.append("system.yaml", "".join(texts)).findings() == []
