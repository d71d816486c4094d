"""A grasp that is chosen serves several objects of one form."""

from __future__ import annotations

import shutil

import pytest

from rgss.errors import DocumentError
from rgss.scenes import load_scene
from tests.fixtures.shipped_project import REPOSITORY

LATER_CUBE = "  - id: green_cube\n    box: [30 mm, 30 mm, 30 mm]"


@pytest.fixture
def table(tmp_path):
    """Loads the scene of three cubes with a chosen grasp, its text changed."""
    shutil.copytree(REPOSITORY / "scenes", tmp_path / "scenes")
    path = tmp_path / "scenes" / "lite6_table.yaml"

    def load(old, new, grasp="automatic"):
        text = path.read_text(encoding="utf-8")
        assert old in text
        text = text.replace("  grasp_yaw: 0 deg\n", f"  grasp_yaw: 0 deg\n  grasp: {grasp}\n")
        path.write_text(text.replace(old, new), encoding="utf-8")
        return load_scene(path, project=tmp_path)

    return load


def test_objects_of_one_form_share_the_chosen_grasp(table):
    assert len(table(LATER_CUBE, LATER_CUBE).objects) == 3


@pytest.mark.parametrize(
    "form",
    ["    box: [30 mm, 30 mm, 20 mm]", "    box: [30 mm, 30 mm, 30 mm]\n    centre_of_mass: [0 mm, 5 mm, 0 mm]"],
)
def test_an_object_of_another_form_is_refused_where_the_grasp_is_chosen(table, form):
    with pytest.raises(DocumentError) as caught:
        table(LATER_CUBE, f"  - id: green_cube\n{form}")
    (finding,) = caught.value.findings
    assert finding.rule == "scene.shared-grasp"
    assert finding.message == "the grasp is chosen on 'red_cube' for all objects, and 'green_cube' has another form"


def test_a_stated_grasp_takes_objects_of_other_forms(table):
    changed = "  - id: green_cube\n    box: [30 mm, 30 mm, 20 mm]"
    assert len(table(LATER_CUBE, changed, grasp="as_stated").objects) == 3
