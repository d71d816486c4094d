"""What the task needs of the designs, found wrong before anything is simulated."""

from __future__ import annotations

import re

import pytest

from rgss.motion import SOURCE_PLANNERS, available_planners
from rgss.scenes import load_gripper_file, motion_of, pad_limits
from rgss.studies.project import load_project
from tests.trials.hands.gripper_files import FILES, TWO_FINGER

SPACE, CATALOGUE = "designs/grasping_system.yaml", "designs/catalogue.yaml"

VALUES = [
    ("d4: 0.04 m/s", "d4: 0 m/s", "0 m/s", "error: d4 must be greater than zero [design.not-positive]"),
    ("d5: 10 N", "d5: 0 N", "0 N\n  d6", "error: d5 must be greater than zero [design.not-positive]"),
    ("d6: 0.7", "d6: -0.7", "-0.7", "error: d6 must be greater than zero [design.not-positive]"),
    ("{d7: 0.5 m/s}", "{d7: 0 m/s}", "0 m/s}", "error: d7 must be greater than zero [design.not-positive]"),
    (
        "{d7: 0.5 m/s}",
        "{d7: 1e-9 m/s}",
        "1e-9 m/s}",
        "error: d7 must be at least 1 mm/s (a slower arm or hand would take hours for the task) [design.too-slow]",
    ),
    ("d4: 0.04 m/s", "d4: 0.9 mm/s", "0.9 mm/s", "error: d4 must be at least 1 mm/s (a slower arm or hand would take"),
    ("{d9: 4 s}", "{d9: -4 s}", "-4 s}", "error: d9 must be greater than zero [design.not-positive]"),
    (
        "{d8: TRRT}",
        "{d8: PRM}",
        "PRM",
        "error: d8: no planner component is named 'PRM' (known planner names: RRT, STRIDE, TRRT)",
    ),
]


@pytest.mark.verifies("SYS-027")
@pytest.mark.parametrize(("old", "new", "at", "expected"), VALUES)
def test_values(edit, problems, place_of, old, new, at, expected):
    edit(SPACE, old, new)

    (problem,) = problems()
    assert problem.startswith(f"{place_of(SPACE, at)}: {expected}")


@pytest.mark.verifies("SYS-031")
def test_a_planner_that_only_the_catalogue_knows(edit, problems, place_of):
    edit(SPACE, "sets: {d8: TRRT}", "sets: {d8: RRTconect}")
    edit(CATALOGUE, "matches: {d8: TRRT}", "matches: {d8: RRTconect}")

    (problem,) = problems()
    assert problem == (
        f"{place_of(SPACE, 'RRTconect')}: error: unknown planner 'RRTconect' "
        f"(did you mean 'RRTConnect'? planners: {', '.join(available_planners())}) [design.planner]"
    )


def test_a_planner_of_ompl_that_cannot_be_run(edit, problems, place_of):
    edit(SPACE, "sets: {d8: TRRT}", "sets: {d8: SPARS}")
    edit(CATALOGUE, "matches: {d8: TRRT}", "matches: {d8: SPARS}")

    (problem,) = problems()
    assert problem.startswith(
        f"{place_of(SPACE, 'SPARS')}: error: planner SPARS cannot be run: "
        "it looks for a solution in a second thread, by a wall clock (planners: "
    )


def test_a_quantity_that_nothing_sets(edit, problems, place_of):
    edit(SPACE, "    sets: planning.time_limit\n", "")

    assert problems() == [
        (
            f"{place_of(SPACE, '- id: d1')}: error: nothing sets planning.time_limit "
            "(add 'sets: planning.time_limit' to a parameter, or planning.time_limit in the study) "
            "[design.unset-quantity]"
        )
    ]


def test_a_quantity_that_some_gripper_files_lack(edit, problems, place_of):
    edit(SPACE, "    sets: gripper.finger.force\n", "")
    edit("scenes/grippers/kg-3.yaml", "length: 90 mm", "length: 90 mm, force: 10 N")

    (problem,) = problems()
    assert problem.startswith(
        f"{place_of(SPACE, '- id: d1')}: error: nothing sets gripper.finger.force of scenes/grippers/kg-2.yaml (add"
    )


def test_a_parameter_of_another_unit(edit, problems, place_of):
    edit(SPACE, "    unit: s\n", "    unit: m\n")
    for time in ("4", "6", "8"):
        edit(SPACE, f"d9: {time} s", f"d9: {time} m")

    (problem,) = problems()
    assert problem == (
        f"{place_of(SPACE, 'planning.time_limit')}: error: d9 must be a quantity in 's' to set planning.time_limit, "
        "not in 'm' (correct the unit) [design.sets]"
    )


