"""Bad input: one line with a position, exit status 2, and nothing is simulated."""

from __future__ import annotations

import re

import pytest

SCENE, STUDY = "scenes/restaurant.yaml", "studies/pick_place.yaml"
SPACE, CATALOGUE = "designs/grasping_system.yaml", "designs/catalogue.yaml"
MEASURES, SYSTEM = "requirements/measures.yaml", "requirements/system/1-manipulator.yaml"
GRIPPER, STRUCTURE = "requirements/system/2-gripper.yaml", "requirements/architecture/structure.yaml"

VELOCITY_LEVELS = """\
    levels:
      - id: slow
        sets: {d7: 0.5 m/s}
      - id: fast
        sets: {d7: 1 m/s}
"""

EDITS = {
    "unknown key in the scene": (SCENE, "gravity:", "gravty: 1\ngravity:", "unknown key 'gravty'"),
    "unknown key in the study": (STUDY, "replicates:", "replicate: 3\nreplicates:", "unknown key 'replicate'"),
    "unknown key in the requirements": (SYSTEM, "    group:", "    grup: x\n    group:", "unknown key 'grup'"),
    "misspelt key": (SCENE, "gravity:", "gravty:", "unknown key 'gravty' (did you mean 'gravity'?)"),
    "missing unit in the scene": (SCENE, "radius: 35 mm", "radius: 35", "'35' has no unit (write \"35 m\")"),
    "missing unit in the study": (STUDY, "clearance: 8 mm", "clearance: 8", "'8' has no unit"),
    "missing unit in the designs": (SPACE, "d4: 0.04 m/s", "d4: 0.04", "'0.04' has no unit"),
    "missing unit of a threshold": (
        GRIPPER,
        'threshold: "3 s"',
        "threshold: 3",
        "has the unit '1', but 't_gc_simulated'",
    ),
    "wrong unit in the scene": (SCENE, "mass: 0.25 kg", "mass: 0.25 m", "unit 'm' does not measure what 'kg' measures"),
    "wrong unit of the robot": ("scenes/robots/ur10.yaml", "330 N*m", "330 kg", "unit 'kg' does not measure"),
    "wrong unit of a gripper": ("scenes/grippers/kg-2.yaml", "48 mm", "48 kg", "unit 'kg' does not measure"),
    "wrong unit of a measure": (MEASURES, "value: 48 mm", "value: 48 kg", "unit 'kg' does not measure"),
    "wrong unit of a threshold": (
        GRIPPER,
        'threshold: "3 s"',
        'threshold: "3 kg"',
        "has the unit 'kg', but 't_gc_simulated'",
    ),
    "wrong unit of a source": (MEASURES, "v_d, source: design.d7", "v_d, source: design.d6", "measured in '1', not in"),
    "duplicate body": (SCENE, "id: shelf", "id: column", "id 'column' is taken"),
    "duplicate requirement": (SYSTEM, "id: SYS-002", "id: SYS-001", "id 'SYS-001' is already"),
    "duplicate stakeholder requirement": (
        "requirements/stakeholder.yaml",
        "id: STK-010",
        "id: STK-006",
        "id 'STK-006' is already",
    ),
    "duplicate measure": (MEASURES, "- id: C_total", "- id: P_max", "id 'P_max' is already"),
    "duplicate factor": (SPACE, "- id: velocity", "- id: fingers", "id 'fingers' is already"),
    "duplicate level": (SPACE, "- id: medium", "- id: short", "id 'short' is already"),
    "duplicate key": (SCENE, "gravity: 9.81", "gravity: 9.8 m/s^2\ngravity: 9.81", "key 'gravity' is already"),
    "factor without levels": (SPACE, VELOCITY_LEVELS, "    levels: []\n", "factor 'velocity' has no levels"),
    "factor with nothing for levels": (
        SPACE,
        VELOCITY_LEVELS,
        "    levels:\n",
        "has neither just levels nor just a range",
    ),
    "URDF that is not there": (
        "scenes/robots/ur10.yaml",
        "description: ur10.urdf",
        "description: ur11.urdf",
        "there is no file 'ur11.urdf'",
    ),
    "unknown planner": (SPACE, "{d8: TRRT}", "{d8: PRM}", "no planner component is named 'PRM'"),
    "unknown measure": (STUDY, "measure: S,", "measure: SS,", "no measure 'SS' is defined"),
    "unknown source": (MEASURES, "trial.slip_m", "trial.slipp_m", "the trials have no 'trial.slipp_m'"),
    "unknown scene": (STUDY, SCENE, "scenes/kitchen.yaml", "there is no file 'scenes/kitchen.yaml'"),
    "file outside the project": (STUDY, SCENE, "../restaurant.yaml", "lies outside the project"),
    "weights that do not sum to 1": (STUDY, "weight: 0.10", "weight: 0.11", "weights must sum to 1"),
    "no friction": (SPACE, "d6: 0.7", "d6: 0", "d6 must be greater than zero"),
    "alias bomb": (STUDY, "seed: 1", "seed: &a 1", "anchor &a is refused"),
    "tag": (STUDY, "seed: 1", "seed: !!python/object/apply:os.getcwd []", "tag "),
}

