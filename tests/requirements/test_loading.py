"""Needs, requirements and architecture: what comes out of sound files, and what is said about broken ones."""

from __future__ import annotations

import pytest

from rgss.errors import DocumentError
from rgss.requirements import (
    Behaviour,
    BehaviourKind,
    Block,
    BlockLevel,
    BlockRelation,
    Comparison,
    Criterion,
    NeedKind,
    Priority,
    RequirementGroup,
    Statistic,
    Status,
    VerificationMethod,
    VerificationPhase,
    load_requirements,
)


def test_a_need_as_it_is_written(project):
    (need,) = project.load().stakeholder
    assert (need.id, need.kind, need.text) == ("STK-1", NeedKind.FUNCTIONAL, "The system shall lift cups.")
    assert (need.rationale, need.source, need.owner) == ("Cups wait to be lifted.", "interview", "cook")
    assert (need.priority, need.status) == (Priority.HIGH, Status.APPROVED)


def test_a_requirement_as_it_is_written(project):
    (requirement,) = project.load().system
    assert (requirement.id, requirement.group) == ("SYS-1", RequirementGroup.GRIPPER)
    assert (requirement.derived_from, requirement.satisfied_by) == (("STK-1",), ("BLK-1", "ACT-1"))
    assert (requirement.priority, requirement.status) == (Priority.MEDIUM, Status.DRAFT)
    assert requirement.verification is VerificationMethod.ANALYSIS
    assert requirement.criterion_exemption is None
    assert (requirement.parent, requirement.traces, requirement.success) == (None, (), None)
    assert (requirement.facility, requirement.phase, requirement.exempt) == (None, None, ())
    assert requirement.criterion == Criterion(
        measure="P", statistic=Statistic.LOW, comparison=Comparison.AT_LEAST, threshold=800.0, unit="g"
    )


def test_where_and_when_and_how_a_requirement_is_shown_to_be_met(project):
    project.edit(
        "system.yaml",
        "    verification: analysis\n",
        "    verification: test\n    facility: Bench\n    phase: acceptance\n",
    )
    criterion = '    criterion: {measure: P, statistic: low, comparison: ">=", threshold: "800 g"}\n'
    project.edit("system.yaml", criterion, "    success: It lifts a cup.\n")
    (requirement,) = project.load().system
    assert (requirement.facility, requirement.phase) == ("Bench", VerificationPhase.ACCEPTANCE)
    assert (requirement.success, requirement.criterion) == ("It lifts a cup.", None)


def test_needs_and_requirements_may_be_contained_and_trace(project):
    need = (project.folder / "stakeholder.yaml").read_text(encoding="utf-8").removeprefix("requirements:\n")
    project.append("stakeholder.yaml", need.replace("STK-1", "STK-2").replace("kind:", "parent: STK-1\n    kind:"))
    requirement = (project.folder / "system.yaml").read_text(encoding="utf-8").removeprefix("requirements:\n")
    inner = requirement.replace("SYS-1", "SYS-2").replace("group:", "parent: SYS-1\n    group:")
    project.append("system.yaml", inner + "    traces: [STK-2, SYS-1]\n")
    requirements = project.load()
    assert [need.parent for need in requirements.stakeholder] == [None, "STK-1"]
    assert [item.parent for item in requirements.system] == [None, "SYS-1"]
    assert requirements.element("SYS-2").traces == ("STK-2", "SYS-1")


def test_the_architecture_as_it_is_written(project):
    architecture = project.load().architecture
    assert architecture.blocks[0].parent is None
    assert architecture.blocks[0].relation is BlockRelation.PART
    assert architecture.blocks[1] == Block(
        id="BLK-1",
        name="Gripper",
        level=BlockLevel.SUBSYSTEM,
        parent="BLK-0",
        relation=BlockRelation.KIND,
        text="A part.",
    )
    assert architecture.behaviours[1] == Behaviour(
        id="ACT-1",
        name="Lift",
        kind=BehaviourKind.ACTIVITY,
        allocated_to=("BLK-1",),
        refines=("UC-1",),
        includes=("ACT-2",),
        text="Lifts.",
    )
    assert [element.id for element in architecture.elements] == ["BLK-0", "BLK-1", "UC-1", "ACT-1", "ACT-2"]


def test_what_is_open_in_a_requirement_may_be_left_out(project):
    project.edit("system.yaml", "    derived_from: [STK-1]\n", "")
    project.edit("system.yaml", "    satisfied_by: [BLK-1, ACT-1]\n", "")
    project.edit("system.yaml", "    verification: analysis\n", "")
    project.edit(
        "system.yaml",
        '    criterion: {measure: P, statistic: low, comparison: ">=", threshold: "800 g"}\n',
        "    criterion_exemption: Shown by a drawing.\n",
    )
    (requirement,) = project.load().system
    assert (requirement.derived_from, requirement.satisfied_by) == ((), ())
    assert requirement.verification is None
    assert requirement.criterion is None
    assert requirement.criterion_exemption == "Shown by a drawing."


