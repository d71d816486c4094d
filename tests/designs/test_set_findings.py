"""What parameters and properties of components set, and the mistakes in it."""

import pytest

FORCE = "name: force, symbol: F, unit: N, "
COUNT = "name: fingers, symbol: n, kind: count, "
NAME = "kind: name, role: planner, "
PROPERTIES = "properties: {force: N}"

MISTAKES = {
    "unknown quantity": (
        FORCE,
        FORCE + "sets: ¦gripper.finger.forc, ",
        "error: sets: unknown quantity 'gripper.finger.forc' (did you mean 'gripper.finger.force'?)",
    ),
    "wrong unit": (
        FORCE,
        FORCE + "sets: ¦robot.tool_speed, ",
        "error: d4 must be a quantity in 'm/s' to set robot.tool_speed, not in 'N' (correct the unit) [design.sets]",
    ),
    "wrong kind": (
        FORCE,
        FORCE + "sets: ¦gripper.fingers, ",
        "error: d4 must be a count to set gripper.fingers (write 'kind: count') [design.sets]",
    ),
    "a count for a quantity": (
        COUNT,
        COUNT + "sets: ¦gripper.finger.friction, ",
        "error: d2 must be a quantity to set gripper.finger.friction (write 'kind: quantity') [design.sets]",
    ),
    "unknown role": (
        FORCE,
        FORCE + "sets: ¦catalogue.grippr, ",
        "error: unknown role 'grippr' (did you mean 'gripper'?) [design.unknown-role]",
    ),
    "a number for a component": (
        FORCE,
        FORCE + "sets: ¦catalogue.gripper, ",
        "error: d4 must be a name to set catalogue.gripper (write 'kind: name'; its values are ids of components)",
    ),
    "another role": (
        NAME,
        NAME + "sets: ¦catalogue.gripper, ",
        "error: d3 has the role 'planner' and sets catalogue.gripper (remove 'role') [design.sets]",
    ),
    "negative": (
        "d4, " + FORCE,
        "d4, name: force, symbol: F, unit: s, sets: planning.simplification_limit, ",
        "error: d4 must be at least 0 s (0 s leaves paths as found) [design.negative]",
    ),
    "property that is not there": (
        PROPERTIES,
        PROPERTIES + "\n    sets: {¦forc: gripper.finger.force}",
        "error: a gripper has no property 'forc' (did you mean 'force'?) [design.unknown-property]",
    ),
    "property of another unit": (
        PROPERTIES,
        PROPERTIES + "\n    sets: {force: ¦gripper.finger.mass}",
        "error: property 'force' must be a quantity in 'kg' to set gripper.finger.mass, not in 'N' (correct the unit)",
    ),
    "property that chooses": (
        PROPERTIES,
        PROPERTIES + "\n    sets: {force: ¦catalogue.planner}",
        "error: property 'force' cannot select a component (use a parameter instead) [design.sets]",
    ),
}


@pytest.mark.parametrize(("old", "new", "expected"), MISTAKES.values(), ids=MISTAKES)
def test_mistakes(project, old, new, expected):
    project.change(old, new)
    if "planning.simplification_limit" in new:
        project.change("d4: 3 N", "d4: ¦-1 s")
    (mark,) = project.marks()
    assert any(finding.startswith(f"{mark}: {expected}") for finding in project.findings()), project.findings()


def test_two_parameters_that_set_the_same_quantity(project):
    project.change("name: mass, symbol: m, unit: kg, ", "name: mass, symbol: m, unit: N, sets: gripper.finger.force, ")
    project.change(FORCE, FORCE + "sets: ¦gripper.finger.force, ")
    (mark,) = project.marks()
    expected = "error: gripper.finger.force is already set by d1 in line 2 (set it in one place) [design.set-twice]"
    assert f"{mark}: {expected}" in project.findings()


def test_a_parameter_and_a_property_that_set_the_same_quantity(project):
    project.change(PROPERTIES, PROPERTIES + "\n    sets: {force: gripper.finger.force}")
    project.change(FORCE, FORCE + "sets: ¦gripper.finger.force, ")
    (mark,) = project.marks()
    assert project.findings() == [
        (
            f"{mark}: error: gripper.finger.force is already set by property 'force' of role 'gripper' "
            "in catalogue.yaml:5 (set it in one place) [design.set-twice]"
        )
    ]


def test_two_properties_that_set_the_same_quantity(project):
    project.change(PROPERTIES, "properties: {force: N, grip: N}\n    sets: {force: gripper.finger.force, ¦grip: X}")
    project.catalogue_text = project.catalogue_text.replace("¦grip: X", "grip: ¦gripper.finger.force")
    project.catalogue_text = project.catalogue_text.replace(
        "    properties:\n", "    properties:\n      grip: {value: 1 N, source: A datasheet}\n"
    )
    (mark,) = project.marks()
    assert project.findings() == [
        (
            f"{mark}: error: gripper.finger.force is already set by property 'force' of role 'gripper' in line 5 "
            "(set it in one place) [design.set-twice]"
        )
    ]


def test_a_property_that_is_not_a_whole_number(project):
    project.change(PROPERTIES, 'properties: {force: "1"}\n    sets: {force: gripper.fingers}')
    project.change("value: 5 N", "value: ¦2.5")
    project.change("value: 0.01 kN", "value: 3")
    (mark,) = project.marks()
    assert project.findings() == [
        (
            f"{mark}: error: force sets gripper.fingers and must be a whole number, got 2.5 "
            "(write a count, such as 2) [design.value]"
        )
    ]


def test_a_parameter_that_chooses_components_by_their_ids(project):
    project.change("    matches: {d1: 100 g}\n", "").change("    matches: {d1: [200 g, 0.3 kg]}\n", "")
    project.change("parameters:\n", "parameters:\n  - {id: hand, name: hand, symbol: h, kind: name, sets: ¦X}\n")
    project.space_text = project.space_text.replace("sets: ¦X}", "sets: catalogue.gripper, description: Hand.}")
    project.change("factors:\n", "factors:\n  - {id: hand, name: Hand, levels: [{id: a, sets: {hand: ¦X}}]}\n")
    project.space_text = project.space_text.replace("{hand: ¦X}}]", "{hand: small}}, {id: b, sets: {hand: large}}]")
    chosen = [variant.components["gripper"].id for variant in project.load().expand()]
    assert chosen == ["small"] * 8 + ["large"] * 8

    project.space_text = project.space_text.replace("{hand: large}", "{hand: ¦larg}")
    (mark,) = project.marks()
    expected = "error: hand: no gripper component is named 'larg' (did you mean 'large'?) [design.unknown-name]"
    assert f"{mark}: {expected}" in project.findings()
