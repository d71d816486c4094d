"""Tasks in a scene: names that the scene does not have, and configurations that the arm does not."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from rgss.scenes import GraspCandidates, NamedPlace, load_scene
from rgss.tasks import load_task, task_findings

ROOT = Path(__file__).parents[2]
GRASP = "  - move: {to: grasp}\n"
CARRY = GRASP + "  - grip: {}\n  - move: {to: place}\n"


@pytest.fixture(scope="module")
def scene():
    """A scene with one object, the cup, and a further place beside its own."""
    scene = load_scene(ROOT / "scenes" / "restaurant.yaml")
    return replace(scene, places=(NamedPlace(id="tray", support=scene.place_support, region=scene.place),))


def findings_of(tmp_path, scene, text):
    path = tmp_path / "task.yaml"
    path.write_text("task: t\n" + text, encoding="utf-8")
    return [str(finding) for finding in task_findings(load_task(path, label="task.yaml"), scene)]


@pytest.mark.parametrize(
    ("steps", "at"),
    [
        ("  - move: {to: grasp, object: lid}\n", "3:11"),
        (GRASP + "  - grip: {object: lid}\n", "4:11"),
        (GRASP + "  - check: {object: lid, upright: true}\n", "4:12"),
        (GRASP + "  - check: {near: {object: lid, within: 1 m}}\n", "4:28"),
    ],
)
def test_an_object_that_the_scene_does_not_have(tmp_path, scene, steps, at):
    (finding,) = findings_of(tmp_path, scene, "steps:\n" + steps)
    expected = f"task.yaml:{at}: error: there is no object 'lid' (objects: cup) [task.unknown-object]"
    assert finding == expected


@pytest.mark.parametrize(
    ("steps", "at"),
    [
        ("  - move: {to: place, place: shelf}\n", "3:30"),
        (CARRY + "  - release: {place: shelf}\n", "6:22"),
        (GRASP + "  - check: {at: shelf}\n", "4:17"),
        (GRASP + "  - check: {near: {place: shelf, within: 1 m}}\n", "4:27"),
    ],
)
def test_a_place_that_the_scene_does_not_have(tmp_path, scene, steps, at):
    (finding,) = findings_of(tmp_path, scene, "steps:\n" + steps)
    assert finding == f"task.yaml:{at}: error: there is no place 'shelf' (places: tray) [task.unknown-place]"
    (finding,) = findings_of(tmp_path, replace(scene, places=()), "steps:\n" + steps)
    assert finding == (
        f"task.yaml:{at}: error: there is no place 'shelf' (list it under places in the scene) [task.unknown-place]"
    )


def test_names_of_the_start_are_found_too(tmp_path, scene):
    start = "start: {to: place, object: lid, place: shelf}\nsteps:\n" + GRASP
    assert [finding.split(": ")[2] for finding in findings_of(tmp_path, scene, start)] == [
        "there is no object 'lid' (objects",
        "there is no place 'shelf' (places",
    ]


def test_names_that_the_scene_has(tmp_path, scene):
    steps = (
        "  - move: {to: grasp, object: cup}\n  - grip: {object: cup}\n  - move: {to: place, place: tray}\n"
        "  - release: {place: tray}\n  - check: {object: cup, at: tray}\n"
        "  - check: {name: near, near: {place: tray, within: 1 m}}\n"
        "  - check: {name: beside, near: {object: cup, within: 1 m}}\n"
    )
    assert findings_of(tmp_path, scene, "steps:\n" + steps) == []


def test_a_step_in_a_loop_is_found_once(tmp_path, scene):
    loop = "steps:\n  - repeat:\n      times: 3\n      steps:\n        - move: {to: grasp, object: lid}\n"
    assert len(findings_of(tmp_path, scene, loop)) == 1


def test_a_configuration_has_the_joints_of_the_arm_within_their_ranges(tmp_path, scene):
    few = "configurations: {few: [0 deg, 0 deg]}\nsteps:\n  - move: {configuration: few}\n"
    (finding,) = findings_of(tmp_path, scene, few)
    names = ", ".join(joint.name for joint in scene.robot.joints)
    expected = f"configuration 'few' has 2 joints, the robot ur10 has 6 (joints: {names}) [task.joints]"
    assert finding == f"task.yaml:2:23: error: {expected}"
    far = "configurations: {far: [0 deg, 0 deg, 0 deg, 0 deg, 0 deg, 1000 deg]}\nstart: {configuration: far}\nsteps:\n"
    (finding,) = findings_of(tmp_path, scene, far + GRASP)
    last = scene.robot.joints[-1]
    assert finding == (
        f"task.yaml:2:59: error: {last.name} of ur10 is at 17.45, outside its range "
        f"(from {last.lower_rad:.4g} to {last.upper_rad:.4g}) [task.joint-range]"
    )


@pytest.mark.parametrize(
    ("steps", "at", "message"),
    [
        (
            CARRY + "  - release: {}\n  - check: {held: true}\n",
            "7:12",
            "'check' requires 'held: true' of cup, which is not held (write 'held: false', or move the check)",
        ),
        (
            CARRY + "  - check: {name: empty, held: false}\n  - release: {}\n",
            "6:12",
            "'empty' requires 'held: false' of cup, which is held since 'grip' (write 'held: true', or move the check)",
        ),
        (
            GRASP + "  - check: {object: cup, held: true}\n",
            "4:12",
            "'check' requires 'held: true' of cup, which is not held (write 'held: false', or move the check)",
        ),
    ],
)
def test_a_check_that_contradicts_the_steps_before_it(tmp_path, scene, steps, at, message):
    (finding,) = findings_of(tmp_path, scene, "steps:\n" + steps)
    assert finding == f"task.yaml:{at}: error: {message} [task.held]"


def test_checks_that_agree_with_the_steps_before_them(tmp_path, scene):
    before, carried, after = (
        f"  - check: {{name: {name}, held: {held}}}\n"
        for name, held in (("before", "false"), ("carried", "true"), ("after", "false"))
    )
    again = "  - move: {name: again, to: grasp}\n"
    steps = GRASP + before + again + CARRY.removeprefix(GRASP) + carried + "  - release: {}\n" + after
    assert findings_of(tmp_path, scene, "steps:\n" + steps) == []


@pytest.mark.parametrize(
    ("steps", "kind"),
    [
        ("  - move: {configuration: there, name: reach}\n  - grip: {}\n", "configuration"),
        (
            GRASP + "  - move: {pose: {position: [1 m, 0 m, 1 m]}, name: reach}\n  - grip: {}\n",
            "pose",
        ),
    ],
)
def test_a_grasp_is_not_chosen_where_the_task_determines_it(tmp_path, scene, steps, kind):
    text = f"configurations: {{there: [0 rad, 0 rad, 0 rad, 0 rad, 0 rad, 0 rad]}}\nsteps:\n{steps}"
    chosen = replace(scene, task=replace(scene.task, candidates=GraspCandidates()))

    (finding,) = findings_of(tmp_path, chosen, text)

    assert finding == (
        f"task.yaml:{len(text.splitlines()) + 1}:11: error: 'grip' grips at the {kind} of 'reach', and the grasp is to "
        "be chosen among candidates (state the grasp in the scene ('grasp: as_stated'), or move to grasp before it) "
        "[task.unused-grasp]"
    )
    assert findings_of(tmp_path, scene, text) == []
    assert findings_of(tmp_path, chosen, "steps:\n" + CARRY) == []
