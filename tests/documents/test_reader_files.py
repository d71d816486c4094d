"""Files that cannot be read at all, and files made to hurt."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from rgss.documents import read_document, reader
from rgss.documents.composing import DEEPEST_NESTING, Composer
from rgss.errors import DocumentError


def only_finding(path, **arguments):
    with pytest.raises(DocumentError) as caught:
        read_document(path, **arguments)
    (finding,) = caught.value.findings
    return finding


def test_missing_file(tmp_path):
    finding = only_finding(tmp_path / "none.yaml", label="scenes/none.yaml")

    assert str(finding) == "scenes/none.yaml:1:1: error: no such file (check the name and --project) [document.missing]"


def test_file_where_a_folder_is_expected(write):
    finding = only_finding(write("a: 1\n") / "inner.yaml")

    assert (finding.rule, finding.message) == ("document.unreadable", "cannot be read: Not a directory")


def test_directory(tmp_path):
    finding = only_finding(tmp_path)

    assert (finding.rule, finding.message) == ("document.unreadable", "cannot be read: not a file")


def test_pipe_is_not_waited_for(tmp_path):
    os.mkfifo(tmp_path / "pipe")

    assert only_finding(tmp_path / "pipe").message == "cannot be read: not a file"


def test_endless_device():
    assert only_finding(Path("/dev/zero")).message == "cannot be read: not a file"


def test_name_with_a_null_character():
    finding = only_finding(Path("a\0b.yaml"), label="robot")

    assert (finding.rule, finding.message) == ("document.missing", "not the name of a file")


def test_name_that_is_too_long(tmp_path):
    assert only_finding(tmp_path / ("n" * 5000)).message == "cannot be read: File name too long"


@pytest.mark.parametrize(
    ("content", "line", "column"),
    [
        (b"\xff\xfea\x00", 1, 1),
        (b"a: 1\nb: \xe9t\xe9\n", 2, 4),
        (b"\xef\xbb\xbfa: \xc3\xa9\xc3", 1, 5),
        (b"a: \xed\xa0\x80\n", 1, 4),
        (b"a: \xc0\x80\n", 1, 4),
    ],
)
def test_not_utf_8(write, content, line, column):
    finding = only_finding(write(content))

    assert (finding.rule, finding.message, finding.hint) == (
        "document.encoding",
        "is not UTF-8",
        "save the file as UTF-8",
    )
    assert (finding.line, finding.column) == (line, column)


def test_twenty_megabytes_of_nested_lists(write, monkeypatch):
    path = write(b"[" * 20_000_000)

    def never(*_):
        raise AssertionError("what is too large was parsed")

    monkeypatch.setattr(reader, "Composer", never)
    finding = only_finding(path)

    assert (finding.rule, finding.message) == ("document.size", "is too large: at most 16 MiB are read")


@pytest.mark.parametrize("opening", [b"[", b"- ", b"{a: ", b"? ", b"{"])
def test_as_many_nested_as_the_size_allows(write, opening, monkeypatch):
    path = write(opening * (16 * 1024 * 1024 // len(opening)))

    depths, compose = [], Composer._compose_node

    def counted(composer, event, depth):
        depths.append(depth)
        return compose(composer, event, depth)

    monkeypatch.setattr(Composer, "_compose_node", counted)
    with pytest.raises(DocumentError) as caught:
        read_document(path)

    # Nothing is read beyond the deepest that is allowed.
    assert caught.value.findings[-1].rule == "document.nesting"
    assert len(depths) <= 2 * DEEPEST_NESTING


def test_largest_size_is_read(write):
    path = write(b"a: " + b"x" * (16 * 1024 * 1024 - 3))

    assert len(read_document(path).data["a"]) == 16 * 1024 * 1024 - 3
