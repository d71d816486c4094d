"""Each rule of links: the smallest project that breaks it, and what is said about it."""

from __future__ import annotations

from dataclasses import replace

import pytest

from rgss.requirements import LinkKind, TraceLink, load_requirements
from rgss.trace import MeasureKind, check_trace


def test_a_measure_that_traces_to_nothing_known(project):
    project.change("P", traces=("STK-1", "STK-11", "Owner"))
    assert project.findings() == [
        (
            "requirements/measures.yaml:2:5: error: 'P' traces to 'Owner', which is not a stakeholder requirement "
            "[trace.dangling-id]"
        ),
        (
            "requirements/measures.yaml:2:5: error: 'P' traces to 'STK-11', which is not a stakeholder requirement "
            "(did you mean 'STK-1'?) [trace.dangling-id]"
        ),
    ]


def test_a_measure_traces_to_stakeholder_requirements_only(project):
    (finding,) = project.change("P", traces=("STK-1", "SYS-1")).findings()
    assert "'P' traces to 'SYS-1', which is not a stakeholder requirement" in finding


def test_a_measure_that_contributes_to_nothing_known(project):
    project.change("P_g", contributes_to=("P", "P_gg"))
    assert project.findings() == [
        (
            "requirements/measures.yaml:3:5: error: 'P_g' contributes to 'P_gg', which is not a measure "
            "(did you mean 'P_g'?) [trace.dangling-id]"
        )
    ]


def test_two_measures_of_one_id(project):
    project.add("P_g", MeasureKind.MOP, contributes_to=("P",))
    assert project.findings() == [
        (
            "requirements/measures.yaml:4:5: error: id 'P_g' is already declared at requirements/measures.yaml:3:5 "
            "(use a unique id) [trace.duplicate-id]"
        )
    ]


def test_a_measure_with_the_id_of_a_block(project):
    project.add("BLK-1", MeasureKind.SUPPLEMENTARY)
    assert project.findings() == [
        (
            "requirements/measures.yaml:4:5: error: id 'BLK-1' is already declared at "
            "requirements/architecture.yaml:2:10 (use a unique id) [trace.duplicate-id]"
        )
    ]


def test_measures_that_contribute_to_each_other(project):
    project.add("t_b", MeasureKind.SUPPLEMENTARY, contributes_to=("t_c",))
    project.add("t_c", MeasureKind.SUPPLEMENTARY, contributes_to=("t_b",))
    assert project.findings() == [
        (
            "requirements/measures.yaml:4:5: error: 't_b' depends on itself: t_b → t_c → t_b "
            "(cut one of the links) [trace.cycle]"
        )
    ]


def test_a_measure_that_contributes_to_itself(project):
    project.change("P_g", contributes_to=("P", "P_g"))
    (finding,) = project.findings()
    assert "measures.yaml:3:5: error: 'P_g' depends on itself: P_g → P_g (cut" in finding


def test_a_cycle_of_requirements_built_in_code(project):
    """A loader refuses it, but a set may come from elsewhere."""
    requirements = load_requirements(project.folder)
    cyclic = replace(requirements, system=(replace(requirements.system[0], derived_from=("STK-1", "SYS-1")),))
    (finding,) = check_trace(cyclic, project.measures)
    assert str(finding) == (
        "requirements/system.yaml:2:9: error: 'SYS-1' depends on itself: SYS-1 → SYS-1 (cut one of the links) "
        "[trace.cycle]"
    )


@pytest.mark.parametrize(
    ("source", "target", "kind"),
    [
        ("SYS-1", "STK-1", LinkKind.DERIVE),
        ("BLK-1", "SYS-1", LinkKind.SATISFY),
        ("P", "STK-1", LinkKind.TRACE),
        ("P_g", "P", LinkKind.TRACE),
        ("P", "SYS-1", LinkKind.VERIFY),
    ],
)
def test_the_graph_has_the_links(project, source, target, kind):
    model = project.model()
    assert TraceLink(source=source, target=target, kind=kind) in model.links
    assert target in model.targets(source, kind)
    assert source in model.sources(target, kind)


def test_the_graph_leaves_out_links_to_nothing(project):
    model = project.change("P", traces=("STK-1", "STK-9")).model()
    assert "STK-9" not in model.graph
    assert TraceLink(source="P", target="STK-9", kind=LinkKind.TRACE) in model.links


def test_origins_are_the_needs_behind_a_requirement(project):
    assert project.model().origins("SYS-1") == {"STK-1"}
