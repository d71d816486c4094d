"""The packaged project: what it shares with the shipped one, what it holds, and what becomes of it."""

from __future__ import annotations

import errno
import itertools
from importlib import resources
from pathlib import Path

import pytest

from rgss.documents import read_document
from rgss.errors import StorageError
from rgss.studies.project import load_project
from rgss.studies.scaffolding import scaffold_texts, write_scaffold
from rgss.studies.schemas.document_kinds import kind_of
from rgss.studies.schemas.schema_headers import schema_reference, with_header

REPOSITORY = Path(__file__).parents[2]
SHARED = [
    "scenes/robots/ur10.urdf",
    "scenes/robots/ur10.yaml",
    "scenes/grippers/kg-2.yaml",
    "scenes/grippers/kg-3.yaml",
]


@pytest.mark.parametrize("name", SHARED)
def test_robot_and_grippers_are_those_of_the_shipped_project(name):
    packaged = resources.files("rgss.studies").joinpath("scaffold", *name.split("/"))

    assert packaged.read_bytes() == (REPOSITORY / name).read_bytes()


def test_trials_are_made_as_in_the_nominal_study():
    packaged = resources.files("rgss.studies").joinpath("scaffold", "studies", "pick_place.yaml")
    with resources.as_file(packaged) as path:
        new, shipped = read_document(path).data, read_document(REPOSITORY / "studies" / "nominal_world.yaml").data

    assert (new["planning"], new["physics"]) == (shipped["planning"], shipped["physics"])


def test_every_document_names_its_schema_and_says_what_it_is():
    texts = scaffold_texts()
    documents = {name: text.splitlines() for name, text in texts.items() if name.endswith(".yaml")}

    assert len(documents) == 11
    for name, (first, second, *_) in documents.items():
        schema = first.removeprefix("# yaml-language-server: $schema=" + "../" * name.count("/"))
        assert schema in texts, name
        assert second.startswith("# "), name


def test_evidence_is_not_for_version_control():
    assert ".rgss/" in scaffold_texts()[".gitignore"].splitlines()


def test_the_readme_names_every_file():
    texts = scaffold_texts()
    documents = [name for name in texts if name.endswith(".yaml") and name.count("/") == 1]

    assert [name for name in documents if f"`{name}`" not in texts["README.md"]] == []


def test_all_rules_pass(tmp_path):
    write_scaffold(tmp_path)
    findings = load_project(tmp_path).check()

    assert {finding.rule for finding in findings} <= {"review.missing"}


def test_the_same_bytes_every_time(tmp_path):
    for name in ("one", "two"):
        write_scaffold(tmp_path / name)

    files = [path for path in sorted((tmp_path / "one").rglob("*")) if path.is_file()]
    assert len(files) == 33
    for path in files:
        assert path.read_bytes() == (tmp_path / "two" / path.relative_to(tmp_path / "one")).read_bytes()


def test_header_lines():
    kind = kind_of("scenes/grippers/a.yaml", {"azimuths": []})

    assert schema_reference("scenes/grippers/a.yaml", kind) == "../../schemas/gripper.schema.json"
    assert with_header("a: 1\n", "s.json") == "# yaml-language-server: $schema=s.json\na: 1\n"
    assert with_header(with_header("a: 1\n", "old.json"), "s.json") == with_header("a: 1\n", "s.json")
    assert with_header("", "s.json") == "# yaml-language-server: $schema=s.json\n"
    assert with_header("# yaml-language-server: $schema=old.json", "s.json") == with_header("", "s.json")


def test_a_disk_that_fills_leaves_nothing_of_a_new_project(tmp_path, monkeypatch):
    kept = tmp_path / "there" / "mine.txt"
    kept.parent.mkdir()
    kept.write_text("mine")
    opened, at_once = Path.open, itertools.count()

    def fills(self, mode="r", *more, **named):
        if "x" in mode and next(at_once) == 5:
            raise OSError(errno.ENOSPC, "No space left on device", str(self))
        return opened(self, mode, *more, **named)

    monkeypatch.setattr(Path, "open", fills)
    for folder in (tmp_path / "there", tmp_path / "new" / "project"):
        at_once = itertools.count()
        with pytest.raises(StorageError, match="cannot be written: No space left on device"):
            write_scaffold(folder)
    assert [path for path in tmp_path.rglob("*") if path.is_file()] == [kept]
    assert not (tmp_path / "new").exists()
    at_once = itertools.count(6)
    assert write_scaffold(tmp_path / "new" / "project")
