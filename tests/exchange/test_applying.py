"""Changes written into YAML: what they say, nothing else, all or nothing."""

from __future__ import annotations

import os
import shutil
from dataclasses import replace
from pathlib import Path

import pytest

from rgss.errors import DefinitionError, DocumentError, StorageError
from rgss.exchange.applying import _folder_of, rehearsed, written
from rgss.exchange.comparison import ChangeKind
from rgss.exchange.content import Row
from rgss.requirements import load_requirements


def changed(content, name, **cells):
    """The content of a project with some cells of an element changed."""
    rows = [replace(row, cells={**row.cells, **cells}) if row.id == name else row for row in content.rows]
    return replace(content, rows=tuple(rows))


@pytest.fixture
def before(project):
    return {path: path.read_bytes() for path in sorted(project.folder.rglob("*.yaml"))}


def now(before):
    return {path: path.read_bytes() for path in before}


def test_a_report_names_attributes_before_and_after(project):
    foreign = changed(project.content, "SYS-1", threshold="20 s", derived_from="STK-1; STK-2", owner="boss")
    (change,) = project.compare(foreign)
    assert (change.kind, change.part.value, change.id) == (ChangeKind.CHANGED, "system", "SYS-1")
    assert [(each.attribute.name, each.old, each.new) for each in change.attributes] == [
        ("derived_from", "STK-2", "STK-1; STK-2"),
        ("threshold", "25 s", "20 s"),
        ("owner", "systems engineer", "boss"),
    ]


def test_another_order_of_ids_is_no_change(project):
    assert project.compare(changed(project.content, "SYS-1", satisfied_by="SEQ-lift;BLK-arm")) == ()


def test_only_the_changed_values_are_touched(project, before):
    project.apply(changed(project.content, "SYS-1", threshold="20 s", rationale="New: reasons", derived_from="STK-1"))
    path = project.file("system.yaml")
    old, new = before[path].decode().splitlines(), path.read_text(encoding="utf-8").splitlines()
    assert [line for line in new if line not in old] == [
        '    rationale: "New: reasons"',
        "    derived_from: [STK-1] # the need",
        '    criterion: {measure: t_e, comparison: "<=", threshold: 20 s}',
    ]
    assert len(old) == len(new)
    assert {name for name in before if name.read_bytes() != before[name]} == {path}


def test_a_criterion_goes_and_words_come(project):
    criterion = {"measure": "t_e", "comparison": "<", "threshold": "9 s", "statistic": "high"}
    project.apply(changed(project.content, "SYS-2", **criterion, success="", verification="analysis"))
    assert str(project.requirements.requirement("SYS-2").criterion) == "high(t_e) < 9 s"
    project.apply(changed(project.content, "SYS-2", statistic="value", threshold="-9 s"))
    assert str(project.requirements.requirement("SYS-2").criterion) == "t_e < -9 s"
    gone = dict.fromkeys(criterion, "")
    project.apply(changed(project.content, "SYS-2", **gone, success="It is seen.", verification="inspection"))
    requirement = project.requirements.requirement("SYS-2")
    assert (requirement.criterion, requirement.success) == (None, "It is seen.")


def test_what_is_new_stands_in_the_file_of_its_kind(project):
    folder = project.folder / "requirements" / "system"
    text = project.file("system.yaml").read_text(encoding="utf-8")
    head, second = text.split("  - id: SYS-2")
    folder.mkdir()
    (folder / "1.yaml").write_text(head, encoding="utf-8")
    (folder / "2.yaml").write_text(f"requirements:\n  - id: SYS-2{second}", encoding="utf-8")
    project.file("system.yaml").unlink()
    model = next(row for row in project.content.rows if row.id == "SYS-1")
    new = [
        Row(part=model.part, cells={**model.cells, "id": "SYS-3", "group": "gripper"}),
        Row(part=model.part, cells={**model.cells, "id": "SYS-4", "group": "joint"}),
        Row(part=model.part, cells={**model.cells, "id": "SYS-5", "group": "manipulator"}),
    ]
    foreign = replace(project.content, rows=(*project.content.rows, *new))
    project.apply(foreign)
    assert project.compare(foreign) == ()
    labels = {name: place.document.label for name, place in project.requirements.places.items()}
    assert [labels[f"SYS-{number}"][-6:] for number in range(1, 6)] == [
        "1.yaml",
        "2.yaml",
        "2.yaml",
        "2.yaml",
        "1.yaml",
    ]
    assert "# The end." in (folder / "2.yaml").read_text(encoding="utf-8")


