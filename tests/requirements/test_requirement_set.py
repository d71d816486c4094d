"""What a set of requirements answers."""

from __future__ import annotations

from dataclasses import replace

import pytest

from rgss.errors import DefinitionError
from rgss.findings import Severity
from rgss.requirements import LinkKind, TraceLink


def test_links_are_those_that_the_files_state(project):
    assert project.load().links == tuple(
        TraceLink(source=source, target=target, kind=kind)
        for source, target, kind in [
            ("SYS-1", "STK-1", LinkKind.DERIVE),
            ("BLK-1", "SYS-1", LinkKind.SATISFY),
            ("ACT-1", "SYS-1", LinkKind.SATISFY),
            ("BLK-1", "BLK-0", LinkKind.CONTAINMENT),
            ("UC-1", "BLK-0", LinkKind.ALLOCATE),
            ("ACT-1", "BLK-1", LinkKind.ALLOCATE),
            ("ACT-1", "UC-1", LinkKind.REFINE),
        ]
    )


def test_links_of_every_kind_that_an_element_can_state(detailed):
    detailed.edit("system.yaml", "    group: gripper\n", "    group: gripper\n    traces: [STK-1]\n")
    more = (detailed.folder / "system.yaml").read_text(encoding="utf-8").removeprefix("requirements:\n")
    detailed.append("system.yaml", more.replace("SYS-1", "SYS-2").replace("group:", "parent: SYS-1\n    group:"))
    detailed.edit("architecture.yaml", "refines: [UC-1]", "refines: [UC-1, STK-1, SYS-2]")
    links = [(link.source, link.target, link.kind) for link in detailed.load().links]
    assert links == [
        ("SYS-1", "STK-1", LinkKind.DERIVE),
        ("SYS-1", "STK-1", LinkKind.TRACE),
        ("BLK-1", "SYS-1", LinkKind.SATISFY),
        ("ACT-1", "SYS-1", LinkKind.SATISFY),
        ("SYS-2", "SYS-1", LinkKind.CONTAINMENT),
        ("SYS-2", "STK-1", LinkKind.DERIVE),
        ("SYS-2", "STK-1", LinkKind.TRACE),
        ("BLK-1", "SYS-2", LinkKind.SATISFY),
        ("ACT-1", "SYS-2", LinkKind.SATISFY),
        ("BLK-1", "BLK-0", LinkKind.CONTAINMENT),
        ("UC-1", "BLK-0", LinkKind.ALLOCATE),
        ("ACT-1", "BLK-1", LinkKind.ALLOCATE),
        ("ACT-1", "UC-1", LinkKind.REFINE),
        ("ACT-1", "STK-1", LinkKind.REFINE),
        ("ACT-1", "SYS-2", LinkKind.REFINE),
        ("SEQ-9", "SYS-1", LinkKind.TRACE),
    ]


def test_a_requirement_that_bounds_two_times_is_one_link(detailed):
    timing = "        - {first: lift, last: up, criterion_of: SYS-1, text: How long it takes.}\n"
    detailed.edit("architecture.yaml", timing, timing + timing.replace("last: up", "last: close"))
    links = [link for link in detailed.load().links if link.source == "SEQ-9"]
    assert links == [TraceLink(source="SEQ-9", target="SYS-1", kind=LinkKind.TRACE)]


def test_elements_are_found_by_their_ids(detailed):
    requirements = detailed.load()
    assert [element.id for element in requirements.elements] == list(requirements.places)
    for element in requirements.elements:
        assert requirements.element(element.id) is element


def test_what_is_replaced_is_found_as_it_is_now(project):
    """A set may be changed in code, as one that is built there."""
    requirements = project.load()
    changed = replace(requirements.system[0], owner="nobody")
    assert replace(requirements, system=(changed,)).element("SYS-1").owner == "nobody"


@pytest.mark.parametrize("ask", ["element", "content_digest"])
def test_an_unknown_element_is_refused_with_the_nearest(project, ask):
    with pytest.raises(
        DefinitionError, match=r"'BLK-2' is not an element of the requirements \(did you mean 'BLK-1'\?\)"
    ):
        getattr(project.load(), ask)("BLK-2")


def test_an_element_that_is_no_requirement_is_refused(project):
    with pytest.raises(DefinitionError, match="'ACT-1' is not a system requirement"):
        project.load().requirement("ACT-1")


def test_a_requirement_is_found_by_its_id(project):
    requirements = project.load()
    assert requirements.requirement("SYS-1") is requirements.system[0]


def test_an_unknown_requirement_is_refused_with_the_nearest(project):
    with pytest.raises(DefinitionError, match=r"'SYS-11' is not a system requirement \(did you mean 'SYS-1'\?\)"):
        project.load().requirement("SYS-11")


def test_a_finding_points_at_the_id_by_default(project):
    finding = project.load().finding("rule", "BLK-1", "message", hint="hint", severity=Severity.INFO)
    assert str(finding) == "requirements/architecture.yaml:3:10: info: message (hint) [rule]"


@pytest.mark.parametrize(
    ("at", "line", "column"),
    [
        (("criterion", "threshold"), 13, 74),
        (("satisfied_by", 1), 11, 27),
        (("text",), 4, 11),
        (("criterion", "x"), 13, 16),
    ],
)
def test_a_finding_points_at_a_part_of_the_element(project, at, line, column):
    finding = project.load().finding("rule", "SYS-1", "message", at=at)
    assert (finding.line, finding.column, finding.severity) == (line, column, Severity.ERROR)


def test_a_finding_at_nothing_is_refused(project):
    with pytest.raises(
        DefinitionError, match=r"'BLK-2' is not an element of the requirements \(did you mean 'BLK-1'\?\)"
    ):
        project.load().finding("rule", "BLK-2", "message")
