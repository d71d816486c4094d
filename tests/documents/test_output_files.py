"""Output files are replaced as a whole or not at all, and only where a user would expect it."""

from __future__ import annotations

import errno
import os
import stat
import subprocess
import sys
from pathlib import Path

import pytest

from rgss.documents.output_files import (
    SourceOverwriteError,
    replaced_file,
    require_no_source,
    why_not_writable,
    write_output,
)
from rgss.errors import DefinitionError, StorageError


def test_the_new_file_takes_the_place_of_the_old(tmp_path):
    path = tmp_path / "a.png"
    path.write_bytes(b"old")
    with replaced_file(path) as part:
        part.write_bytes(b"new")
        assert path.read_bytes() == b"old"
        assert part.parent == tmp_path

    assert path.read_bytes() == b"new"
    assert [entry.name for entry in tmp_path.iterdir()] == ["a.png"]


def test_after_a_failure_the_old_file_is_as_it_was(tmp_path):
    path = tmp_path / "a.png"
    path.write_bytes(b"old")

    def interrupted(part):
        part.write_bytes(b"half")
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt), replaced_file(path) as part:
        interrupted(part)

    assert path.read_bytes() == b"old"
    assert [entry.name for entry in tmp_path.iterdir()] == ["a.png"]


def test_an_interruption_as_the_new_file_is_created_leaves_nothing(tmp_path, monkeypatch):
    """It comes once the file exists, and before anything knows of it."""
    close = os.close

    def interrupted(descriptor):
        close(descriptor)
        raise KeyboardInterrupt

    monkeypatch.setattr(os, "close", interrupted)
    with pytest.raises(KeyboardInterrupt):
        write_output(tmp_path / "report.html", b"new")
    assert not list(tmp_path.iterdir())


def test_a_folder_that_is_gone_is_an_error_of_the_system(tmp_path):
    with pytest.raises(FileNotFoundError), replaced_file(tmp_path / "none" / "a.png"):
        pass


def test_a_file_can_be_read_by_whom_the_mask_allows(tmp_path):
    path = tmp_path / "a.png"
    old = os.umask(0o022)
    try:
        with replaced_file(path) as part:
            part.write_bytes(b"new")
    finally:
        os.umask(old)

    assert path.stat().st_mode & 0o777 == 0o644


def test_what_can_be_written_is_left_alone(tmp_path):
    path = tmp_path / "a.png"
    path.write_bytes(b"old")

    assert why_not_writable(path) == ""
    assert why_not_writable(tmp_path / "new.png") == ""
    assert [entry.name for entry in tmp_path.iterdir()] == ["a.png"]
    assert path.read_bytes() == b"old"


def test_reasons(tmp_path):
    file = tmp_path / "file"
    file.touch()

    assert why_not_writable(tmp_path) == "it is a folder"
    assert why_not_writable(tmp_path / "none" / "a.png") == f"there is no folder {tmp_path / 'none'}"
    assert why_not_writable(file / "a.png") == f"there is no folder {file}"
    assert why_not_writable(tmp_path / ("a" * 300)) == "File name too long"


def test_a_link_is_followed_and_stays(tmp_path):
    (tmp_path / "there").mkdir()
    target, link = tmp_path / "there" / "target.csv", tmp_path / "link.csv"
    target.write_bytes(b"old")
    (tmp_path / "middle").symlink_to("there/target.csv")
    link.symlink_to("middle")
    before = target.stat().st_ino
    write_output(link, b"new")

    assert link.is_symlink()
    assert target.read_bytes() == b"new"
    assert target.stat().st_ino != before, "it was not replaced as a whole"
    assert sorted(each.name for each in tmp_path.rglob("*")) == ["link.csv", "middle", "target.csv", "there"]


def test_a_link_to_what_is_not_there_yet(tmp_path):
    link = tmp_path / "link"
    link.symlink_to("new.csv")
    write_output(link, b"new")

    assert link.is_symlink()
    assert (tmp_path / "new.csv").read_bytes() == b"new"


def test_a_circle_of_links_is_one_line(tmp_path):
    (tmp_path / "a").symlink_to("b")
    (tmp_path / "b").symlink_to("a")

    with pytest.raises(DefinitionError, match="cannot be written: Too many levels of symbolic links"):
        write_output(tmp_path / "a", b"new")


