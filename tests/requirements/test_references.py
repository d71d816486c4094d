"""Ids across all files."""

from __future__ import annotations

import pytest

DUPLICATE = "(use a unique id) [duplicate-id]"
ANOTHER = """\
  - id: SYS-2
    group: gripper
    text: The gripper shall open.
    rationale: A closed one holds on.
    source: catalogue
    priority: low
    status: draft
    owner: engineer
    derived_from: [SYS-1]
"""


@pytest.mark.parametrize(
    ("name", "old", "new", "start_of", "said"),
    [
        (
            "system.yaml",
            "id: SYS-1",
            "id: STK-1",
            "STK-1\n",
            "id 'STK-1' is already declared at requirements/stakeholder.yaml:2:9 " + DUPLICATE,
        ),
        (
            "architecture.yaml",
            "behaviours:",
            "  - {id: BLK-0, name: Again, level: system, text: Again.}\nbehaviours:",
            "BLK-0, name: Again",
            "id 'BLK-0' is already declared at requirements/architecture.yaml:2:10 " + DUPLICATE,
        ),
        (
            "system.yaml",
            "[STK-1]",
            "[STK-1, STK-2]",
            "STK-2",
            "derived_from: 'STK-2' is not declared (did you mean 'STK-1'?) [dangling-id]",
        ),
        (
            "system.yaml",
            "[BLK-1, ACT-1]",
            "[Wheel]",
            "Wheel",
            "satisfied_by: 'Wheel' is not declared [dangling-id]",
        ),
        (
            "architecture.yaml",
            "includes: [ACT-2]",
            "includes: [ACT-22]",
            "ACT-22",
            "includes: 'ACT-22' is not declared (did you mean 'ACT-2'?) [dangling-id]",
        ),
        (
            "system.yaml",
            "[STK-1]",
            "[BLK-0]",
            "BLK-0",
            "derived_from: 'BLK-0' is a block, not a stakeholder requirement or system requirement [wrong-kind]",
        ),
        (
            "system.yaml",
            "[BLK-1, ACT-1]",
            "[BLK-1, STK-1]",
            "STK-1]\n    verification",
            "satisfied_by: 'STK-1' is a stakeholder requirement, not a block or behaviour [wrong-kind]",
        ),
        (
            "architecture.yaml",
            "allocated_to: [BLK-1]",
            "allocated_to: [UC-1]",
            "UC-1], refines",
            "allocated_to: 'UC-1' is a behaviour, not a block [wrong-kind]",
        ),
        (
            "system.yaml",
            "[BLK-1, ACT-1]",
            "[ACT-1, ACT-1]",
            "ACT-1]",
            "satisfied_by: 'ACT-1' is named twice (keep one) [repeated-id]",
        ),
        (
            "stakeholder.yaml",
            "kind: functional",
            "parent: STK-9\n    kind: functional",
            "STK-9",
            "parent: 'STK-9' is not declared (did you mean 'STK-1'?) [dangling-id]",
        ),
        (
            "stakeholder.yaml",
            "kind: functional",
            "parent: STK-1\n    kind: functional",
            "STK-1\n    kind",
            "'STK-1' depends on itself: STK-1 → STK-1 (cut it) [cycle]",
        ),
        (
            "stakeholder.yaml",
            "kind: functional",
            "parent: SYS-1\n    kind: functional",
            "SYS-1",
            "parent: 'SYS-1' is a system requirement, not a stakeholder requirement [wrong-kind]",
        ),
        (
            "system.yaml",
            "group: gripper",
            "parent: STK-1\n    group: gripper",
            "STK-1\n    group",
            "parent: 'STK-1' is a stakeholder requirement, not a system requirement [wrong-kind]",
        ),
        (
            "system.yaml",
            "group: gripper",
            "traces: [BLK-1]\n    group: gripper",
            "BLK-1]\n    group",
            "traces: 'BLK-1' is a block, not a stakeholder requirement or system requirement [wrong-kind]",
        ),
        (
            "system.yaml",
            "group: gripper",
            "traces: [SYS-1]\n    group: gripper",
            "SYS-1]\n    group",
            "'SYS-1' depends on itself: SYS-1 → SYS-1 (cut it) [cycle]",
        ),
        (
            "architecture.yaml",
            "refines: [UC-1]",
            "refines: [UC-1, BLK-1]",
            "BLK-1], includes",
            "refines: 'BLK-1' is a block, not a behaviour, stakeholder requirement or system requirement [wrong-kind]",
        ),
        (
            "architecture.yaml",
            "kind: use_case,",
            "kind: use_case, actors: [STK-1],",
            "STK-1], alloc",
            "actors: 'STK-1' is a stakeholder requirement, not a block [wrong-kind]",
        ),
        (
            "system.yaml",
            "[STK-1]",
            "[STK-1, SYS-1]",
            "SYS-1]",
            "'SYS-1' depends on itself: SYS-1 → SYS-1 (cut it) [cycle]",
        ),
        (
            "architecture.yaml",
            "{id: BLK-0,",
            "{id: BLK-0, parent: BLK-1,",
            "BLK-0, relation",
            "'BLK-1' depends on itself: BLK-1 → BLK-0 → BLK-1 (cut it) [cycle]",
        ),
        (
            "architecture.yaml",
            "kind: use_case,",
            "kind: use_case, refines: [ACT-1],",
            "UC-1], includes",
            "'ACT-1' depends on itself: ACT-1 → UC-1 → ACT-1 (cut it) [cycle]",
        ),
    ],
)
def test_a_wrong_id_is_reported_at_its_place(project, name, old, new, start_of, said):
    project.edit(name, old, new)
    expected = f"{project.position(name, start_of)}: error: {said}"
    assert [finding.replace("[requirements.", "[") for finding in project.findings()] == [expected]


