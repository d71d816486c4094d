"""Mountings that designs set."""

from __future__ import annotations

from dataclasses import replace

import pytest

from rgss.errors import DefinitionError, DocumentError
from rgss.evidence import Fidelity
from rgss.scenes import load_gripper_file
from rgss.studies.expansion import trial_specs
from rgss.studies.project import load_project
from rgss.studies.scene_findings import check_scene
from rgss.studies.trial_values import mounted
from rgss.trials.pieces.run import Pieces
from tests.fixtures.shipped_project import copy_project
from tests.trials.hands.gripper_files import FILES, linkage_file


def gripper_file(folder, name):
    path = folder / "gripper.yaml"
    path.write_text(FILES[name], encoding="utf-8")
    return load_gripper_file(path)


def test_a_design_sets_the_mounting(tmp_path):
    file = gripper_file(tmp_path, "parallel")

    assert mounted(file, None, 1).mounting == "reverse"
    assert mounted(file, "normal", 1).mounting == "normal"


@pytest.mark.parametrize(
    ("name", "hint"), [("parallel", "mountings: normal, reverse"), ("vacuum", "state the name of its only one")]
)
def test_an_unknown_mounting_is_refused(tmp_path, name, hint):
    with pytest.raises(DefinitionError, match="of variant 7 has no mounting 'upside-down'") as caught:
        mounted(gripper_file(tmp_path, name), "upside-down", 7)

    assert hint in caught.value.hint


@pytest.mark.parametrize("name", ["fingers", "linkage", "vacuum"])
def test_a_gripper_of_one_mounting_has_a_name_for_designs_that_compare_mountings(tmp_path, name):
    linkage_file(tmp_path)  # the URDF
    path = tmp_path / "gripper.yaml"
    path.write_text(f"{FILES[name]}\nmounting: own\n", encoding="utf-8")
    file = load_gripper_file(path)

    assert mounted(file, "own", 1) == mounted(file, None, 1) == file.geometry
    with pytest.raises(DefinitionError) as caught:
        mounted(file, "normal", 1)
    assert caught.value.hint == "mountings: own"


DESIGNS, CATALOGUE, KG_2 = "designs/grasping_system.yaml", "designs/catalogue.yaml", "scenes/grippers/kg-2.yaml"
MOUNTINGS = ("normal", "reverse")
PARAMETER = "  - {id: d10, name: mounting, symbol: b, kind: name, sets: gripper.mounting, description: Mounting.}\n"
LEVELS = """\
  - id: mounting
    name: Mounting
    levels:
      - {id: one, sets: {d10: normal}}
      - {id: other, sets: {d10: reverse}}
"""


@pytest.fixture
def two_mountings(tmp_path):
    """A copy of the shipped project of two fingers in two mountings, of which one holds its object."""
    folder = copy_project(tmp_path / "project")
    mountings = "{normal: {closed: 0 mm, open: 16 mm}, reverse: {closed: 60 mm, open: 100 mm}}"
    edit(folder / KG_2, "azimuths: [0 deg, 180 deg]", f"kind: parallel\nmountings: {mountings}\nmounting: normal")
    edit(folder / KG_2, "largest_opening: 70 mm\nstroke: 48 mm\n", "")
    edit(folder / DESIGNS, "constants:\n", f"{PARAMETER}\nconstants:\n")
    edit(folder / DESIGNS, "factors:\n", f"factors:\n{LEVELS}")
    edit(folder / DESIGNS, "      - id: three\n        sets: {d1: 3}\n", "")
    study = folder / "studies" / "pick_place.yaml"
    study.write_text(study.read_text(encoding="utf-8").split("\nregression:")[0] + "\n", encoding="utf-8")
    return folder


def edit(path, old, new):
    text = path.read_text(encoding="utf-8")
    assert text.count(old) == 1, (path, old)
    path.write_text(text.replace(old, new), encoding="utf-8")


def test_a_design_space_compares_mountings(two_mountings):
    project = load_project(two_mountings)

    specs = trial_specs(project)

    assert {spec.gripper.geometry.mounting for spec in specs} == {*MOUNTINGS}
    first = {name: next(spec for spec in specs if spec.gripper.geometry.mounting == name) for name in MOUNTINGS}
    records = {name: Pieces().record(replace(spec, fidelity=Fidelity.KINEMATIC)) for name, spec in first.items()}
    assert "too wide to enter gripper kg-2 in its mounting normal" in records["normal"].failure_detail
    assert records["reverse"].success
    # The mounting that cannot hold the object is compared, it is no mistake of the scene.
    assert not [finding for finding in check_scene(project).findings if finding.rule == "scene.unserved"]


def test_a_mounting_that_no_gripper_has_is_found_where_it_is_set(two_mountings):
    edit(two_mountings / DESIGNS, "{d10: normal}", "{d10: sideways}")

    with pytest.raises(DocumentError) as caught:
        load_project(two_mountings)

    (finding,) = (str(one) for one in caught.value.findings if one.rule == "design.mounting")
    assert (
        "no gripper has a mounting 'sideways' (mountings: normal, reverse; a gripper with one states its name"
        in finding
    )
    assert finding.startswith(f"{DESIGNS}:")
