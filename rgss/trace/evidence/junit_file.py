"""The result of a test run, read from the JUnit XML that pytest writes.

The file may come from anywhere, so it is read by event handlers that build only the few texts needed here; a document
type, and with it every entity, is refused first.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from enum import Enum
from pathlib import Path
from types import MappingProxyType
from typing import NoReturn
from xml.parsers import expat

from rgss.errors import EvidenceError

LARGEST_FILE_BYTES = 64 * 1024 * 1024
DEEPEST_NESTING = 12
LONGEST_TEXT = 4_000

TEST_ID = "rgss.test"
"""Name of the property that holds a test's id."""
VERIFIES = "rgss.verifies"
"""Name of the property, once for each requirement that a test verifies."""

_PARAMETERS = re.compile(r"\[.*\]$", re.DOTALL)
_HINT = "write it with 'pytest --junitxml=FILE'"


class TestEnd(str, Enum):
    """Outcome of a test."""

    __test__ = False  # pytest collects what is called Test

    PASSED = "passed"
    FAILED = "failed"
    SKIPPED = "skipped"


@dataclass(frozen=True, slots=True, kw_only=True)
class RunTest:
    """One test of a run.

    Attributes:
        id: Its id, such as ``tests/trace/test_links.py::test_a_cycle[1]``.
        requirements: Ids of the requirements that it was marked with when it ran.
        end: How it ended; an error before or after it counts as a failure.
    """

    id: str
    requirements: tuple[str, ...]
    end: TestEnd

    @property
    def function(self) -> str:
        """Its id without parameters."""
        return _PARAMETERS.sub("", self.id)


@dataclass(frozen=True, slots=True, kw_only=True)
class JUnitReport:
    """A run of tests.

    Attributes:
        tests: The tests, in the order in which they ran.
        properties: Recorded properties of the run.
    """

    tests: tuple[RunTest, ...]
    properties: Mapping[str, str]


def read_junit(path: Path, *, label: str | None = None) -> JUnitReport:
    """Read the result of a test run.

    Args:
        path: The file that ``pytest --junitxml=FILE`` wrote.
        label: Its name in messages; the path itself by default.

    Raises:
        EvidenceError: The file is missing, too large, no XML, declares a document type, or is
            nested deeper than any result of a test run.
    """
    name = label if label is not None else str(path)
    try:
        with path.open("rb") as file:
            content = file.read(LARGEST_FILE_BYTES + 1)
    except FileNotFoundError:
        raise EvidenceError(f"there is no test result {name}", hint=_HINT) from None
    except (OSError, ValueError) as error:
        raise EvidenceError(f"the test result {name} cannot be read: {error}", hint="check the name") from error
    if len(content) > LARGEST_FILE_BYTES:
        limit = LARGEST_FILE_BYTES // (1024 * 1024)
        raise EvidenceError(f"the test result {name} is too large: at most {limit} MiB are read", hint=_HINT)
    return _Reader(name).read(content)


class _Reader:
    def __init__(self, name: str) -> None:
        self._name = name
        self._path: list[str] = []
        self._tests: dict[str, RunTest] = {}
        self._run_properties: dict[str, str] = {}
        self._case = ("", "")
        self._case_properties: list[tuple[str, str]] = []
        self._end = TestEnd.PASSED

    def read(self, content: bytes) -> JUnitReport:
        parser = expat.ParserCreate()
        parser.StartDoctypeDeclHandler = self._refuse_document_type
        parser.EntityDeclHandler = self._refuse_document_type
        parser.StartElementHandler = self._start
        parser.EndElementHandler = self._close
        try:
            parser.Parse(content, True)  # noqa: FBT003 - expat takes no keyword here
        except expat.ExpatError as error:
            self._refuse(f"line {error.lineno} is not XML: {expat.errors.messages[error.code]}")
        except (LookupError, ValueError) as error:
            self._refuse(f"its encoding cannot be read: {' '.join(str(error).split())[:100]}")
        return JUnitReport(tests=tuple(self._tests.values()), properties=MappingProxyType(self._run_properties))

    def _start(self, tag: str, attributes: dict[str, str]) -> None:
        if not self._path and tag not in ("testsuites", "testsuite"):
            self._refuse(f"its top element is {tag[:60]!r}, not 'testsuites'")
        if len(self._path) >= DEEPEST_NESTING:
            self._refuse(f"it is nested more than {DEEPEST_NESTING} deep")
        around = self._path[-1] if self._path else ""
        self._path.append(tag)
        if tag == "testcase":
            self._case = (attributes.get("classname", ""), attributes.get("name", ""))
            self._case_properties, self._end = [], TestEnd.PASSED
        elif tag == "property" and around == "properties":
            entry = (attributes.get("name", "")[:LONGEST_TEXT], attributes.get("value", "")[:LONGEST_TEXT])
            if "testcase" in self._path:
                self._case_properties.append(entry)
            else:
                self._run_properties[entry[0]] = entry[1]
        elif around == "testcase" and tag in ("failure", "error"):
            self._end = TestEnd.FAILED
        elif around == "testcase" and tag == "skipped" and self._end is TestEnd.PASSED:
            self._end = TestEnd.SKIPPED

    def _close(self, tag: str) -> None:
        self._path.pop()
        if tag == "testcase":
            self._keep()

    def _keep(self) -> None:
        stated = dict(self._case_properties)
        name = _on_one_line(stated.get(TEST_ID) or _id_of(*self._case))
        verified = tuple(dict.fromkeys(value for key, value in self._case_properties if key == VERIFIES))
        test, before = RunTest(id=name, requirements=verified, end=self._end), self._tests.get(name)
        # A test that passes and then fails to clean up is written twice.
        if before is None or before.end is not TestEnd.FAILED:
            self._tests[name] = test

    def _refuse_document_type(self, *_: object) -> NoReturn:
        self._refuse("it declares a document type, which is refused")

    def _refuse(self, problem: str) -> NoReturn:
        raise EvidenceError(f"the test result {self._name} cannot be used: {problem}", hint=_HINT)


def _on_one_line(text: str) -> str:
    """A text of the file as a message can show it."""
    cut = " ".join(text[:LONGEST_TEXT].split())
    return "".join(character if character.isprintable() else "\N{REPLACEMENT CHARACTER}" for character in cut)


def _id_of(classname: str, name: str) -> str:
    """Pytest id of a test, reconstructed from its JUnit entry."""
    parts = classname.split(".")
    classes = [part for part in parts if part[:1].isupper()]
    modules = parts[: len(parts) - len(classes)]
    return "::".join(["/".join(modules) + ".py", *classes, name])
