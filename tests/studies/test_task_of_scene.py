"""A task that a scene names, and the control of its steps at the rate of the study."""

from __future__ import annotations

import pytest

from rgss.studies import load_project

SCENE, STUDY = "scenes/restaurant.yaml", "studies/pick_place.yaml"
TASK = (
    "task: short\nsteps:\n  - move: {to: grasp}\n  - grip: {}\n"
    "  - move: {to: place, control: {mode: velocity, velocity_gain: 80 rad/s}}\n  - release: {}\n"
)


@pytest.fixture
def named(edit, folder):
    """The shipped project with a scene that names a task of two moves."""
    (folder / "scenes" / "tasks" / "short.yaml").write_text(TASK, encoding="utf-8")
    text = (folder / STUDY).read_text(encoding="utf-8").split("\n# What `rgss regress`", 1)[0]
    (folder / STUDY).write_text(text, encoding="utf-8")
    measures = folder / "requirements" / "measures.yaml"
    measures.write_text(measures.read_text(encoding="utf-8").replace("length: 5", "length: 2"), encoding="utf-8")
    edit(SCENE, "task:\n", "task:\n  steps: tasks/short.yaml\n")
    return folder


def test_a_study_that_names_none_has_the_task_of_its_scene(named, edit):
    assert load_project(named).study.task.id == "short"

    edit(
        STUDY, "scene: scenes/restaurant.yaml", "scene: scenes/restaurant.yaml\ntask: scenes/tasks/pick_and_place.yaml"
    )
    edit("scenes/tasks/pick_and_place.yaml", "task: pick_and_place", "task: eight")
    for _ in range(2):
        edit("requirements/measures.yaml", "length: 2", "length: 5")
    assert load_project(named).study.task.id == "eight"


@pytest.mark.parametrize(
    ("name", "problem"),
    [
        ("tasks/shor.yaml", "there is no file 'tasks/shor.yaml' (file names are relative to the scene) [scene.task]"),
        ("../short.yaml", "'../short.yaml' lies outside the scene's folder (name a file in it) [scene.task]"),
    ],
)
def test_a_file_that_is_not_there_is_found_in_the_scene(named, edit, problems, place_of, name, problem):
    edit(SCENE, "tasks/short.yaml", name)

    assert f"{place_of(SCENE, name)}: error: {problem}" in problems()


def test_gains_of_a_step_that_are_unstable_at_the_rate_are_found(named, edit, problems):
    edit("scenes/tasks/short.yaml", "80 rad/s", "900 rad/s")

    (found,) = (one for one in problems() if "task.unstable-control" in one)
    assert found.startswith(
        "scenes/tasks/short.yaml:5:32: error: the control is unstable at 240 Hz: its gains need more"
    )
