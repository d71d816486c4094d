"""Mountings that designs set."""

from __future__ import annotations

import pytest

from rgss.errors import DefinitionError
from rgss.scenes import load_gripper_file
from rgss.studies.mountings import mounted
from tests.trials.hands.gripper_files import FILES


def gripper_file(folder, name):
    path = folder / "gripper.yaml"
    path.write_text(FILES[name], encoding="utf-8")
    return load_gripper_file(path)


def test_a_design_sets_the_mounting(tmp_path):
    file = gripper_file(tmp_path, "parallel")

    assert mounted(file, None, 1).mounting == "reverse"
    assert mounted(file, "normal", 1).mounting == "normal"


@pytest.mark.parametrize(
    ("name", "hint"), [("parallel", "mountings: normal, reverse"), ("vacuum", "give it mountings in its file")]
)
def test_an_unknown_mounting_is_refused(tmp_path, name, hint):
    with pytest.raises(DefinitionError, match="of variant 7 has no mounting 'upside-down'") as caught:
        mounted(gripper_file(tmp_path, name), "upside-down", 7)

    assert hint in caught.value.hint