def test_removal_waits_until_it_is_asked_for(project, before):
    foreign = replace(project.content, rows=tuple(row for row in project.content.rows if row.id != "STM-lift"))
    assert project.plan(foreign, remove=False) == ()
    project.apply(foreign, remove=True)
    assert "STM-lift" not in project.file("architecture.yaml").read_text(encoding="utf-8")


def test_details_of_behaviour_are_written(project):
    flow = (
        '{"nodes":[{"id":"s","kind":"initial"},{"id":"a","kind":"action","text":"Close: now"},'
        '{"id":"e","kind":"final"}],"edges":[{"source":"s","target":"a"},{"source":"a","target":"e"}]}'
    )
    foreign = changed(project.content, "ACT-close", flow=flow)
    project.apply(foreign)
    behaviour = project.requirements.element("ACT-close")
    assert [node.text for node in behaviour.flow.nodes] == [None, "Close: now", None]
    assert project.compare(foreign) == ()


def test_a_rehearsal_is_held_in_a_copy(project, before):
    files = project.plan(changed(project.content, "SYS-1", satisfied_by="STK-1"))
    with pytest.raises(DocumentError, match="STK-1"):
        rehearsed(
            project.folder, files, lambda copy: load_requirements(copy / "requirements"), folders=["requirements"]
        )
    assert now(before) == before
    folders = []
    rehearsed(project.folder, files, folders.append, folders=["requirements"])
    assert not folders[0].exists()


def test_what_loading_does_not_read_is_no_part_of_a_rehearsal(project, tmp_path):
    scenes, outside = project.folder / "scenes", tmp_path / "outside"
    (scenes / "inner").mkdir(parents=True)
    outside.mkdir()
    (outside / "mesh.stl").write_text("mesh", encoding="utf-8")
    (scenes / "inner" / "a.yaml").write_text("a", encoding="utf-8")
    (scenes / "dangling").symlink_to("nowhere")
    (scenes / "inner" / "loop").symlink_to("..")
    (scenes / "project").symlink_to("..")
    (scenes / "itself").symlink_to("itself")
    (scenes / "file").symlink_to("inner/a.yaml")
    (scenes / "folder").symlink_to(outside)
    os.mkfifo(scenes / "pipe")
    files = project.plan(changed(project.content, "SYS-1", owner="boss"))
    found = {}

    def check(copy):
        for path in sorted((copy / "scenes").rglob("*")):
            if path.is_file():
                assert not path.is_symlink()
                found[path.relative_to(copy).as_posix()] = path.read_text(encoding="utf-8")
        assert load_requirements(copy / "requirements").requirement("SYS-1").owner == "boss"

    rehearsed(project.folder, files, check, folders=["requirements", "scenes", "studies"])
    assert found == {"scenes/file": "a", "scenes/folder/mesh.stl": "mesh", "scenes/inner/a.yaml": "a"}


def test_a_copy_that_cannot_be_written_is_said_in_one_line(project, monkeypatch):
    def full(source, target):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("shutil.copyfileobj", full)
    with pytest.raises(DefinitionError, match=r"in which an import is checked, cannot be written: No space left"):
        rehearsed(project.folder, (), lambda copy: None, folders=["requirements"])


def test_a_file_that_changed_in_the_meantime_is_left_alone(project, before):
    files = project.plan(changed(changed(project.content, "SYS-1", owner="a"), "STK-1", owner="b"))
    assert [file.name for file in files] == ["requirements/stakeholder.yaml", "requirements/system.yaml"]
    path = project.file("system.yaml")
    path.write_bytes(before[path] + b"# mine\n")
    with pytest.raises(DefinitionError, match=r"requirements/system\.yaml has changed in the meantime"):
        written(project.folder, files)
    assert now(before) == {**before, path: before[path] + b"# mine\n"}


