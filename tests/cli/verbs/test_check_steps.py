"""``rgss check`` finds steps of a task that no design can carry out in the scene, at their lines in the task's file."""

from __future__ import annotations

import re

import pytest

LIFTED = "  - move: {to: grasp}\n  - grip: {}\n  - move: {to: lift, mode: straight}\n"
BESIDE = "'grip' grips nothing: the ends of the fingers are "
ABOVE = "'release' releases cup "


@pytest.fixture
def check_task(rgss, folder):
    """Checks a project with a task; returns the findings on its steps."""

    def check(steps, *edits):
        (folder / "scenes/tasks").mkdir(exist_ok=True)
        # The measures of the study have a row for each of five planned moves.
        missing = 5 - len(re.findall(r"(?m)^  - move: (?!.*straight)", steps))
        steps += "".join(f"  - move: {{name: away_{index}, to: grasp_approach}}\n" for index in range(missing))
        (folder / "scenes/tasks/own.yaml").write_text(f"task: own\nsteps:\n{steps}", encoding="utf-8")
        study = folder / "studies/pick_place.yaml"
        text = study.read_text(encoding="utf-8")
        text = re.sub(r"(?m)^scene: (.*)$", r"scene: \1\ntask: scenes/tasks/own.yaml", text)
        study.write_text(text, encoding="utf-8")
        scene = folder / "scenes/restaurant.yaml"
        text = scene.read_text(encoding="utf-8")
        for old, new in edits:
            assert text.count(old) == 1, old
            text = text.replace(old, new)
        scene.write_text(text, encoding="utf-8")
        told = rgss("check", "--json", "--project", folder)
        return [one for one in told.document["findings"] if one["rule"].startswith("task.")]

    return check


@pytest.mark.parametrize(
    ("steps", "rule", "line", "message"),
    [
        # The approach is 150 mm above the grasp, the fingers reach 30 mm below it and the cup 50 mm above.
        (
            "  - move: {to: grasp_approach}\n  - grip: {}\n  - move: {to: place}\n  - release: {}\n",
            "task.grip-beside",
            4,
            f"{BESIDE}70 mm from cup",
        ),
        (
            "  - move: {to: grasp, raised: 90 mm}\n  - grip: {}\n  - move: {to: place}\n  - release: {}\n",
            "task.grip-beside",
            4,
            f"{BESIDE}10 mm from cup",
        ),
        (f"{LIFTED}  - release: {{}}\n", "task.release-height", 6, f"{ABOVE}60 mm above its place on counter_place"),
        (
            f"{LIFTED}  - move: {{to: place, raised: 15 mm}}\n  - release: {{}}\n",
            "task.release-height",
            7,
            f"{ABOVE}20 mm above its place on counter_place, at most 10 mm",
        ),
    ],
)
def test_steps_of_the_hand_that_cannot_succeed(check_task, steps, rule, line, message):
    (one,) = check_task(steps)
    assert (one["rule"], one["line"], one["severity"]) == (rule, line, "error")
    assert one["message"].startswith(message)
    assert one["hint"].startswith("move to ")


def test_steps_of_the_hand_that_can_succeed(check_task):
    steps = "  - move: {to: grasp, raised: 70 mm}\n  - grip: {}\n  - move: {to: place, raised: 4 mm}\n  - release: {}\n"
    assert check_task(steps) == []


@pytest.mark.parametrize(("drop", "found"), [("65 mm", 0), ("55 mm", 1)])
def test_the_height_of_a_release_is_compared_with_the_place(check_task, drop, found):
    assert (
        len(
            check_task(
                f"{LIFTED}  - release: {{}}\n", ("\nplace_region:\n", f"\nplace_region:\n  largest_drop: {drop}\n")
            )
        )
        == found
    )


def test_a_chosen_grasp_is_approached_along_its_own_axis(check_task):
    steps = "  - move: {to: grasp_approach}\n  - grip: {}\n  - move: {to: place}\n  - release: {}\n"
    (one,) = check_task(steps, ("\ntask:\n", "\ntask:\n  grasp: automatic\n"))
    assert one["rule"] == "task.grip-beside"
