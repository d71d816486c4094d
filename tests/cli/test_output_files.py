"""Every verb that writes a file leaves the project's sources alone and follows links."""

from __future__ import annotations

import errno
import os
import stat
import subprocess
import sys

import pytest

from rgss.cli.output import shown_path

WRITING = {
    "export csv": ("export", "csv", "-o", "{}/requirements/system/2-gripper.yaml"),
    "export xlsx": ("export", "xlsx", "-o", "{}/scenes/restaurant.yaml"),
    "export reqif": ("export", "reqif", "-o", "{}/designs/catalogue.yaml"),
    "export sysml": ("export", "sysml", "-o", "{}/studies/pick_place.yaml"),
    "export ompl": ("export", "ompl", "-o", "{}/requirements/measures.yaml"),
    "trace": ("trace", "-o", "{}/studies/notes.md"),
    "trace into a folder": ("trace", "--format", "md", "-o", "{}/studies"),
    "report": ("report", "-o", "{}/studies/page.html"),
    "run --plots": ("run", "28", "--plots", "{}/scenes/texture.png"),
    "evidence export": ("evidence", "export", "{}/studies/table.csv"),
    "regress --junit": ("regress", "--junit", "{}/studies/pick_place.baseline.json"),
    "regress --markdown": ("regress", "--markdown", "{}/studies/notes.md"),
}
ADDED = ("studies/notes.md", "studies/trace.md", "studies/page.html", "studies/table.csv", "scenes/texture.png")


@pytest.fixture
def project(folder):
    for name in ADDED:
        (folder / name).write_text("written by hand\n")
    return folder


@pytest.mark.parametrize("words", WRITING.values(), ids=WRITING)
def test_a_source_of_the_project_is_refused_in_one_line(rgss, project, words):
    before = {path: path.read_bytes() for path in project.rglob("*") if path.is_file()}
    told = rgss(*[word.format(project) for word in words], "--project", project)

    assert told.status == 2
    assert "is a source of the project and is not overwritten" in told.complaint
    removable = "" if words[-1].endswith(".yaml") else "; to replace this one, remove it first"
    assert told.complaint.endswith(f"(name another file{removable})")
    assert {path: path.read_bytes() for path in project.rglob("*") if path.is_file()} == before


@pytest.mark.parametrize(
    "words",
    [
        ("export", "sysml", "-o", "{}/requirements/architecture/model.yaml"),
        ("export", "reqif", "-o", "{}/.rgss/import.json"),
    ],
    ids=lambda words: words[1],
)
def test_a_new_file_that_would_be_a_source_is_refused_in_one_line(rgss, project, words):
    before = {path: path.read_bytes() for path in project.rglob("*") if path.is_file()}
    told = rgss(*[word.format(project) for word in words], "--project", project)

    assert told.status == 2
    assert "would be read as a source of the project, and is not written" in told.complaint
    assert {path: path.read_bytes() for path in project.rglob("*") if path.is_file()} == before


def test_a_schema_does_not_take_the_place_of_a_source(rgss, project):
    (project / "scenes" / "scene.schema.json").write_text("{}")
    told = rgss("schema", "scene", "--out", project / "scenes")

    assert told.status == 2
    assert "scenes/scene.schema.json is a source of the project" in told.complaint


WRITERS = {
    "export": ("export", "csv", "-o", "{}.csv"),
    "trace": ("trace", "--table", "coverage", "-o", "{}.csv"),
}


@pytest.mark.parametrize("words", WRITERS.values(), ids=WRITERS)
def test_links_are_followed_and_pipes_written_to(rgss, untouched, tmp_path, words):
    plain, link, pipe = tmp_path / "plain.csv", tmp_path / "link.csv", tmp_path / "pipe.csv"
    link.symlink_to("target.csv")
    os.mkfifo(pipe)
    reader = os.open(pipe, os.O_RDONLY | os.O_NONBLOCK)
    try:
        for path in (plain, link, pipe):
            told = rgss(*[word.format(path.with_suffix("")) for word in words], "--project", untouched)
            assert (told.status, told.errors) == (0, "")
        piped = os.read(reader, 1_000_000)
    finally:
        os.close(reader)

    assert link.is_symlink()
    assert stat.S_ISFIFO(pipe.stat().st_mode)
    content = plain.read_bytes()
    assert (tmp_path / "target.csv").read_bytes() == content
    # A pipe of which nobody reads takes 64 KiB, so this test has outputs that fit.
    assert piped == content
    assert not list(tmp_path.glob(".*"))


def test_an_export_to_standard_output_is_alone_there(rgss_process, untouched, tmp_path):
    assert rgss_process("export", "csv", "-o", tmp_path / "a.csv", "--project", untouched).returncode == 0
    told = rgss_process("export", "csv", "-o", "/dev/stdout", "--project", untouched, encoding="utf-8")

    assert told.returncode == 0
    assert told.stdout.splitlines() == (tmp_path / "a.csv").read_text(encoding="utf-8").splitlines()
    assert told.stderr.endswith("written to /dev/stdout\n")


def test_a_file_on_a_full_disk_is_a_failure_of_the_run(rgss, folder):
    told = rgss("export", "csv", "-o", "/dev/full", "--project", folder)
    assert told.status == 3
    assert "cannot be written: No space left on device (free some space, or check the disk)" in told.complaint


@pytest.mark.parametrize(
    ("number", "status", "complaint"),
    [
        (errno.ENOSPC, 3, "x.yaml cannot be written: No space left on device (free some space, or check the disk)"),
        (errno.EACCES, 2, "x.yaml may not be read or written (change its permissions)"),
    ],
)
def test_so_it_is_where_no_verb_expects_it(rgss, folder, monkeypatch, number, status, complaint):
    def fails(_):
        raise OSError(number, os.strerror(number), "x.yaml")

    monkeypatch.setattr("rgss.cli.verbs.variants.run", fails)
    monkeypatch.setattr("rgss.cli.main._discard_output", lambda: None)
    told = rgss("variants", "--project", folder)
    assert (told.status, told.complaint) == (status, f"rgss: {complaint}")


def test_a_current_folder_that_was_removed_does_not_matter_to_a_project_that_is_named(rgss, folder, monkeypatch):
    def gone():
        raise FileNotFoundError(2, "No such file or directory")

    monkeypatch.setattr("pathlib.Path.cwd", gone)
    told = rgss("variants", "--project", folder)
    assert (told.status, told.errors) == (0, "")
    assert shown_path(folder / "studies") == str(folder / "studies")


@pytest.mark.parametrize("words", [[], ["variants"]])
def test_a_current_folder_that_was_removed_is_told_where_the_project_is_looked_for(tmp_path, words):
    here = tmp_path / "gone"
    here.mkdir()
    script = 'rmdir "$PWD" && exec "$@"'
    command = ["sh", "-c", script, "sh", sys.executable, "-m", "rgss.cli.main", *words]
    told = subprocess.run(command, cwd=here, capture_output=True, text=True, check=False)
    assert told.returncode == 2
    assert told.stderr == "rgss: the current folder no longer exists (go into one that does)\n"