def test_a_planner_that_is_a_number(edit, problems, place_of):
    edit(SPACE, "    kind: name\n    role: planner\n", '    unit: "1"\n')
    for number, planner in enumerate(SOURCE_PLANNERS):
        edit(SPACE, f"d8: {planner}", f"d8: {number}")
        edit(CATALOGUE, f"d8: {planner}", f"d8: {number}")

    assert problems()[0] == (
        f"{place_of(SPACE, 'planning.planner')}: error: d8 must be a name to set planning.planner "
        "(write 'kind: name') [design.sets]"
    )


def test_the_role_of_grippers_is_needed(folder, problems, place_of):
    for file, old, new in ((CATALOGUE, ": gripper\n", ": hand\n"), (SPACE, "component.gripper.", "component.hand.")):
        text = (folder / file).read_text(encoding="utf-8")
        (folder / file).write_text(text.replace(old, new), encoding="utf-8")
    measures = folder / "requirements/measures.yaml"
    text = measures.read_text(encoding="utf-8")
    measures.write_text(text.replace("component.gripper.", "component.hand."), encoding="utf-8")

    (problem,) = problems()
    assert problem.startswith(
        f"{place_of(CATALOGUE, '- id: manipulator')}: error: the task needs components of the role 'gripper' (roles: "
    )


def test_a_gripper_without_a_shape(folder, edit, problems):
    edit(CATALOGUE, "    geometry: scenes/grippers/kg-3.yaml\n", "")

    (problem,) = problems()
    assert re.match(rf"{CATALOGUE}:\d+:5: error: gripper '.*' has no geometry \(name the file", problem)


def test_a_gripper_with_the_shape_of_another(edit, problems):
    edit(CATALOGUE, "geometry: scenes/grippers/kg-3.yaml", "geometry: scenes/grippers/kg-2.yaml")

    (problem,) = problems()
    assert re.match(
        rf"{CATALOGUE}:\d+:15: error: '.*' is for d1 = 3, its shape has 2 fingers \(name the file of another", problem
    )


@pytest.fixture
def cranks(folder):
    """The shipped project with a linkage as its hand of two fingers, whose driven joint has a limited effort."""
    (folder / "scenes/grippers/kg-2.yaml").write_text(FILES["linkage"], encoding="utf-8")
    urdf = TWO_FINGER.read_text(encoding="utf-8")
    # An effort of which each pad has some 10 N, which the rules of the design space allow.
    (folder / "scenes/grippers" / TWO_FINGER.name).write_text(
        re.sub('effort="[0-9.]+"', 'effort="1.2"', urdf), encoding="utf-8"
    )
    return pad_limits(motion_of(load_gripper_file(folder / "scenes/grippers/kg-2.yaml").geometry.linkage))


@pytest.mark.parametrize(
    ("written", "quantity", "limit"),
    [("d5: 10 N", "gripper.finger.force", 0), ("d4: 0.04 m/s", "gripper.finger.speed", 1)],
)
def test_more_than_the_joint_of_a_linkage_gives(folder, cranks, edit, problems, place_of, written, quantity, limit):
    """The hand of three fingers is no linkage, and has no such limit."""
    name, unit = written.split()[0], written.split()[-1]
    most = cranks[limit]
    edit(SPACE, written, f"{name} {most:.9g} {unit}")
    load_project(folder)
    edit(SPACE, f"{name} {most:.9g} {unit}", f"{name} {1.01 * most:.4g} {unit}")

    (problem,) = problems()
    assert problem.startswith(f"{place_of(SPACE, f'{1.01 * most:.4g} {unit}')}: error: variant ")
    assert f": {quantity} is {1.01 * most:.4g} {unit}, but the driven joint of scenes/grippers/kg-2.yaml" in problem
    assert f"gives each pad {most:.4g} {unit} at most (lower it" in problem


def test_a_number_of_fingers_that_no_gripper_file_has(folder, edit, problems, place_of):
    """Components that are not matched by the number, as in a project with one gripper."""
    text = (folder / CATALOGUE).read_text(encoding="utf-8")
    blocks = text.split("\n  - id: ")
    text = "\n  - id: ".join(block for block in blocks if not block.startswith("kg-2"))
    (folder / CATALOGUE).write_text(text.replace("matches: {d1: 3, ", "matches: {"), encoding="utf-8")

    (problem,) = problems()
    assert re.fullmatch(
        re.escape(f"{place_of(SPACE, '2}')}: error: variant ")
        + r"\d+: gripper\.fingers is 2, but scenes/grippers/kg-3\.yaml has 3 fingers "
        r"\(set it to 3, or take a gripper of 2 fingers\) \[design\.fingers\]",
        problem,
    )
