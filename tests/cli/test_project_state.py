"""`rgss` alone says how the project stands, and what to do next."""

from __future__ import annotations

import pytest

from rgss.cli.main import main


@pytest.fixture
def state(monkeypatch, capsys):
    """A function that gives what is said in a folder, and the status."""

    def of(folder):
        monkeypatch.chdir(folder)
        status = main([])
        said = capsys.readouterr()
        return status, said.out, said.err

    return of


def test_outside_of_a_project_it_says_how_to_begin(state, tmp_path):
    status, said, _ = state(tmp_path)
    assert status == 0
    assert said.startswith("There is no project here or above.\n")
    assert "rgss init my_project" in said


def test_without_evidence_the_sweep_comes_next(state, folder):
    status, said, _ = state(folder / "studies")
    assert status == 0
    assert f"Project {folder.name}: 7 stakeholder and 40 system requirements" in said
    assert "72 variants" in said
    assert said.endswith("No trial has been run.\nNext: rgss sweep    runs the study's trials\n")


def test_with_all_trials_it_says_the_decision(state, with_evidence, rgss):
    status, said, _ = state(with_evidence)
    headline = next(
        line
        for line in rgss("trade", "--brief", "--project", with_evidence).output.splitlines()
        if line.startswith("Variant")
    )
    assert status == 0
    assert "Trials: 216 stored in .rgss/evidence.sqlite\n" in said
    assert headline in said
    assert "Next: rgss trade" in said


def test_missing_trials_are_counted(state, with_evidence, folder):
    (folder / ".rgss").mkdir(exist_ok=True)
    (folder / ".rgss" / "evidence.sqlite").write_bytes((with_evidence / ".rgss" / "evidence.sqlite").read_bytes())
    study = folder / "studies" / "pick_place.yaml"
    text = study.read_text(encoding="utf-8")
    assert "replicates: 3\n" in text
    study.write_text(text.replace("replicates: 3\n", "replicates: 4\n"), encoding="utf-8")
    status, said, _ = state(folder)
    assert status == 0
    assert "Trials: 216 stored in .rgss/evidence.sqlite, 72 missing\nNext: rgss sweep    runs what is missing\n" in said


def test_several_studies_without_the_default_one(state, folder):
    (folder / "studies" / "pick_place.yaml").rename(folder / "studies" / "serving.yaml")
    _, said, _ = state(folder)
    assert "the project has no studies/pick_place.yaml, which is the default (name the study" in said


def test_a_broken_file_is_told_where_it_is(state, folder):
    (folder / "studies" / "pick_place.yaml").write_text("study: [", encoding="utf-8")
    status, _, errors = state(folder)
    assert status == 2
    assert errors.startswith("studies/pick_place.yaml:1:")
