"""A new project: sound as it is made, and made nowhere where something is."""

from __future__ import annotations

import os
import re
from pathlib import Path

import pytest

from rgss.evidence import EvidenceStore
from rgss.studies.expansion import trial_specs
from rgss.studies.project import load_project
from tests.cli.conftest import made_record
from tests.fixtures.stored_trials import put_trials


def test_a_new_project_is_sound(rgss, tmp_path):
    folder = tmp_path / "my project"
    told = rgss("init", folder)

    assert (told.status, told.errors) == (0, "")
    assert told.output.splitlines()[0].startswith(f"A project of 34 files is in {folder}/; its README.md")
    assert [line.strip().partition("  ")[0] for line in told.output.splitlines()[2:]] == [
        f"cd '{folder}'",
        "rgss check",
        "rgss sweep",
        "rgss trade",
    ]
    checked = rgss("check", "--project", folder)
    assert (checked.status, checked.errors) == (0, "")
    assert ": 0 findings" in checked.output
    assert len(load_project(folder).designs.expand()) == 4


def test_it_has_the_schema_of_every_document(rgss, tmp_path):
    """That of a mapping file among them, which no file of a new project is."""
    rgss("init", tmp_path / "project")
    rgss("schema", "--out", tmp_path / "schemas")
    written = {path.name: path.read_bytes() for path in (tmp_path / "schemas").iterdir()}
    assert {path.name: path.read_bytes() for path in (tmp_path / "project" / "schemas").iterdir()} == written
    assert "mapping.schema.json" in written


def test_its_page_has_a_place_for_the_decision(rgss, tmp_path):
    folder = tmp_path / "project"
    rgss("init", folder)
    project = load_project(folder).with_fidelity("kinematic")
    with EvidenceStore.open(project.evidence) as store:
        put_trials(store, trial_specs(project, variants=project.designs.expand(), seeds=(1, 2)), made_record)
    page = folder / "README.md"
    told = rgss("trade", "--fidelity", "kinematic", "--section", "--into", page, "--project", folder)

    assert (told.status, told.errors) == (0, "")
    assert "is chosen" in page.read_text(encoding="utf-8")
    assert page.read_text(encoding="utf-8").startswith("# A project of rgss")


def test_a_project_in_another_currency_is_decided_in_it(rgss, tmp_path):
    folder = tmp_path / "project"
    assert rgss("init", folder, "--currency", "EUR").status == 0
    checked = rgss("check", "--project", folder)
    assert (checked.status, checked.errors) == (0, "")
    assert ": 0 findings" in checked.output
    project = load_project(folder).with_fidelity("kinematic")
    assert project.designs.catalogue.currency == "EUR"
    with EvidenceStore.open(project.evidence) as store:
        put_trials(store, trial_specs(project, variants=project.designs.expand(), seeds=(1, 2)), made_record)
    told = rgss("trade", "--fidelity", "kinematic", "--project", folder)

    assert "cost <= 43,000 EUR" in told.output
    # Costs are rounded to whole units, and what a step is worth is paid in the cost.
    assert re.search(r"^payload .* \d+ EUR", told.output.partition("paid in more cost")[2], re.MULTILINE)
    assert "USD" not in told.output
    section = rgss("trade", "--fidelity", "kinematic", "--section", "--project", folder).output
    assert "EUR" in section
    assert "USD" not in section


def test_an_amount_in_another_currency_than_the_catalogue_is_refused(rgss, tmp_path):
    folder = tmp_path / "project"
    rgss("init", folder, "--currency", "EUR")
    catalogue = folder / "designs" / "catalogue.yaml"
    catalogue.write_text(catalogue.read_text(encoding="utf-8").replace("450 EUR", "450 USD"), encoding="utf-8")
    told = rgss("check", "--project", folder)

    assert told.status == 2
    assert "cost: USD is another currency than EUR, and none is converted" in told.output
    assert told.output.startswith("designs/catalogue.yaml:40:19: error: ")


@pytest.mark.parametrize(
    ("code", "hint"), [("eur", "did you mean EUR?"), ("euro", "give an ISO 4217 code, such as EUR")]
)
def test_an_unknown_currency_is_refused(rgss, tmp_path, code, hint):
    told = rgss("init", tmp_path / "project", "--currency", code)

    assert told.status == 2
    assert told.complaint == f"rgss: --currency: '{code}' is not the code of a currency ({hint})"
    assert not (tmp_path / "project").exists()


def test_the_files_are_told_as_json(rgss, tmp_path):
    told = rgss("init", tmp_path, "--json")

    there = {path.relative_to(tmp_path).as_posix() for path in tmp_path.rglob("*") if path.is_file()}
    assert told.document["folder"] == str(tmp_path)
    assert set(told.document["files"]) == there
    assert {".gitignore", "README.md", "studies/pick_place.yaml", "schemas/study.schema.json"} <= there


def test_in_the_current_folder(rgss, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "notes.txt").write_text("mine")
    told = rgss("init")

    assert told.status == 0
    assert "cd " not in told.output
    assert (tmp_path / "notes.txt").read_text() == "mine"
    assert rgss("check").status == 0


def test_nothing_is_overwritten(rgss, tmp_path):
    (tmp_path / "README.md").write_text("mine")
    told = rgss("init", tmp_path)

    assert (told.status, told.output) == (2, "")
    assert told.complaint == (
        f"rgss: {tmp_path}/README.md is there already, and nothing is overwritten (name a new folder)"
    )
    assert [path.name for path in tmp_path.iterdir()] == ["README.md"]
    assert (tmp_path / "README.md").read_text() == "mine"


def test_a_second_time(rgss, tmp_path):
    assert rgss("init", tmp_path).status == 0
    told = rgss("init", tmp_path)

    assert told.status == 2
    assert told.complaint == (
        f"rgss: {tmp_path}/README.md and 33 more are there already, and nothing is overwritten (name a new folder)"
    )


def test_a_link_that_leads_nowhere_is_something(rgss, tmp_path):
    (tmp_path / "scenes").symlink_to(tmp_path / "nowhere")
    (tmp_path / "README.md").symlink_to(tmp_path / "nowhere")
    told = rgss("init", tmp_path)

    assert told.status == 2
    assert "README.md is there already" in told.complaint


@pytest.mark.parametrize(
    ("name", "reason"),
    [
        ("file/project", "Not a directory"),
        ("file", "Not a directory"),
        ("x" * 300, "File name too long"),
        ("a\0b", "null"),
    ],
)
def test_a_folder_that_cannot_be(rgss, tmp_path, name, reason):
    (tmp_path / "file").write_text("")
    told = rgss("init", f"{tmp_path}{os.sep}{name}")

    assert (told.status, told.output) == (2, "")
    assert told.complaint.startswith("rgss: cannot write ")
    assert reason in told.complaint
    assert told.complaint.endswith("(choose another place)")


def test_a_project_that_is_there_is_none_to_make(rgss, tmp_path):
    told = rgss("init", "--project", tmp_path)

    assert told.status == 2
    assert told.complaint == f"rgss: --project names an existing project (rgss init {tmp_path})"
    assert list(Path(tmp_path).iterdir()) == []