@pytest.mark.parametrize(
    ("written", "threshold", "unit"),
    [
        ('"0.8 kg"', 0.8, "kg"),
        ("0.9", 0.9, "1"),
        ("2", 2.0, "1"),
        ('"0.9"', 0.9, "1"),
        ('"90 %"', 90.0, "%"),
        ('"6e4 USD"', 60000.0, "USD"),
        ('"1.5 m/s**2"', 1.5, "m/s**2"),
    ],
)
def test_thresholds_keep_the_unit_that_they_are_written_in(project, written, threshold, unit):
    criterion = project.edit("system.yaml", '"800 g"', written).load().system[0].criterion
    assert (criterion.threshold, criterion.unit) == (threshold, unit)


def test_the_statistic_of_a_criterion_is_the_value_unless_stated(project):
    criterion = project.edit("system.yaml", "statistic: low, ", "").load().system[0].criterion
    assert criterion.statistic is Statistic.VALUE


@pytest.mark.verifies("SYS-027")
@pytest.mark.parametrize(
    ("name", "old", "new", "start_of", "said"),
    [
        (
            "stakeholder.yaml",
            "kind: functional",
            "kind: nice",
            "nice",
            "kind: 'nice' is not one of 'design', 'functional', 'interface' or 'performance' [document.value]",
        ),
        (
            "stakeholder.yaml",
            "    source: interview\n",
            "",
            "id: STK-1",
            "key 'source' is missing (add 'source') [document.missing-key]",
        ),
        (
            "system.yaml",
            "owner: engineer",
            "owner: engineer\n    owners: engineer",
            "owners",
            "unknown key 'owners' (did you mean 'owner'?) [document.unknown-key]",
        ),
        (
            "system.yaml",
            '"800 g"',
            '"800 bananas"',
            '"800',
            "threshold: unknown unit 'bananas' (use units such as mm, kg, s, N, deg, USD) [document.value]",
        ),
        (
            "system.yaml",
            '"800 g"',
            "heavy",
            "heavy",
            "threshold: 'heavy' has no number (write a number and a unit, such as \"1 kg\") [document.value]",
        ),
        ("system.yaml", '"800 g"', "true", "true", "threshold: a text is expected [document.value]"),
        (
            "system.yaml",
            '">="',
            '"="',
            '"="',
            "comparison: '=' is not one of '>=', '<=', '>' or '<' [document.value]",
        ),
        (
            "system.yaml",
            "    verification: analysis\n",
            "    verification: analysis\n    criterion_exemption: None needed.\n",
            "id: SYS-1",
            "requirements: a criterion and an exemption from it exclude each other [document.value]",
        ),
        (
            "system.yaml",
            "    verification: analysis\n",
            "    verification: analysis\n    success: It lifts.\n",
            "id: SYS-1",
            "requirements: a criterion and a success criterion in words exclude each other [document.value]",
        ),
        (
            "system.yaml",
            "    verification: analysis\n",
            "    verification: analysis\n    phase: later\n",
            "later",
            "phase: 'later' is not one of 'development', 'qualification', 'acceptance' or 'operation' [document.value]",
        ),
        (
            "architecture.yaml",
            "level: system",
            "level: galaxy",
            "galaxy",
            "level: 'galaxy' is not one of 'context', 'system', 'subsystem' or 'element' [document.value]",
        ),
        (
            "architecture.yaml",
            "{id: BLK-0,",
            "{id: 0-BLK,",
            "0-BLK",
            "id: '0-BLK' is not an identifier (a letter, then letters, digits, '_', '.', '-') [document.value]",
        ),
    ],
)
def test_a_malformed_value_is_refused_with_its_position(project, name, old, new, start_of, said):
    project.edit(name, old, new)
    assert project.findings() == [f"{project.position(name, start_of)}: error: {said}"]


@pytest.mark.parametrize("name", ["stakeholder.yaml", "system.yaml"])
def test_a_file_without_requirements_is_refused(project, name):
    (project.folder / name).write_text("requirements: []\n", encoding="utf-8")
    assert project.findings() == [
        f"requirements/{name}:1:15: error: requirements: at least 1 entry is expected [document.value]"
    ]


def test_a_missing_folder_gives_a_finding_for_each_file(tmp_path):
    with pytest.raises(DocumentError) as caught:
        load_requirements(tmp_path / "nowhere", label_root="needs")
    assert [(finding.file, finding.rule) for finding in caught.value.findings] == [
        ("needs/architecture.yaml", "document.missing"),
        ("needs/stakeholder.yaml", "document.missing"),
        ("needs/system.yaml", "document.missing"),
    ]


def test_problems_of_all_files_are_reported_at_once(project):
    project.edit("stakeholder.yaml", "kind: functional", "kind: nice")
    project.edit("system.yaml", "group: gripper", "group: hand")
    project.edit("architecture.yaml", "parent: BLK-0", "parent: BLK-9")
    assert [finding.split(" error: ")[0] for finding in project.findings()] == [
        f"{project.position('architecture.yaml', 'BLK-9')}:",
        f"{project.position('stakeholder.yaml', 'nice')}:",
        f"{project.position('system.yaml', 'hand')}:",
    ]


def test_references_into_a_file_that_cannot_be_read_are_left_alone(project):
    project.edit("architecture.yaml", "level: system", "level: galaxy")
    assert [finding.rsplit(" ", 1)[1] for finding in project.findings()] == ["[document.value]"]
