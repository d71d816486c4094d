"""``rgss verify``: records by a person, and where they are shown."""

from __future__ import annotations

import json
import shutil

import pytest

from tests.fixtures.shipped_project import copy_project

STATED = ("--result", "not-met", "--by", "A. Reader", "--on", "2026-05-12")


@pytest.fixture
def project(tmp_path):
    return copy_project(tmp_path / "project")


def test_a_record_is_written_shown_weighed_and_withdrawn(rgss, project):
    (project / "protocol.md").write_text("It is 3 kg.\n", encoding="utf-8")
    told = rgss("verify", "SYS-003", *STATED, "--file", "protocol.md", "--note", "Weighed.", "--project", project)
    assert (told.status, told.errors) == (0, "")
    assert told.output.startswith("Recorded not met of SYS-003; ")
    assert told.output.endswith("verifications.yaml has 1 record.\n")

    words = "not met by A. Reader on 2026-05-12 (protocol.md): Weighed."
    chain = rgss("trace", "SYS-003", "--project", project).output
    assert f"is verified by record of SYS-003 [{words}]" in chain
    rows = {row["requirement"]: row for row in rgss("trace", "--json", "--project", project).document["verification"]}
    assert rows["SYS-003"]["record"] == {
        "result": "not_met",
        "by": "A. Reader",
        "date": "2026-05-12",
        "note": "Weighed.",
        "files": ["protocol.md"],
        "stale_causes": [],
        "changed_files": [],
    }
    assert rows["SYS-003"]["verdict"] == "not_met"
    assert rows["SYS-004"]["record"] is None
    assert "SYS-003" in rgss("trace", "SYS-003", "--impact", "--json", "--project", project).document["records"]

    page = project / "trace.html"
    assert rgss("trace", "-o", page, "--project", project).status == 0
    assert words in page.read_text(encoding="utf-8")

    found = rgss("check", "--evidence", "--project", project).output
    assert "'SYS-003' is not met, as A. Reader found on 2026-05-12" in found

    (project / "protocol.md").write_text("It is 2 kg.\n", encoding="utf-8")
    found = rgss("check", "--evidence", "--project", project).output
    assert "'SYS-003' was verified by A. Reader before: the files have changed since (protocol.md)" in found
    chain = rgss("trace", "SYS-003", "--project", project).output
    assert f"[stale, since protocol.md has changed or is gone: {words[:20]}" in chain

    told = rgss("verify", "SYS-003", "--withdraw", "--json", "--project", project)
    assert {**told.document, "file": ""} == {"verified": ["SYS-003"], "result": None, "file": ""}
    assert "record of" not in rgss("trace", "SYS-003", "--project", project).output


def test_a_set_of_requirements_is_named_by_its_study(rgss, project):
    cell = project / "requirements/cell"
    cell.mkdir()
    for name in ("system", "architecture"):
        shutil.copytree(project / "requirements" / name, cell / name)
    shutil.copy(project / "requirements/stakeholder.yaml", cell)
    study = project / "studies/cell.yaml"
    study.write_text("study: cell\nrequirements: requirements/cell\n", encoding="utf-8")
    assert rgss("verify", "SYS-003", *STATED, "--study", "cell", "--project", project).status == 0
    assert not (project / "requirements/verifications.yaml").exists()
    assert "SYS-003:" in (cell / "verifications.yaml").read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("words", "complaint"),
    [
        (("SYS-003",), "--result and --by and --on are missing"),
        (("SYS-003", "--result", "met", "--by", "A. Reader"), "--on is missing"),
        (("SYS-003", *STATED, "--withdraw"), "--withdraw and --result exclude each other"),
        (("SYS-003", "--note", "It is.", "--withdraw"), "--withdraw and --note exclude each other"),
        (("SYS-003", "--withdraw"), "'SYS-003' has no verification record"),
        (("SYS-3", *STATED), "'SYS-3' is not a system requirement (did you mean"),
        (("SYS-003", *STATED, "--file", "gone.md"), "'gone.md' cannot be read: No such file or directory"),
    ],
)
def test_what_cannot_be_recorded_is_refused_in_one_line(rgss, project, words, complaint):
    told = rgss("verify", *words, "--project", project)
    assert told.status == 2
    assert complaint in told.complaint
    assert not (project / "requirements/verifications.yaml").exists()


def test_the_schema_of_the_file_is_listed(rgss):
    assert json.loads(rgss("schema", "verifications").output)["title"] == "Verification records"
