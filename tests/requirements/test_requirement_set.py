"""What a set of requirements answers."""

from __future__ import annotations

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


def test_a_requirement_is_found_by_its_id(project):
    requirements = project.load()
    assert requirements.requirement("SYS-1") is requirements.system[0]


def test_an_unknown_requirement_is_refused_with_the_nearest(project):
    with pytest.raises(DefinitionError, match=r"'SYS-11' is no system requirement \(did you mean 'SYS-1'\?\)"):
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
    with pytest.raises(DefinitionError, match=r"'BLK-2' is no element of the requirements \(did you mean 'BLK-1'\?\)"):
        project.load().finding("rule", "BLK-2", "message")
