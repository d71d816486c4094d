"""An import that is killed between two files is undone by the next one."""

from __future__ import annotations

import base64
import errno
import json
import os
import re
import signal
import subprocess
import sys
from dataclasses import replace

import pytest

from rgss.documents import write_output
from rgss.errors import DefinitionError, StorageError
from rgss.exchange import applying, journal
from rgss.exchange.applying import written
from rgss.exchange.journal import contents_of, has_journal, importing, journal_of, undone, was_interrupted
from rgss.exchange.tables import csv_text

KILLED = """
import os, signal, sys
from pathlib import Path
import rgss.exchange.applying as applying
from rgss.exchange.comparison import ImportDefaults, compare
from rgss.exchange.content import content_of
from rgss.exchange.tables import read_csv
from rgss.requirements import load_requirements

folder = Path(sys.argv[1])
requirements = load_requirements(folder / "requirements")
changes = compare(content_of(requirements), read_csv(folder / "t.csv"), ImportDefaults(part=None, defaults={}))
files = applying.planned(folder, requirements, changes, remove=False)
write = applying.write_output

def killed_after(path, content, **options):
    write(path, content, **options)
    os.kill(os.getpid(), signal.SIGKILL)

applying.write_output = killed_after
applying.written(folder, files)
"""


@pytest.fixture
def killed(project):
    """The project after an import of two files that was killed after the first, with the contents before."""
    rows = tuple(replace(row, cells={**row.cells, "owner": "somebody"}) for row in project.content.rows)
    (project.folder / "t.csv").write_text(csv_text(replace(project.content, rows=rows)), encoding="utf-8", newline="")
    before = {path: path.read_bytes() for path in sorted(project.folder.rglob("*.yaml"))}
    ended = subprocess.run([sys.executable, "-c", KILLED, str(project.folder)], check=False, timeout=120)
    assert ended.returncode == -signal.SIGKILL
    assert [path.name for path in before if path.read_bytes() != before[path]] == ["stakeholder.yaml"]
    return project.folder, before


def test_a_killed_import_is_undone(killed):
    folder, before = killed

    assert was_interrupted(folder)
    assert undone(folder) == ("requirements/stakeholder.yaml",)
    assert {path: path.read_bytes() for path in before} == before
    assert not was_interrupted(folder)
    assert undone(folder) == ()


def test_an_undone_import_leaves_no_temporary_file(killed):
    folder, _ = killed
    ended = subprocess.Popen([sys.executable, "-c", ""])
    ended.wait()
    abandoned = folder / "requirements" / f".rgss-{ended.pid}-0.part"
    of_another = [folder / "requirements" / name for name in (f".rgss-{os.getpid()}-0.part", ".rgss-mine-0.part")]
    for path in (abandoned, *of_another):
        path.write_bytes(b"")

    undone(folder)

    assert not abandoned.exists()
    assert all(path.exists() for path in of_another)


def test_an_interruption_while_the_journal_is_written_leaves_none(project, monkeypatch):
    def interrupted(_):
        raise KeyboardInterrupt

    monkeypatch.setattr(os, "fsync", interrupted)
    with (
        pytest.raises(KeyboardInterrupt),
        journal_of(project.folder, {"requirements/system.yaml": (b"old", b"new")}),
    ):
        pytest.fail("no journal is complete")
    assert not (project.folder / ".rgss").exists()


def test_an_interruption_once_all_is_written_leaves_nothing_of_the_import(project, monkeypatch):
    rows = tuple(replace(row, cells={**row.cells, "owner": "somebody"}) for row in project.content.rows)
    files = project.plan(replace(project.content, rows=rows))
    before = {path: path.read_bytes() for path in sorted(project.folder.rglob("*.yaml"))}
    removed = journal._removed
    monkeypatch.setattr(journal, "_removed", lambda *_, **__: (_ for _ in ()).throw(KeyboardInterrupt))

    with pytest.raises(KeyboardInterrupt):
        written(project.folder, files)

    monkeypatch.setattr(journal, "_removed", removed)
    assert {path: path.read_bytes() for path in before} == before


def test_what_was_changed_since_is_kept(killed):
    folder, _ = killed
    path = folder / "requirements" / "stakeholder.yaml"
    mine = path.read_bytes() + b"# mine\n"
    path.write_bytes(mine)

    assert undone(folder) == ()
    assert path.read_bytes() == mine


def test_an_import_that_ends_leaves_no_journal(project):
    rows = tuple(replace(row, cells={**row.cells, "owner": "somebody"}) for row in project.content.rows)
    written(project.folder, project.plan(replace(project.content, rows=rows)))

    assert not (project.folder / ".rgss").exists()


def test_one_import_at_a_time(project):
    with importing(project.folder):
        with pytest.raises(DefinitionError, match="another import writes into this project"), importing(project.folder):
            pass
        with journal_of(project.folder, {"requirements/system.yaml": (b"a", b"b")}):
            assert has_journal(project.folder)
            # It is under way.
            assert not was_interrupted(project.folder)
    assert not has_journal(project.folder)
    with importing(project.folder):
        pass


