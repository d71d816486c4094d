"""Marks read from the source of tests, without running them."""

from __future__ import annotations

import pytest

from rgss.errors import EvidenceError
from rgss.trace.evidence.test_marks import marked_tests

SOURCE = '''\
"""Tests."""

import os
import pytest

os.mkdir("ran")  # nothing is run


@pytest.mark.verifies("SYS-1")
def test_one():
    pass


@pytest.mark.slow
@pytest.mark.parametrize("x", [1, 2])
@pytest.mark.verifies("SYS-1", "SYS-2")
@pytest.mark.verifies("SYS-3")
async def test_several(x):
    pass


def test_none():
    pass


def helper():
    @pytest.mark.verifies("SYS-9")
    def test_hidden():
        pass


@pytest.mark.verifies("SYS-4")
class TestGroup:
    @pytest.mark.verifies("SYS-5")
    def test_inner(self):
        pass

    class TestDeeper:
        pytestmark = [pytest.mark.verifies("SYS-6"), pytest.mark.slow]

        def test_innermost(self):
            pass


@pytest.mark.verifies("SYS-9")
class Helper:
    def test_no(self):
        pass
'''


@pytest.fixture
def tests(tmp_path):
    (tmp_path / "tests" / "room").mkdir(parents=True)

    def write(name, source):
        (tmp_path / "tests" / name).write_text(source, encoding="utf-8")
        return tmp_path

    return write


def test_marks_of_functions_and_classes(tests, tmp_path):
    found = marked_tests(tests("room/test_it.py", SOURCE))

    assert {test.id.removeprefix("tests/room/test_it.py::"): test.requirements for test in found} == {
        "test_one": ("SYS-1",),
        "test_several": ("SYS-1", "SYS-2", "SYS-3"),
        "TestGroup::test_inner": ("SYS-4", "SYS-5"),
        "TestGroup::TestDeeper::test_innermost": ("SYS-4", "SYS-6"),
    }
    assert {(test.file, test.line, test.column) for test in found if test.id.endswith("test_one")} == {
        ("tests/room/test_it.py", 9, 2)
    }
    assert not (tmp_path / "ran").exists()


def test_marks_of_a_whole_file(tests):
    source = 'import pytest\npytestmark = pytest.mark.verifies("SYS-1")\n\ndef test_one():\n    pass\n'
    (found,) = marked_tests(tests("test_it.py", source))

    assert (found.id, found.requirements) == ("tests/test_it.py::test_one", ("SYS-1",))


def test_files_come_in_order_and_others_are_left_alone(tests):
    marked = '@pytest.mark.verifies("{}")\ndef test_it(): pass\n'
    for name in ("test_b.py", "test_a.py", "room/test_c.py", "helper.py", "room/conftest.py"):
        folder = tests(name, marked.format(name))

    assert [test.file for test in marked_tests(folder)] == [
        "tests/room/test_c.py",
        "tests/test_a.py",
        "tests/test_b.py",
    ]


def test_no_tests(tmp_path):
    assert marked_tests(tmp_path) == ()


@pytest.mark.parametrize(
    ("content", "problem"),
    [
        (b"# verifies\ndef test_it(:\n", "tests/test_it.py:2 is not Python (correct it; its marks cannot be read)"),
        (b"# verifies\n\xff\n", "tests/test_it.py is not UTF-8 (save the file as UTF-8)"),
        (b"# verifies\nx = 0\x00", "tests/test_it.py:1 is not Python (correct it; its marks cannot be read)"),
        (b"# verifies\n" + b"(" * 5_000, "tests/test_it.py:2 is not Python"),
        (b"# " + b"x" * (4 * 1024 * 1024), "tests/test_it.py is too large to be a file of tests (split it)"),
    ],
)
def test_files_that_cannot_be_read(tests, content, problem):
    folder = tests("test_it.py", "")
    (folder / "tests" / "test_it.py").write_bytes(content)
    with pytest.raises(EvidenceError) as caught:
        marked_tests(folder)
    assert str(caught.value).startswith(problem)
    assert "\n" not in str(caught.value)
