"""Reading the result of a test run, also where it is none."""

from __future__ import annotations

import pytest

from rgss.errors import EvidenceError
from rgss.trace.evidence.junit_file import DEEPEST_NESTING, TestEnd, read_junit

RUN = """\
<?xml version="1.0" encoding="utf-8"?>
<testsuites name="pytest tests"><testsuite name="pytest" tests="5">
<properties><property name="rgss.software" value="abc"/></properties>
<testcase classname="tests.room.test_it" name="test_one" time="0.1">
  <properties><property name="rgss.test" value="tests/room/test_it.py::test_one"/>
  <property name="rgss.verifies" value="SYS-1"/><property name="rgss.verifies" value="SYS-2"/></properties>
  <system-out>&lt;failure&gt; said only</system-out>
</testcase>
<testcase classname="tests.room.test_it" name="test_two[a-b]"><failure message="m">trace</failure></testcase>
<testcase classname="tests.room.test_it.TestGroup" name="test_three"><skipped type="pytest.skip"/></testcase>
<testcase classname="tests.test_it" name="test_four"/>
<testcase classname="tests.test_it" name="test_four"><error message="teardown"/></testcase>
</testsuite></testsuites>
"""


@pytest.fixture
def junit(tmp_path):
    def read(content):
        path = tmp_path / "junit.xml"
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return read_junit(path, label="junit.xml")

    return read


def test_tests_and_properties(junit):
    report = junit(RUN)

    assert [(test.id, test.end, test.requirements) for test in report.tests] == [
        ("tests/room/test_it.py::test_one", TestEnd.PASSED, ("SYS-1", "SYS-2")),
        ("tests/room/test_it.py::test_two[a-b]", TestEnd.FAILED, ()),
        ("tests/room/test_it.py::TestGroup::test_three", TestEnd.SKIPPED, ()),
        ("tests/test_it.py::test_four", TestEnd.FAILED, ()),
    ]
    assert report.tests[1].function == "tests/room/test_it.py::test_two"
    assert dict(report.properties) == {"rgss.software": "abc"}


def test_an_older_form_without_the_outer_element(junit):
    assert len(junit('<testsuite><testcase classname="a" name="b"/></testsuite>').tests) == 1


BOMB = """<?xml version="1.0"?><!DOCTYPE t [<!ENTITY a "aaaaaaaaaa">
<!ENTITY b "&a;&a;&a;&a;&a;&a;&a;&a;&a;&a;"><!ENTITY c "&b;&b;&b;&b;&b;&b;&b;&b;&b;&b;">]>
<testsuites>&c;</testsuites>"""
EXTERNAL = '<!DOCTYPE t [<!ENTITY x SYSTEM "file:///etc/passwd">]><testsuites>&x;</testsuites>'
DTD = '<!DOCTYPE testsuites SYSTEM "http://localhost/x.dtd"><testsuites/>'


@pytest.mark.parametrize(
    ("content", "problem"),
    [
        (BOMB, "it declares a document type, which is refused"),
        (EXTERNAL, "it declares a document type, which is refused"),
        (DTD, "it declares a document type, which is refused"),
        ("<testsuites>&undeclared;</testsuites>", "line 1 is not XML: undefined entity"),
        ("<testsuites><testsuite></testsuites>", "line 1 is not XML: mismatched tag"),
        ("", "line 1 is not XML: no element found"),
        ("not XML at all", "line 1 is not XML: syntax error"),
        (b"\x00\x01\x02", "line 1 is not XML"),
        (b"<?xml version='1.0' encoding='utf-16'?><a/>", "line 1 is not XML"),
        ("<?xml version='1.0' encoding='no-such'?><testsuites/>", "its encoding cannot be read: unknown encoding"),
        ("<html><body/></html>", "its top element is 'html', not 'testsuites'"),
        ("<testsuites>" + "<a>" * DEEPEST_NESTING, f"it is nested more than {DEEPEST_NESTING} deep"),
    ],
)  # fmt: skip
def test_hostile_and_broken_files(junit, content, problem):
    with pytest.raises(EvidenceError) as caught:
        junit(content)
    assert caught.value.message.startswith(f"the test result junit.xml cannot be used: {problem}")
    assert caught.value.hint == "write it with 'pytest --junitxml=FILE'"
    assert "\n" not in str(caught.value)


def test_a_result_that_is_too_large(junit, monkeypatch):
    monkeypatch.setattr("rgss.trace.evidence.junit_file.LARGEST_FILE_BYTES", 10)
    with pytest.raises(EvidenceError, match="is too large: at most 0 MiB are read"):
        junit(RUN)


def test_a_result_that_is_not_there(tmp_path):
    with pytest.raises(EvidenceError, match=r"there is no test result .*none\.xml \(write it with 'pytest"):
        read_junit(tmp_path / "none.xml")
    with pytest.raises(EvidenceError, match="cannot be read: "):
        read_junit(tmp_path)


@pytest.mark.parametrize("size", [10, 10_000])
def test_long_names_are_cut(junit, size):
    (test,) = junit(f'<testsuite><testcase classname="a" name="{"x" * size}"/></testsuite>').tests
    assert len(test.id) <= 4_000


def test_control_characters_cannot_come_in(junit):
    with pytest.raises(EvidenceError, match="is not XML"):
        junit('<testsuite><testcase classname="a" name="b&#27;[2J"/></testsuite>')


def test_ids_are_on_one_line(junit):
    (test,) = junit('<testsuite><testcase classname="a" name="b&#10;[&#x202E;c]"/></testsuite>').tests
    assert test.id == "a.py::b [\N{REPLACEMENT CHARACTER}c]"
