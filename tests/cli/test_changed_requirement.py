"""A requirement that changed after its evidence is open on every page, by one rule."""

from __future__ import annotations

import re
import shutil

import pytest

OPEN = re.compile(r"are open \(by ([^)]*)\)")


@pytest.fixture
def changed(with_little_evidence, tmp_path, rgss):
    """The project with recorded verdicts, and a requirement whose text changed since."""
    project = tmp_path / "project"
    shutil.copytree(with_little_evidence, project)
    assert rgss("measure", "--project", project, "--record").status == 0
    reword(project)
    return project


def reword(project):
    file = project / "requirements" / "system" / "2-gripper.yaml"
    text = file.read_text(encoding="utf-8")
    assert "at least 0.8 kg" in text
    file.write_text(text.replace("at least 0.8 kg", "not less than 0.8 kg", 1), encoding="utf-8")


def test_every_page_counts_it_as_open(changed, rgss, monkeypatch):
    before = rgss("measure", "--project", changed, "--verdicts").output
    assert "SYS-012" in before
    assert "stale" in before
    said = rgss("trade", "--project", changed, "--brief").output
    (by,) = OPEN.findall(said)
    assert "SYS-012" in by.split(", ")
    standing = next(line for line in said.splitlines() if line.startswith("Requirements of variant"))
    assert "SYS-012 stale" in standing
    stale = "Stale verdicts, which leave designs open, are those on SYS-012. 'rgss measure' says what changed."
    remedy = "'rgss measure --record' gives verdicts by the stored evidence."
    assert f"{stale} {remedy}" in said.splitlines()
    (count, named) = re.search(r"(\d+) open \(([^)]*)\)", standing).groups()
    assert len(named.split(", ")) == int(count)

    document = rgss("trade", "--project", changed, "--brief", "--json").document
    chosen = document["conclusion"]["chosen"]
    assert set(chosen["undecided"]) == {one.split()[0] for one in named.split(", ")}
    assert "SYS-012" in chosen["not_run"]
    monkeypatch.chdir(changed)
    assert OPEN.findall(rgss().output) == [by]
    page = rgss("report", "--no-film", "--json", "--out", changed / "report.html").document["report"]["decision"]
    assert OPEN.findall(page["headline"]) == [by]
    assert standing in page["standing"]
    assert document["conclusion"]["stale"] == f"{stale} {remedy}"
    assert f"{stale} {remedy}" in page["standing"]


def test_the_remedy_that_the_decision_names_gives_verdicts(changed, rgss):
    assert rgss("measure", "--project", changed, "--record").status == 0
    said = rgss("trade", "--project", changed, "--brief").output
    assert "stale" not in said.lower()


def test_a_decision_without_a_choice_names_the_remedy_too(changed, rgss):
    said = rgss("trade", "--project", changed, "--brief", "--what-if", "SYS-004.threshold=1 USD").output
    assert "No variant is chosen" in said
    assert "'rgss measure --record' gives verdicts by the stored evidence." in said


def test_remedies_of_another_study_than_the_default_one_name_it(with_little_evidence, tmp_path, rgss):
    project = tmp_path / "project"
    shutil.copytree(with_little_evidence, project)
    (project / "studies" / "pick_place.yaml").rename(project / "studies" / "cups.yaml")
    assert rgss("measure", "cups", "--project", project, "--record").status == 0
    reword(project)
    said = rgss("trade", "cups", "--project", project, "--brief").output
    remedy = "'rgss measure cups --record' gives verdicts by the stored evidence."
    assert f"'rgss measure cups' says what changed. {remedy}" in said
    assert remedy in rgss("measure", "cups", "--project", project).output
    assert rgss("measure", "cups", "--record", "--project", project).status == 0
    assert "says what changed" not in rgss("trade", "cups", "--project", project, "--brief").output
