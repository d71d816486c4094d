"""Objects that stand so close that no hand gets between them: a mistake of the scene, and not of one gripper."""

from __future__ import annotations

import shutil

import pytest

from rgss.findings import Severity
from rgss.studies import FOLDERS, check_scene, load_project
from tests.fixtures.shipped_project import REPOSITORY

pytestmark = [pytest.mark.engine, pytest.mark.slow]


def test_grasps_of_a_hand_with_one_named_mounting_are_searched(tmp_path):
    """The suction cup of the Lite6 names its only mounting, and the friction of its lip is looked up."""
    for name in FOLDERS:
        shutil.copytree(REPOSITORY / name, tmp_path / name)
    scene = tmp_path / "scenes/lite6_table.yaml"
    text = scene.read_text(encoding="utf-8")
    chosen = text.replace("  grasp_yaw: 0 deg\n", "  grasp_yaw: 0 deg\n  grasp: automatic\n")
    assert chosen != text
    scene.write_text(chosen, encoding="utf-8")
    checked = check_scene(load_project(tmp_path, "studies/lite6_cubes.yaml"))
    assert checked.skipped == ""


def test_a_neighbour_that_every_gripper_meets_is_an_error_for_each(tmp_path):
    for name in FOLDERS:
        shutil.copytree(REPOSITORY / name, tmp_path / name)
    scene = tmp_path / "scenes/lite6_table.yaml"
    text = scene.read_text(encoding="utf-8")
    beside = text.replace("at: [0.19 m, -0.12 m]", "at: [0.27 m, -0.09 m]")
    assert beside != text
    scene.write_text(beside, encoding="utf-8")
    found = check_scene(load_project(tmp_path, "studies/lite6_cubes.yaml")).findings
    met = [
        one for one in found if "red_cube with green_cube" in one.message or "green_cube with red_cube" in one.message
    ]
    assert met
    assert {one.severity for one in met} == {Severity.ERROR}
    assert not any("the others do not" in one.hint for one in met)
