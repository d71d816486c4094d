"""Schemas on the command line, and the lines that name them."""

from __future__ import annotations

import json

import pytest
from jsonschema import Draft7Validator

from rgss.cli.verbs.schema import DOCUMENTS
from rgss.documents import read_document
from rgss.exchange import MAPPING_KIND
from rgss.studies.expansion import trial_specs
from rgss.studies.project import load_project
from rgss.studies.schemas.document_kinds import DOCUMENT_KINDS
from rgss.sweep.trial_keys import key_of


def test_the_choices_are_the_kinds():
    assert tuple(kind.id for kind in DOCUMENT_KINDS) == DOCUMENTS[:-1]
    assert MAPPING_KIND.id == DOCUMENTS[-1]


def test_the_kinds_are_listed(rgss):
    told = rgss("schema")

    assert (told.status, told.errors) == (0, "")
    assert [line.split()[0] for line in told.output.splitlines()[2:]] == list(DOCUMENTS)
    assert [entry["id"] for entry in rgss("schema", "--json").document["documents"]] == list(DOCUMENTS)


@pytest.mark.parametrize("document", DOCUMENTS)
def test_a_schema_is_printed(rgss, document):
    told = rgss("schema", document)

    assert (told.status, told.errors) == (0, "")
    Draft7Validator.check_schema(told.document)


def test_schemas_are_written(rgss, tmp_path):
    folder = tmp_path / "a" / "schemas"
    told = rgss("schema", "--out", folder)

    assert told.status == 0
    assert told.output.startswith("20 schemas in ")
    assert {path.name for path in folder.iterdir()} == {f"{name}.schema.json" for name in DOCUMENTS}
    assert json.loads((folder / "scene.schema.json").read_text()) == rgss("schema", "scene").document
    assert rgss("schema", "scene", "--out", tmp_path / "one").output.startswith("1 schema in ")
    assert rgss("schema", "--out", folder, "--json").document["headed"] == []


def test_headers_lead_to_the_schemas(rgss, folder):
    before = [key_of(spec) for spec in trial_specs(load_project(folder))]
    told = rgss("schema", "--out", folder / "schemas", "--headers", "--project", folder)

    documents = list(folder.rglob("*.yaml"))
    assert told.status == 0
    assert f"{len(documents)} documents have a new first line" in told.output
    again = rgss("schema", "--out", folder / "schemas", "--headers", "--project", folder)
    assert again.output.splitlines()[1] == "every document of the project names its schema already"
    for path in documents:
        first = path.read_text(encoding="utf-8").splitlines()[0]
        schema = json.loads((path.parent / first.removeprefix("# yaml-language-server: $schema=")).read_text())
        assert list(Draft7Validator(schema).iter_errors(read_document(path).data)) == []
    assert [key_of(spec) for spec in trial_specs(load_project(folder))] == before
    again = rgss("schema", "--out", folder / "schemas", "--headers", "--project", folder, "--json").document
    assert again["headed"] == []


def test_a_header_is_replaced_and_line_ends_stay(rgss, folder):
    path = folder / "scenes" / "restaurant.yaml"
    content = path.read_bytes().replace(b"\n", b"\r\n")
    path.write_bytes(b"\xef\xbb\xbf# yaml-language-server: $schema=old.json\r\n" + content)
    rgss("schema", "--out", folder / "made", "--headers", "--project", folder)

    assert path.read_bytes() == (b"\xef\xbb\xbf# yaml-language-server: $schema=../made/scene.schema.json\r\n" + content)


def test_a_broken_file_keeps_all_as_they_are(rgss, folder):
    broken = folder / "studies" / "pick_place.yaml"
    broken.write_text("a: [")
    scene = (folder / "scenes" / "restaurant.yaml").read_bytes()
    told = rgss("schema", "--out", folder / "schemas", "--headers", "--project", folder)

    assert (told.status, told.output) == (2, "")
    assert told.errors.startswith("studies/pick_place.yaml:")
    assert (folder / "scenes" / "restaurant.yaml").read_bytes() == scene


@pytest.mark.parametrize(
    ("words", "complaint"),
    [
        (["sceen"], "rgss schema: argument DOCUMENT: invalid choice: 'sceen' (did you mean 'scene'?)"),
        (["--headers"], "rgss: --headers needs --out and no DOCUMENT (rgss schema --out schemas --headers)"),
        (["scene", "--out", "x", "--headers"], "rgss: --headers needs --out and no DOCUMENT (rgss schema"),
        (["--project", "x"], "rgss: --project goes with --headers (omit it; schemas are alike in all projects)"),
        (["--out", "x", "--headers", "--project", "y"], "rgss: 'y' is not a project: it has no folder requirements/"),
        (["--out", "a\0b"], "rgss: cannot write 'a\\x00b': "),
    ],
)
def test_words_that_are_refused(rgss, tmp_path, monkeypatch, words, complaint):
    monkeypatch.chdir(tmp_path)
    told = rgss("schema", *words)

    assert (told.status, told.output) == (2, "")
    assert told.complaint.startswith(complaint)
    assert list(tmp_path.iterdir()) == []


def test_a_folder_that_is_a_file(rgss, tmp_path):
    (tmp_path / "file").write_text("")
    told = rgss("schema", "--out", tmp_path / "file")

    assert told.status == 2
    assert told.complaint == f"rgss: cannot write '{tmp_path}/file': File exists (choose another place)"


def test_a_document_that_cannot_be_written(rgss, folder, monkeypatch):
    def full(path, content):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("pathlib.Path.write_bytes", full)
    told = rgss("schema", "--out", folder / "schemas", "--headers", "--project", folder)

    assert (told.status, told.output) == (3, "")
    assert told.complaint.endswith(
        ".yaml cannot be written: No space left on device (free some space, or check the disk)"
    )