FILES = [
    "requirements/stakeholder.yaml",
    SYSTEM,
    STRUCTURE,
    MEASURES,
    CATALOGUE,
    SPACE,
    SCENE,
    "scenes/robots/ur10.yaml",
    "scenes/grippers/kg-2.yaml",
    STUDY,
]

LARGE = 20 * 1024 * 1024
TEXTS = {
    "20 MB of nested lists": ("[" * (LARGE // 2) + "]" * (LARGE // 2), "is too large: at most 16 MiB are read"),
    "20 MB of indented lists": ("- " * (LARGE // 2), "is too large: at most 16 MiB are read"),
    "deeply nested lists": ("[" * 100_000 + "]" * 100_000, "nested more than 40 deep"),
    "no YAML": ("study:\n\t- [", "not valid YAML"),
    "a list": ("- 1\n- 2\n", "a mapping is expected"),
}


def verbs(folder):
    """A command that reads files only, and one that would simulate."""
    return [
        ("check", "--project", folder),
        ("sweep", "--project", folder, "--only", "65", "--replicates", "1", "--jobs", "1"),
    ]


def one_line(rgss, folder, file, expected):
    for words in verbs(folder):
        told = rgss(*words)
        lines = (told.output + told.errors).splitlines()

        assert told.status == 2
        assert len(lines) == 1, lines
        assert re.match(rf"{re.escape(file)}:\d+:\d+: error: ", lines[0])
        assert expected in lines[0]
        assert re.search(r" \[[a-z]+\.[a-z-]+\]$", lines[0])
        # What is wrong is the result of a check, and a complaint of every other command.
        assert (told.output == "") is (words[0] != "check")
    assert not (folder / ".rgss").exists()


@pytest.mark.verifies("SYS-027")
@pytest.mark.parametrize("name", EDITS)
def test_a_mistake_is_one_line(rgss, folder, name):
    file, old, new, expected = EDITS[name]
    text = (folder / file).read_text(encoding="utf-8")
    assert old in text
    (folder / file).write_text(text.replace(old, new, 1), encoding="utf-8")

    one_line(rgss, folder, file, expected)


@pytest.mark.verifies("SYS-027")
@pytest.mark.parametrize("file", FILES)
def test_an_empty_file_is_one_line(rgss, folder, file):
    (folder / file).write_text("", encoding="utf-8")

    one_line(rgss, folder, file, "the file is empty")


@pytest.mark.verifies("SYS-027")
@pytest.mark.parametrize("file", [STUDY, SCENE])
@pytest.mark.parametrize("name", TEXTS)
def test_a_file_of_something_else_is_one_line(rgss, folder, name, file):
    text, expected = TEXTS[name]
    (folder / file).write_text(text, encoding="utf-8")

    one_line(rgss, folder, file, expected)


@pytest.mark.verifies("SYS-027")
@pytest.mark.parametrize("file", [file for file in FILES if file not in (SYSTEM, STRUCTURE)])
def test_a_missing_file_is_one_line(rgss, folder, file):
    # Where there are other studies, one is asked to name one; tests/cli/test_arguments.py has that.
    for path in (folder / "studies").glob("*.yaml") if file == STUDY else [folder / file]:
        path.unlink()
    named_in = {SCENE: STUDY, SPACE: STUDY, CATALOGUE: STUDY, "scenes/robots/ur10.yaml": SCENE}
    named_in |= {file: CATALOGUE for file in FILES if file.startswith("scenes/grippers/")}

    one_line(rgss, folder, named_in.get(file, file), "no ")


@pytest.mark.verifies("SYS-027")
def test_a_urdf_that_is_not_there_or_empty(rgss, folder):
    urdf = folder / "scenes/robots/ur10.urdf"
    urdf.write_text("", encoding="utf-8")
    one_line(rgss, folder, "scenes/robots/ur10.yaml", "'ur10.urdf' is not XML")
    urdf.unlink()
    one_line(rgss, folder, "scenes/robots/ur10.yaml", "there is no file 'ur10.urdf'")


def test_every_problem_has_its_line(rgss, folder):
    for file, old, new in ((SCENE, "radius: 35 mm", "radius: 35"), (STUDY, "rate: 240 Hz", "rate: 0 Hz")):
        text = (folder / file).read_text(encoding="utf-8")
        (folder / file).write_text(text.replace(old, new, 1), encoding="utf-8")
    checked, measured = rgss("check", "--project", folder), rgss("measure", "--project", folder)

    assert checked.output == measured.errors
    assert [line.split(":")[0] for line in measured.errors.splitlines()] == [SCENE, STUDY]
    assert (checked.status, measured.status, measured.output) == (2, 2, "")