def test_an_error_after_a_file_is_replaced_leaves_nothing_of_the_import(project, monkeypatch):
    """An interruption comes after the new file has its name, and before that is noted."""
    rows = tuple(replace(row, cells={**row.cells, "owner": "somebody"}) for row in project.content.rows)
    files = project.plan(replace(project.content, rows=rows))
    before = {path: path.read_bytes() for path in sorted(project.folder.rglob("*.yaml"))}

    def interrupted(path, content, **options):
        write_output(path, content, **options)
        if content in {file.new for file in files}:
            raise KeyboardInterrupt

    monkeypatch.setattr(applying, "write_output", interrupted)
    with pytest.raises(KeyboardInterrupt):
        written(project.folder, files)

    assert {path: path.read_bytes() for path in before} == before
    assert not has_journal(project.folder)


def test_what_cannot_be_restored_stays_in_the_journal(project, monkeypatch):
    rows = tuple(replace(row, cells={**row.cells, "owner": "somebody"}) for row in project.content.rows)
    files = project.plan(replace(project.content, rows=rows))
    before = {path: path.read_bytes() for path in sorted(project.folder.rglob("*.yaml"))}
    full = StorageError("no space", hint="free some")

    def fails(path, content, **options):
        if path.name == "system.yaml":
            raise full
        write_output(path, content, **options)

    monkeypatch.setattr(applying, "write_output", fails)
    monkeypatch.setattr(journal, "write_output", lambda *_, **__: (_ for _ in ()).throw(full))
    with pytest.raises(StorageError):
        written(project.folder, files)
    assert was_interrupted(project.folder)

    monkeypatch.undo()
    assert undone(project.folder) == ("requirements/stakeholder.yaml",)
    assert {path: path.read_bytes() for path in before} == before


@pytest.mark.parametrize(("number", "error"), [(errno.ENOSPC, StorageError), (errno.EACCES, DefinitionError)])
def test_a_journal_that_cannot_be_written_is_told_with_its_name(project, monkeypatch, number, error):
    def fails(_descriptor):
        raise OSError(number, os.strerror(number))

    monkeypatch.setattr(os, "fsync", fails)
    with pytest.raises(error, match=r"import\.json cannot be written"), journal_of(project.folder, {}):
        pass
    assert not (project.folder / ".rgss").exists()


def test_a_file_that_was_changed_after_it_was_read_is_not_written(project):
    rows = tuple(replace(row, cells={**row.cells, "owner": "somebody"}) for row in project.content.rows)
    contents = contents_of(project.folder)
    path = project.folder / "requirements" / "stakeholder.yaml"
    path.write_bytes(path.read_bytes() + b"# mine\n")

    with pytest.raises(DefinitionError, match=r"stakeholder\.yaml has changed in the meantime"):
        project.plan(replace(project.content, rows=rows), contents=contents)


@pytest.mark.parametrize(
    "text", [b"", b"{", b"[]", b'{"requirements/system.yaml": 1}', b'{"requirements/a": ["%", "a"]}']
)
def test_an_incomplete_journal_says_that_nothing_was_written(project, text):
    (project.folder / ".rgss").mkdir()
    (project.folder / ".rgss" / "import.json").write_bytes(text)

    assert undone(project.folder) == ()
    assert not was_interrupted(project.folder)


@pytest.mark.parametrize("name", ["../outside.yaml", "requirements/../../outside.yaml", "designs/a.yaml"])
def test_a_journal_changes_requirements_alone(project, name):
    path = project.folder / name
    path.parent.mkdir(exist_ok=True)
    path.write_bytes(b"")
    (project.folder / ".rgss").mkdir()
    (project.folder / ".rgss" / "import.json").write_text(json.dumps({name: ["YQ==", ""]}), encoding="utf-8")

    assert undone(project.folder) == ()
    assert path.read_bytes() == b""


@pytest.mark.parametrize(
    ("old", "new"), [(b"owner: a\n", b"owner: somebody\n"), (b"owner: somebody\n", b"owner: b\n"), (b"a\n", b"b\n")]
)
def test_a_file_that_is_killed_while_it_is_overwritten_in_place_is_restored(project, old, new):
    """A file with two names is overwritten: room is reserved, the content copied, and what is over is cut off."""
    folder, name = project.folder, "requirements/system.yaml"
    coded = [base64.b64encode(content).decode("ascii") for content in (old, new)]
    room = old.ljust(len(new), b"\0")
    for done in range(len(new) + 1):
        (folder / ".rgss").mkdir(exist_ok=True)
        (folder / ".rgss" / "import.json").write_text(json.dumps({name: coded}), encoding="utf-8")
        (folder / name).write_bytes(new[:done] + room[done:])

        undone(folder)

        assert (folder / name).read_bytes() == old, done


@pytest.mark.parametrize("place", [".rgss", ".rgss/import.json"])
@pytest.mark.parametrize("is_link", [False, True])
def test_what_stands_where_the_journal_is_written_is_named(project, place, is_link):
    """It is no import under way, for whose end one would wait for ever."""
    rows = tuple(replace(row, cells={**row.cells, "owner": "somebody"}) for row in project.content.rows)
    path = project.folder / place
    path.parent.mkdir(exist_ok=True)
    if is_link:
        path.symlink_to("nowhere")
    elif place == ".rgss":
        path.touch()
    else:
        path.mkdir()

    with pytest.raises(DefinitionError, match=f"{re.escape(str(path))} is in the way of the import") as refused:
        written(project.folder, project.plan(replace(project.content, rows=rows)))

    assert refused.value.hint == "move it away, and import again"
