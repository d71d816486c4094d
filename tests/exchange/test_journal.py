"""An import that is killed between two files is undone by the next one."""

from __future__ import annotations

import json
import signal
import subprocess
import sys
from dataclasses import replace

import pytest

from rgss.errors import DefinitionError
from rgss.exchange.applying import written
from rgss.exchange.journal import journal_of, undone, was_interrupted
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


def test_an_import_that_is_under_way_is_not_undone(project):
    with journal_of(project.folder, {"requirements/system.yaml": (b"a", b"b")}):
        with pytest.raises(DefinitionError, match="another import writes into this project"):
            undone(project.folder)
        with (
            pytest.raises(DefinitionError, match="another import writes into this project"),
            journal_of(project.folder, {}),
        ):
            pass
    assert not was_interrupted(project.folder)


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
