"""A file that is not there is reported at the line that names it, whichever document that is."""

from __future__ import annotations

import pytest

from rgss.errors import DocumentError
from rgss.studies import load_project
from tests.fixtures.shipped_project import copy_as_shipped

REFERENCES = [
    ("designs/catalogue.yaml", "geometry: ", "scenes/grippers/kg-3.yaml", "design.missing-file"),
    ("scenes/restaurant.yaml", "description: ", "robots/ur10.yaml", "scene.missing-file"),
    ("scenes/robots/ur10.yaml", "description: ", "ur10.urdf", "scene.missing-file"),
    ("studies/pick_place.yaml", "design_space: ", "designs/grasping_system.yaml", "study.missing-file"),
    ("studies/pick_place.yaml", "catalogue: ", "designs/catalogue.yaml", "study.missing-file"),
    ("studies/pick_place.yaml", "scene: ", "scenes/restaurant.yaml", "study.missing-file"),
]


@pytest.mark.parametrize(("document", "key", "name", "rule"), REFERENCES)
def test_it_is_reported_where_it_is_named(tmp_path, document, key, name, rule):
    folder = copy_as_shipped(tmp_path / "project")
    path = folder / document
    before, found, after = path.read_text(encoding="utf-8").partition(key + name)
    assert found
    path.write_text(f"{before}{key}gone/{name}{after}", encoding="utf-8")
    with pytest.raises(DocumentError) as caught:
        load_project(folder)
    column = len(before.rpartition("\n")[2]) + len(key) + 1
    (finding,) = (one for one in caught.value.findings if one.rule.endswith("missing-file"))
    assert (finding.file, finding.line, finding.column) == (document, before.count("\n") + 1, column)
    assert (finding.rule, finding.message) == (rule, f"there is no file 'gone/{name}'")
    assert finding.hint.startswith("file names are relative to ")


def test_a_gripper_that_two_components_miss_is_reported_at_the_first(tmp_path):
    folder = copy_as_shipped(tmp_path / "project")
    (folder / "scenes/grippers/kg-3.yaml").unlink()
    with pytest.raises(DocumentError) as caught:
        load_project(folder)
    lines = (folder / "designs/catalogue.yaml").read_text(encoding="utf-8").splitlines()
    naming = [
        number for number, line in enumerate(lines, start=1) if line.endswith("geometry: scenes/grippers/kg-3.yaml")
    ]
    assert [(one.file, one.line) for one in caught.value.findings if one.rule == "design.missing-file"] == [
        ("designs/catalogue.yaml", naming[0])
    ]
    assert len(naming) == 2
