"""Moves to named frames: where they end, what is refused, and that the frames are inputs of the plan."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from rgss.scenes import NamedFrame, Pose, load_gripper_file, load_scene
from rgss.tasks import load_task, task_findings
from rgss.trials.pieces.scene_digests import geometry_digest
from rgss.trials.route import route_of

ROOT = Path(__file__).parents[2]
DOWN = (1.0, 0.0, 0.0, 0.0)
TRAY = NamedFrame(id="tray", pose=Pose(position_m=(0.5, 0.1, 1.0), quaternion_xyzw=(0.0, 0.0, 0.6, 0.8)))
OVER = NamedFrame(id="over", pose=Pose(position_m=(0.01, 0.0, 0.2), quaternion_xyzw=DOWN), object="cup")
CARRY = "  - move: {to: grasp}\n  - grip: {}\n"
PLACED = "  - move: {to: place}\n  - release: {}\n"


@pytest.fixture(scope="module")
def scene():
    return replace(load_scene(ROOT / "scenes" / "restaurant.yaml"), frames=(TRAY, OVER))


@pytest.fixture(scope="module")
def three_fingers():
    return load_gripper_file(ROOT / "scenes" / "grippers" / "kg-3.yaml", project=ROOT).geometry


def loaded(tmp_path, steps):
    path = tmp_path / "task.yaml"
    path.write_text("task: t\nsteps:\n" + steps, encoding="utf-8")
    return load_task(path, label="task.yaml")


def findings(tmp_path, scene, steps):
    return [str(one) for one in task_findings(loaded(tmp_path, steps), scene)]


def end_of(route, name):
    return next(route.stops[leg.goal].pose for leg in route.legs if leg.step.name == name)


def test_moves_end_at_frames_and_at_poses_in_frames(tmp_path, scene, three_fingers):
    steps = (
        "  - move: {frame: tray, raised: 50 mm}\n"
        "  - move: {pose: {frame: tray, position: [100 mm, 0 mm, 20 mm]}, name: beside}\n"
        "  - move: {frame: over}\n"
    )
    route = route_of(scene, three_fingers, loaded(tmp_path, steps).program)
    assert end_of(route, "move_to_tray") == replace(TRAY.pose, position_m=(0.5, 0.1, 1.05))
    beside = end_of(route, "beside")
    # The tray is turned by twice the arc of 0.6: the cosine is 0.28, the sine 0.96.
    assert beside.position_m == pytest.approx((0.5 + 0.1 * 0.28, 0.1 + 0.1 * 0.96, 1.02), abs=1e-12)
    assert beside.rotate((0.0, 0.0, 1.0)) == pytest.approx((0.0, 0.0, -1.0), abs=1e-12)
    x, y, z = scene.workpiece.pose.position_m
    assert end_of(route, "move_to_over").position_m == pytest.approx((x + 0.01, y, z + 0.2), abs=1e-12)


def test_a_frame_of_an_object_is_where_the_object_was_put(tmp_path, scene, three_fingers):
    steps = CARRY + PLACED + "  - move: {to: place_approach}\n  - move: {frame: over, mode: straight}\n"
    route = route_of(scene, three_fingers, loaded(tmp_path, steps).program)
    x, y, z = scene.place.centre_m
    placed, at = end_of(route, "move_to_over"), z + scene.workpiece.shape.half_height_m + 0.2
    assert placed.position_m[2] == pytest.approx(at, abs=1e-9)
    assert (placed.position_m[0] - x) ** 2 + (placed.position_m[1] - y) ** 2 == pytest.approx(0.01**2, abs=1e-9)


def test_an_unknown_frame_gets_a_suggestion(tmp_path, scene):
    (found,) = findings(tmp_path, scene, "  - move: {frame: trey}\n")
    assert found == "task.yaml:3:19: error: there is no frame 'trey' (did you mean 'tray'?) [task.unknown-frame]"
    (found,) = findings(tmp_path, scene, "  - move: {pose: {frame: x, position: [0 m, 0 m, 0 m]}}\n")
    assert found == "task.yaml:3:26: error: there is no frame 'x' (frames: tray, over) [task.unknown-frame]"
    (found,) = findings(tmp_path, replace(scene, frames=()), "  - move: {frame: tray}\n")
    assert "(list it under frames in the scene)" in found


def test_a_frame_of_the_held_object_is_refused(tmp_path, scene):
    (found,) = findings(tmp_path, scene, CARRY + "  - move: {frame: over, mode: straight}\n" + PLACED)
    assert "moves to the frame 'over' of cup, which is held" in found
    assert findings(tmp_path, scene, CARRY + "  - move: {frame: tray}\n" + PLACED) == []


def test_the_frames_to_which_a_task_moves_are_inputs_of_the_plan(scene):
    moved = replace(scene, frames=(replace(TRAY, pose=TRAY.pose.raised(0.01)), OVER))
    scenes = (scene, moved, replace(scene, frames=()))
    assert len({geometry_digest(one, frames=frozenset({"tray"})) for one in scenes}) == 3
    assert len({geometry_digest(one, frames=frozenset({"over"})) for one in scenes}) == 2
    assert len({geometry_digest(one) for one in scenes}) == 1
