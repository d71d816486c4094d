"""Files are written whole or not at all."""

from __future__ import annotations

import os

import pytest

from rgss.reports.picture_files import replaced_file, why_not_writable


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
