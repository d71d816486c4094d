"""Named frames of scenes and robots, against products of homogeneous matrices."""

from __future__ import annotations

import math

import numpy as np
import pytest

FRAMES = """\
frames:
  tray: {position: [0.1 m, 0.2 m, 0.3 m], yaw: 30 deg}
  slot: {parent: tray, position: [50 mm, 20 mm, 0 mm], roll: 180 deg}
  deep: {parent: slot, position: [0 mm, 0 mm, 10 mm], pitch: 10 deg}
  beside: {parent: robot, position: [0.5 m, 0 m, 0.1 m]}
  rim: {parent: mug, position: [0 mm, 0 mm, 60 mm], yaw: 90 deg}
  over: {parent: rim, position: [10 mm, 0 mm, 0 mm]}
"""


def matrix(x, y, z, *, roll=0.0, pitch=0.0, yaw=0.0):
    """Rotations about x, then y, then z, and a translation, shape (4, 4)."""
    (cr, sr), (cp, sp), (cy, sy) = ((math.cos(a), math.sin(a)) for a in map(math.radians, (roll, pitch, yaw)))
    found = np.eye(4)
    about_x = np.array([[1, 0, 0], [0, cr, -sr], [0, sr, cr]])
    about_y = np.array([[cp, 0, sp], [0, 1, 0], [-sp, 0, cp]])
    about_z = np.array([[cy, -sy, 0], [sy, cy, 0], [0, 0, 1]])
    found[:3, :3], found[:3, 3] = about_z @ about_y @ about_x, (x, y, z)
    return found


def matrix_of(pose):
    found = np.eye(4)
    found[:3, :3] = np.array([pose.rotate(axis) for axis in ((1.0, 0, 0), (0, 1.0, 0), (0, 0, 1.0))]).T
    found[:3, 3] = pose.position_m
    return found


def test_frames_are_composed_with_their_parents(kitchen):
    scene = kitchen.change("kitchen.yaml", "task:\n", FRAMES + "task:\n").scene()
    frames = {one.id: one for one in scene.frames}
    tray = matrix(0.1, 0.2, 0.3, yaw=30)
    slot = tray @ matrix(0.05, 0.02, 0.0, roll=180)
    rim = matrix(0.0, 0.0, 0.06, yaw=90)
    expected = {
        "tray": ("", tray),
        "slot": ("", slot),
        "deep": ("", slot @ matrix(0.0, 0.0, 0.01, pitch=10)),
        "beside": ("", matrix(1.0, 2.0, 0.5, yaw=90) @ matrix(0.5, 0.0, 0.1)),
        "rim": ("mug", rim),
        "over": ("mug", rim @ matrix(0.01, 0.0, 0.0)),
    }
    assert list(frames) == list(expected)
    for name, (about, pose) in expected.items():
        assert frames[name].object == about
        assert matrix_of(frames[name].pose) == pytest.approx(pose, abs=1e-12)


def test_frames_of_a_robot_file_are_in_its_base_and_parents_of_the_scene(kitchen):
    robot = "frames:\n  parked: {position: [0.3 m, 0 m, 0.5 m], roll: 180 deg}\n"
    kitchen.change("robots/six.yaml", "payload:", robot + "payload:")
    kitchen.change("kitchen.yaml", "task:\n", "frames: {near: {parent: parked, position: [0 m, 0 m, 0.1 m]}}\ntask:\n")
    parked, near = kitchen.scene().frames
    expected = matrix(1.0, 2.0, 0.5, yaw=90) @ matrix(0.3, 0.0, 0.5, roll=180)
    assert matrix_of(parked.pose) == pytest.approx(expected, abs=1e-12)
    assert matrix_of(near.pose) == pytest.approx(expected @ matrix(0.0, 0.0, 0.1), abs=1e-12)


@pytest.mark.parametrize(
    ("frames", "said"),
    [
        ("{a: {parent: wrold, position: [0 m, 0 m, 0 m]}}", "unknown parent 'wrold' (did you mean 'world'?)"),
        ("{a: {parent: table, position: [0 m, 0 m, 0 m]}}", "unknown parent 'table' (parents: world, robot, mug, a)"),
        ("{a: {parent: a, position: [0 m, 0 m, 0 m]}}", "frame 'a' is its own parent: a in a"),
        ("{mug: {position: [0 m, 0 m, 0 m]}}", "the name 'mug' of a frame is taken"),
        ("{robot: {position: [0 m, 0 m, 0 m]}}", "the name 'robot' of a frame is taken"),
    ],
)
def test_wrong_frames_are_one_finding(kitchen, frames, said):
    kitchen.change("kitchen.yaml", "task:\n", f"frames: {frames}\ntask:\n")
    (found,) = kitchen.findings("scene")
    assert said in found


def test_a_cycle_is_found_at_each_of_its_frames_and_at_no_other(kitchen):
    at = "position: [0 m, 0 m, 0 m]"
    frames = f"frames: {{a: {{parent: b, {at}}}, b: {{parent: a, {at}}}, c: {{parent: a, {at}}}}}\ntask:\n"
    found = kitchen.change("kitchen.yaml", "task:\n", frames).findings("scene")
    assert [message.split("scene.frame ")[1].split(" (")[0] for message in found] == [
        "frame 'a' is its own parent: a in b in a",
        "frame 'b' is its own parent: b in a in b",
    ]