def test_a_requirement_may_derive_from_another(project):
    requirements = project.append("system.yaml", ANOTHER).load()
    assert requirements.requirement("SYS-2").derived_from == ("SYS-1",)


def test_each_cycle_is_reported_once_and_what_hangs_on_it_is_not(project):
    project.append("system.yaml", ANOTHER).append("system.yaml", ANOTHER.replace("SYS-2", "SYS-3"))
    project.edit("system.yaml", "derived_from: [STK-1]", "derived_from: [STK-1, SYS-2]")
    (finding,) = project.findings()
    assert finding.startswith("requirements/system.yaml:22:20: error: 'SYS-2' depends on itself: SYS-2 → SYS-1 → SYS-2")


def test_behaviours_may_include_one_another(project):
    """Inclusion is no order: what a retry includes may include the retry."""
    project.edit("architecture.yaml", "kind: activity, text: Closes.", "kind: activity, includes: [ACT-1], text: C.")
    assert project.load().architecture.behaviours[2].includes == ("ACT-1",)


def test_a_long_chain_of_parents_is_no_problem(project):
    chain = "".join(f"  - {{id: B{n}, name: n, level: element, parent: B{n + 1}, text: t}}\n" for n in range(1500))
    text = "blocks:\n  - {id: BLK-1, name: n, level: element, parent: B0, text: t}\n" + chain
    (project.folder / "architecture.yaml").write_text(
        f"{text}  - {{id: B1500, name: n, level: element, text: t}}\n", encoding="utf-8"
    )
    project.edit("system.yaml", ", ACT-1]", "]")
    assert len(project.load().architecture.blocks) == 1502


def test_behaviours_refine_needs_and_requirements(project):
    project.edit("architecture.yaml", "refines: [UC-1]", "refines: [UC-1, STK-1, SYS-1]")
    assert project.load().element("ACT-1").refines == ("UC-1", "STK-1", "SYS-1")


def test_the_middle_of_a_long_cycle_is_left_out_of_the_message(project):
    names = [f"B{n}" for n in range(100)]
    blocks = [
        f"  - {{id: {name}, name: n, level: element, parent: {parent}, text: t}}\n"
        for name, parent in zip(names, [*names[1:], "B0"], strict=True)
    ]
    project.edit("architecture.yaml", "behaviours:\n", f"{''.join(blocks)}behaviours:\n")
    (finding,) = project.findings()
    chain = "B99 → B0 → … → B94 → B95 → B96 → B97 → B98 → B99"
    assert f"error: 'B99' depends on itself: {chain} (cut it) [requirements.cycle]" in finding


def test_thousands_of_wrong_ids_are_not_compared_with_as_many(project):
    """The first have a hint; to give each one would take hours."""
    size = 2_000
    targets = ", ".join(f"STK-{n}" for n in range(2, size))
    project.edit("system.yaml", "[STK-1]", f"[{targets}]")
    entry = (project.folder / "architecture.yaml").read_text(encoding="utf-8").splitlines()[1]
    blocks = "".join(entry.replace("BLK-0", f"STK--{n}") + "\n" for n in range(size))
    project.edit("architecture.yaml", "behaviours:\n", f"{blocks}behaviours:\n")
    project.edit("system.yaml", "satisfied_by: [BLK-1, ACT-1]", f"satisfied_by: [{targets}]")
    findings = project.findings()
    assert len(findings) == 2 * (size - 2)
    hinted = sum("did you mean" in finding for finding in findings)
    assert size - 2 < hinted < size + 60