def test_a_pipe_is_written_to_and_stays(tmp_path):
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    # An open reader, so that opening the pipe for writing does not wait.
    reader = os.open(pipe, os.O_RDONLY | os.O_NONBLOCK)
    try:
        write_output(pipe, b"new")
        assert os.read(reader, 10) == b"new"
    finally:
        os.close(reader)

    assert stat.S_ISFIFO(pipe.stat().st_mode)
    assert [each.name for each in tmp_path.iterdir()] == ["pipe"]


def test_a_device_is_written_to_and_stays(tmp_path):
    link = tmp_path / "device"
    link.symlink_to("/dev/null")
    write_output(link, b"new")
    write_output(Path("/dev/null"), b"new")

    assert link.is_symlink()
    assert stat.S_ISCHR(Path("/dev/null").stat().st_mode)


def test_a_full_device_is_a_failure_of_the_disk():
    with pytest.raises(StorageError, match="/dev/full cannot be written: No space left on device"):
        write_output(Path("/dev/full"), b"new")


def test_an_open_descriptor_is_written_to(tmp_path):
    with (tmp_path / "open").open("w+b") as file:
        write_output(Path(f"/proc/self/fd/{file.fileno()}"), b"new")
        file.seek(0)
        assert file.read() == b"new"


def test_standard_output_is_written_to_behind_what_was_printed(tmp_path):
    code = (
        "import sys; from pathlib import Path; from rgss.documents.output_files import write_output\n"
        "print('before'); write_output(Path('/dev/stdout'), b'new\\n'); print('behind')"
    )
    with (tmp_path / "out").open("wb") as file:
        subprocess.run([sys.executable, "-c", code], check=True, stdout=file)
    piped = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True)

    assert (tmp_path / "out").read_bytes() == piped.stdout == b"before\nnew\nbehind\n"


def test_permissions_of_the_old_file_are_kept(tmp_path):
    path = tmp_path / "a.csv"
    path.write_bytes(b"old")
    path.chmod(0o640)
    write_output(path, b"new")

    assert path.stat().st_mode & 0o777 == 0o640


def test_a_file_with_two_names_has_the_new_content_under_both(tmp_path):
    path, other = tmp_path / "a.csv", tmp_path / "b.csv"
    for old, new in ((b"old", b"longer than the old"), (b"longer than the new", b"new")):
        path.write_bytes(old)
        if not other.exists():
            os.link(path, other)
        with replaced_file(path) as part:
            part.write_bytes(new)
            assert other.read_bytes() == old

        assert (path.read_bytes(), other.read_bytes()) == (new, new)
    assert path.samefile(other)
    assert sorted(entry.name for entry in tmp_path.iterdir()) == ["a.csv", "b.csv"]


def test_a_full_disk_leaves_a_file_with_two_names_as_it_was(tmp_path, monkeypatch):
    path = tmp_path / "a.csv"
    path.write_bytes(b"old")
    os.link(path, tmp_path / "b.csv")

    def full(descriptor, offset, length):
        os.ftruncate(descriptor, offset + length)
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr(os, "posix_fallocate", full)
    with pytest.raises(StorageError, match=r"a\.csv cannot be written: No space left on device"):
        write_output(path, b"longer than the old")
    assert path.read_bytes() == b"old"


def test_extended_attributes_are_kept(tmp_path, monkeypatch):
    """Not every file system has them, so those of the old file are made up."""
    path = tmp_path / "a.csv"
    path.write_bytes(b"old")
    before, given = path.stat().st_ino, {}
    monkeypatch.setattr(os, "listxattr", lambda _: ["user.rgss"], raising=False)
    monkeypatch.setattr(os, "getxattr", lambda _, name: f"value of {name}".encode(), raising=False)
    monkeypatch.setattr(os, "setxattr", lambda _, name, value: given.update({name: value}), raising=False)
    write_output(path, b"new")
    assert path.read_bytes() == b"new"
    assert path.stat().st_ino != before
    assert given == {"user.rgss": b"value of user.rgss"}


def test_a_file_whose_owner_cannot_be_kept_is_written_in_place(tmp_path, monkeypatch):
    path = tmp_path / "a.csv"
    path.write_bytes(b"old")
    before = path.stat().st_ino

    def refused(*_):
        raise PermissionError(errno.EPERM, os.strerror(errno.EPERM))

    monkeypatch.setattr(os, "chown", refused)
    write_output(path, b"new")
    assert (path.read_bytes(), path.stat().st_ino) == (b"new", before)