def test_if_one_file_cannot_be_written_none_is(project, before, monkeypatch):
    files = project.plan(changed(changed(project.content, "SYS-1", owner="a"), "STK-1", owner="b"))
    real = Path.replace

    def full(self, target):
        if Path(target).name == "system.yaml":
            raise OSError(28, "No space left on device")
        return real(self, target)

    monkeypatch.setattr(Path, "replace", full)
    with pytest.raises(StorageError, match=r"system\.yaml cannot be written: No space left on device"):
        written(project.folder, files)
    assert now(before) == before
    assert not list(project.folder.rglob("*.part"))


def test_byte_order_marks_and_windows_breaks_stay(project):
    path = project.file("system.yaml")
    path.write_bytes(b"\xef\xbb\xbf" + path.read_bytes().replace(b"\n", b"\r\n"))
    project.apply(changed(project.content, "SYS-2", owner="boss"))
    content = path.read_bytes()
    assert content.startswith(b"\xef\xbb\xbf")
    assert b"\n" not in content.replace(b"\r\n", b"")
    assert project.requirements.requirement("SYS-2").owner == "boss"


def test_an_id_of_another_part_and_a_home_that_is_not_there(project, refused):
    rows = [
        replace(row, part=type(row.part)("stakeholder")) if row.id == "SYS-1" else row for row in project.content.rows
    ]
    lines = refused(project.compare, replace(project.content, rows=tuple(rows)))
    assert "'SYS-1' is of part 'system' in the project, not 'stakeholder'" in lines[0]


def test_blocks_find_a_file_where_there_is_none_of_theirs(project):
    foreign = project.content
    text = project.file("architecture.yaml").read_text(encoding="utf-8")
    folder = project.folder / "requirements" / "architecture"
    folder.mkdir()
    blocks, behaviours = text.split("behaviours:")
    (folder / "a.yaml").write_text(blocks, encoding="utf-8")
    (folder / "b.yaml").write_text(f"behaviours:{behaviours}", encoding="utf-8")
    project.file("architecture.yaml").unlink()
    assert project.compare(foreign) == ()
    shutil.rmtree(folder)
    project.file("architecture.yaml").write_text(blocks, encoding="utf-8")
    for name, gone in (("system.yaml", ", SEQ-lift"), ("system.yaml", ", ACT-close")):
        path = project.file(name)
        path.write_text(path.read_text(encoding="utf-8").replace(gone, ""), encoding="utf-8")
    project.apply(foreign)
    assert project.compare(foreign) == ()
    assert len(project.requirements.architecture.behaviours) == 4


def test_a_file_that_loses_its_last_requirement_goes_with_it(project):
    folder = project.file("system")
    folder.mkdir()
    text = project.file("system.yaml").read_text(encoding="utf-8")
    first, _, second = text.partition("  - id: SYS-2")
    project.file("system.yaml").unlink()
    (folder / "a.yaml").write_text(first, encoding="utf-8")
    (folder / "b.yaml").write_text(f"requirements:\n  - id: SYS-2{second}", encoding="utf-8")
    fewer = replace(project.content, rows=tuple(row for row in project.content.rows if row.id != "SYS-2"))
    files = project.plan(fewer)
    assert [(file.name, file.new) for file in files] == [("requirements/system/b.yaml", None)]
    copies = []
    rehearsed(
        project.folder,
        files,
        lambda copy: copies.append(sorted(path.name for path in copy.rglob("*.yaml"))),
        folders=["requirements"],
    )
    assert copies == [["a.yaml", "architecture.yaml", "stakeholder.yaml"]]
    written(project.folder, files)

    assert [each.id for each in project.requirements.system] == ["SYS-1"]
    assert not (folder / "b.yaml").exists()


def test_the_last_file_of_a_part_stays(project):
    gone = ("SYS-1", "SYS-2")
    rows = tuple(row for row in project.content.rows if row.id not in gone and row.id != "SEQ-lift")
    files = project.plan(replace(project.content, rows=rows))
    (file,) = [each for each in files if each.name == "requirements/system.yaml"]
    assert file.new is not None
    assert b"requirements: []" in file.new


@pytest.mark.parametrize(
    ("name", "folder"),
    [
        ("requirements/system/a.yaml", "requirements/system"),
        ("requirements/system.yaml", "requirements/system.yaml"),
        ("requirements/own/system/a.yaml", "requirements/own/system"),
        ("requirements/own/system.yaml", "requirements/own/system.yaml"),
    ],
)
def test_the_part_of_a_file_is_that_of_its_set(name, folder):
    assert _folder_of(name) == folder
