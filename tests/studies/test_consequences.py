"""One mistake, one line: what only follows from another is told when that is mended."""

from __future__ import annotations

import re

import pytest

from rgss.findings import Finding, Severity
from rgss.studies.finding_suppression import without_consequences

SCENE, SPACE, CATALOGUE = "scenes/restaurant.yaml", "designs/grasping_system.yaml", "designs/catalogue.yaml"
MEASURES, STAKEHOLDER = "requirements/measures.yaml", "requirements/stakeholder.yaml"
SYSTEM, STRUCTURE = "requirements/system/1-manipulator.yaml", "requirements/architecture/structure.yaml"

FACTORS = ("gripper_mass", "fingers", "velocity", "planner", "planning_time")

DUPLICATES = [
    (SCENE, "id: counter_pick", "id: counter_place", "scene.duplicate-id"),
    (SCENE, "id: shelf", "id: column", "scene.duplicate-id"),
    (SPACE, "- id: d2", "- id: d1", "design.duplicate-id"),
    (SPACE, "- id: velocity", "- id: fingers", "design.duplicate-id"),
    (SPACE, "- id: medium", "- id: short", "design.duplicate-id"),
    (CATALOGUE, "- id: gripper\n", "- id: manipulator\n", "design.duplicate-id"),
    (MEASURES, "- id: k_s", "- id: g", "measures.duplicate-id"),
    (MEASURES, "{id: M_f,", "{id: N_f,", "measures.duplicate-id"),
    (MEASURES, "- id: C_total", "- id: P_max", "measures.duplicate-id"),
    (MEASURES, "- id: t_gc_simulated", "- id: t_gc", "measures.duplicate-id"),
    (SYSTEM, "id: SYS-002", "id: SYS-001", "requirements.duplicate-id"),
    (STAKEHOLDER, "id: STK-010", "id: STK-006", "requirements.duplicate-id"),
    (STRUCTURE, "id: BLK-rrt", "id: BLK-trrt", "requirements.duplicate-id"),
]


@pytest.mark.verifies("SYS-027")
@pytest.mark.parametrize(("file", "old", "new", "rule"), DUPLICATES)
def test_an_id_that_is_taken_hides_those_who_miss_the_right_one(edit, problems, file, old, new, rule):
    edit(file, old, new)

    (problem,) = problems()
    assert problem.startswith(f"{file}:")
    assert problem.endswith(f"[{rule}]")


@pytest.mark.verifies("SYS-027")
@pytest.mark.parametrize("factor", FACTORS)
def test_a_factor_without_levels(folder, problems, place_of, factor):
    text = (folder / SPACE).read_text(encoding="utf-8")
    emptied = re.sub(rf"(- id: {factor}\n    name: .*\n)    levels:\n(      .*\n)+", r"\1    levels: []\n", text)
    assert emptied != text
    (folder / SPACE).write_text(emptied, encoding="utf-8")

    (problem,) = problems()
    assert problem.startswith(f"{place_of(SPACE, '[]')}: error: factor {factor!r} has no levels (add a level")


@pytest.mark.verifies("SYS-027")
@pytest.mark.parametrize(
    ("file", "old", "new", "expected"),
    [
        (SCENE, "gravity:", "gravty:", "unknown key 'gravty' (did you mean 'gravity'?)"),
        (SPACE, "levels:", "level:", "unknown key 'level' (did you mean 'levels'?)"),
        (SPACE, "sets: {d7: 0.5", "set: {d7: 0.5", "unknown key 'set' (did you mean 'sets'?)"),
        ("studies/pick_place.yaml", "replicates:", "replicats:", "unknown key 'replicats' (did you mean 'replicates'"),
        (SYSTEM, "group:", "grup:", "unknown key 'grup' (did you mean 'group'?)"),
    ],
)
def test_a_misspelt_key_is_not_missing_too(edit, problems, place_of, file, old, new, expected):
    edit(file, old, new)

    (problem,) = problems()
    assert problem.startswith(f"{place_of(file, new)}: error: {expected}")


def finding(rule, line=1):
    return Finding(file="a.yaml", line=line, column=1, rule=rule, severity=Severity.ERROR, message="x")


def test_findings_are_kept_once_and_in_order():
    one, other = finding("scene.shape", 2), finding("document.value", 1)

    assert without_consequences([one, other, one]) == (other, one)


def test_a_consequence_is_kept_where_its_cause_is_not():
    dangling, duplicate = finding("requirements.dangling-id"), finding("requirements.duplicate-id", 2)

    assert without_consequences([dangling]) == (dangling,)
    assert without_consequences([dangling, duplicate]) == (duplicate,)
    assert without_consequences([dangling, finding("scene.duplicate-id", 2)])[0] == dangling