def test_a_file_that_is_read_only_stays(tmp_path, monkeypatch):
    path = tmp_path / "a.csv"
    path.write_bytes(b"old")
    # In place of chmod, which does not bind root.
    monkeypatch.setattr("os.access", lambda file, mode: Path(file) != path)

    with pytest.raises(DefinitionError, match="Permission denied"):
        write_output(path, b"new")
    assert path.read_bytes() == b"old"


@pytest.fixture
def project(tmp_path):
    for name in ("requirements", "designs", "scenes", "studies", "tests", ".rgss"):
        (tmp_path / "project" / name).mkdir(parents=True)
    return tmp_path / "project"


SOURCES = (
    "requirements/system.yaml",
    "designs/parts/gripper.urdf",
    "scenes/cup.stl",
    "studies/trade_off.ipynb",
    "tests/test_it.py",
    ".rgss/evidence.sqlite",
    ".rgss/verdicts.json",
    ".rgss/import.json",
)


def test_a_source_that_has_another_name_outside_is_refused(project, tmp_path, monkeypatch):
    source, output = project / "requirements/system.yaml", tmp_path / "out.csv"
    source.write_bytes(b"old")
    os.link(source, output)
    monkeypatch.chdir(project / "studies")

    for refusing in (why_not_writable, require_no_source, lambda path: write_output(path, b"new")):
        with pytest.raises(SourceOverwriteError, match=r"requirements/system\.yaml is a source .* \(through the link"):
            refusing(output)
    assert source.read_bytes() == b"old"


@pytest.mark.parametrize("name", SOURCES)
@pytest.mark.parametrize("linked", [False, True], ids=["named", "linked"])
def test_a_source_of_a_project_is_refused(project, tmp_path, name, linked):
    source = project / name
    source.parent.mkdir(exist_ok=True)
    source.write_bytes(b"old")
    output = tmp_path / "link" if linked else source
    if linked:
        output.symlink_to(source)

    for refusing in (why_not_writable, require_no_source, lambda path: write_output(path, b"new")):
        with pytest.raises(SourceOverwriteError) as told:
            refusing(output)
        assert told.value.message.startswith(f"{name} is a source of the project and is not overwritten")
        may_be_removed = not name.endswith(".yaml") and name.startswith(("designs", "scenes", "studies"))
        assert told.value.hint == "name another file" + "; to replace this one, remove it first" * may_be_removed
    assert source.read_bytes() == b"old"
    assert not list(project.rglob("*.part"))

    write_output(output, b"new", replace_source=True)
    assert source.read_bytes() == b"new"


@pytest.mark.parametrize("name", ["studies/new.csv", "report.html", ".rgss/junit.xml", "tests/data.csv"])
def test_what_no_project_reads_is_no_source(project, name):
    write_output(project / name, b"new")
    if not name.startswith("studies"):
        write_output(project / name, b"newer")

    assert (project / name).exists()


@pytest.mark.parametrize(
    "name",
    ["requirements/model.yaml", "studies/a/b.yml", "tests/test_new.py", ".rgss/import.json", ".rgss/verdicts.json"],
)
@pytest.mark.parametrize("linked", [False, True], ids=["named", "linked"])
def test_a_new_file_that_the_project_would_read_is_refused(project, tmp_path, name, linked):
    source = project / name
    source.parent.mkdir(exist_ok=True, parents=True)
    output = tmp_path / "link" if linked else source
    if linked:
        output.symlink_to(source)

    for refusing in (why_not_writable, require_no_source, lambda path: write_output(path, b"new")):
        with pytest.raises(SourceOverwriteError) as told:
            refusing(output)
        assert told.value.message == f"{name} would be read as a source of the project, and is not written"
    assert not [path for path in project.rglob("*") if path.is_file()]

    write_output(output, b"new", new_source=True)
    assert source.read_bytes() == b"new"
    with pytest.raises(SourceOverwriteError, match="is not overwritten"):
        write_output(output, b"newer", new_source=True)


def test_a_folder_called_requirements_makes_no_project(tmp_path):
    (tmp_path / "requirements").mkdir()
    (tmp_path / "requirements" / "a.yaml").write_bytes(b"old")
    write_output(tmp_path / "requirements" / "a.yaml", b"new")

    assert (tmp_path / "requirements" / "a.yaml").read_bytes() == b"new"
