"""Files read piece by piece, and what is no file."""

from __future__ import annotations

import hashlib
import os
import tracemalloc

import pytest

from rgss.documents.regular_file import chunks_of, open_regular
from rgss.errors import EvidenceError
from rgss.evidence.records import origin
from rgss.evidence.records.origin import file_digests
from rgss.trace.evidence.software import _text_digest

MIB = 1024 * 1024


def test_what_has_no_end_is_refused_at_once(tmp_path):
    os.mkfifo(tmp_path / "pipe")
    (tmp_path / "link").symlink_to("/dev/zero")
    for path, problem in (
        (tmp_path / "pipe", "not a regular file"),
        (tmp_path / "link", "not a regular file"),
        (tmp_path, "Is a directory"),
        (tmp_path / "none", "No such file or directory"),
    ):
        with pytest.raises(OSError, match=problem) as caught, open_regular(path):
            pass
        assert caught.value.strerror == problem


def test_a_digest_of_a_large_file_takes_little_memory(tmp_path):
    (tmp_path / "scenes").mkdir()
    with (tmp_path / "scenes" / "cloud.bin").open("wb") as file:
        # Without blocks on the disk.
        file.truncate(300 * MIB)
    tracemalloc.start()
    digests = file_digests(tmp_path, ["scenes"])
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    expected = hashlib.sha256()
    for _ in range(300):
        expected.update(bytes(MIB))
    assert digests == {"scenes/cloud.bin": expected.hexdigest()}
    assert peak < 8 * MIB


def test_a_file_beyond_the_limit_is_refused_in_one_line(tmp_path, monkeypatch):
    monkeypatch.setattr(origin, "LARGEST_FILE_BYTES", 2 * MIB)
    path = tmp_path / "mesh.stl"
    path.write_bytes(b"x" * (2 * MIB))
    assert [*file_digests(tmp_path, ["mesh.stl"])] == ["mesh.stl"]
    path.write_bytes(b"x" * (2 * MIB + 1))
    with pytest.raises(EvidenceError) as caught:
        file_digests(tmp_path, ["mesh.stl"])
    assert caught.value.message == ("the input file mesh.stl cannot be read: larger than the 2 MiB that are read")


def test_a_device_among_the_inputs_is_no_input(tmp_path):
    (tmp_path / "scenes").mkdir()
    (tmp_path / "scenes" / "zero.yaml").symlink_to("/dev/zero")
    os.mkfifo(tmp_path / "scenes" / "pipe.yaml")
    assert file_digests(tmp_path, ["scenes"]) == {}
    # Named by itself it cannot be left out.
    with pytest.raises(EvidenceError, match="cannot be read: not a regular file"):
        file_digests(tmp_path, ["scenes/zero.yaml"])


@pytest.mark.parametrize("size", [0, 1, 3, MIB - 1, MIB, MIB + 1, 2 * MIB + 1])
def test_ends_of_lines_are_alike_wherever_the_pieces_are_cut(tmp_path, size):
    path = tmp_path / "text.py"
    for text in (b"a\r\n", b"\r", b"\r\r\n", b"\n\r", b"ab\r\nc\r"):
        content = (text * (size // len(text) + 1))[:size]
        path.write_bytes(content)
        assert _text_digest(path) == hashlib.sha256(content.replace(b"\r\n", b"\n")).digest()
    assert b"".join(chunks_of(path, largest=size)) == content
