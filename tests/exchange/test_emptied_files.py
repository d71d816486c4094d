"""Files that lose their last element: removed, if they are the project's alone."""

from __future__ import annotations

import os
from dataclasses import replace

import pytest

from rgss.errors import DefinitionError
from rgss.exchange import applying


@pytest.fixture
def divided(project, tmp_path):
    """The project with a folder of two files, of which the second has one requirement, and that file outside of it."""
    path = project.file("system.yaml")
    text = path.read_text(encoding="utf-8")
    start = text.index("  - id: SYS-2")
    path.unlink()
    folder = project.file("system")
    folder.mkdir()
    (folder / "1.yaml").write_text(text[:start], encoding="utf-8")
    (tmp_path / "2.yaml").write_text("requirements:\n" + text[start:], encoding="utf-8")
    return folder / "2.yaml", tmp_path / "2.yaml"


def without_the_last(project):
    return replace(project.content, rows=tuple(row for row in project.content.rows if row.id != "SYS-2"))


def test_a_file_of_the_project_alone_is_removed(project, divided):
    path, outside = divided
    path.write_bytes(outside.read_bytes())
    project.apply(without_the_last(project))
    assert not path.exists()


@pytest.mark.parametrize(("link", "why"), [(os.symlink, "leads to .*2.yaml"), (os.link, "has another name")])
def test_a_file_with_another_name_is_refused(project, divided, link, why):
    path, outside = divided
    link(outside, path)
    before = outside.read_bytes()
    with pytest.raises(DefinitionError, match=rf"system/2\.yaml would lose its last element, .* since it {why}"):
        project.plan(without_the_last(project))
    assert path.is_symlink() is (link is os.symlink)
    assert (path.read_bytes(), project.plan(without_the_last(project), remove=False)) == (before, ())


def test_a_file_of_a_linked_folder_is_refused(project, divided, tmp_path):
    path, outside = divided
    path.write_bytes(outside.read_bytes())
    path.parent.rename(tmp_path / "system")
    path.parent.symlink_to(tmp_path / "system")
    with pytest.raises(DefinitionError, match=r"since it leads to .*system/2\.yaml"):
        project.apply(without_the_last(project))
    assert (tmp_path / "system" / "2.yaml").is_file()


def test_a_write_protected_file_is_not_removed(project, divided, monkeypatch):
    """Its folder can be written, by which the file could be removed."""
    path, outside = divided
    path.write_bytes(outside.read_bytes())
    before = path.read_bytes(), project.file("system/1.yaml").read_bytes()
    access = os.access
    monkeypatch.setattr(applying.os, "access", lambda name, mode: name != path and access(name, mode))
    foreign = without_the_last(project)
    foreign = replace(foreign, rows=tuple(replace(row, cells={**row.cells, "owner": "me"}) for row in foreign.rows))
    with pytest.raises(DefinitionError, match=r"2\.yaml cannot be written: Permission denied"):
        project.apply(foreign)
    assert (path.read_bytes(), project.file("system/1.yaml").read_bytes()) == before


def test_files_are_removed_after_the_others_are_written(project, divided, monkeypatch):
    """If one of those cannot be written, no file has to be made anew, without its permissions."""
    path, outside = divided
    path.write_bytes(outside.read_bytes())
    done = []
    for name in ("write_output", "_removed"):
        monkeypatch.setattr(applying, name, lambda path, *_, **__: done.append(path.name))
    foreign = without_the_last(project)
    rows = (replace(row, cells={**row.cells, "owner": "me"}) for row in foreign.rows)
    path.rename(path.with_name("0.yaml"))
    applying.written(project.folder, project.plan(replace(foreign, rows=tuple(rows))))
    assert done[-1] == "0.yaml"
    assert len(done) > 1
