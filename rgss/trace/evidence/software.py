"""Evidence of a project's own tests for the requirements that are verified by test."""

from __future__ import annotations

import hashlib
from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType

from rgss.documents import chunks_of
from rgss.errors import EvidenceError
from rgss.measures import StaleCause, Verdict
from rgss.requirements import Requirement, VerificationMethod
from rgss.trace.evidence.digest import verification_digest
from rgss.trace.evidence.junit_file import JUnitReport, RunTest, TestEnd
from rgss.trace.evidence.test_marks import MarkedTest

JUNIT_FILE = ".rgss/junit.xml"
"""File with the result of a project's tests, relative to the project."""

SOFTWARE = "rgss.software"
"""Name of the property of a run that holds the digest of what was tested."""

REQUIREMENT_PREFIX = "rgss.requirement."
"""With a requirement's id, name of the property that holds its digest at the time of the run."""

_LARGEST_BYTES = 256 * 1024 * 1024
TESTED_FOLDERS = ("rgss", "src", "tests", "designs", "scenes", "studies")
TESTED_FILES = ("requirements.lock", "pyproject.toml")
MEASURES_FILE = "measures.yaml"
_SUFFIXES = frozenset({".py", ".yaml", ".csv", ".urdf", ".json"})


@dataclass(frozen=True, slots=True, kw_only=True)
class TestEvidence:
    """One test that verifies a requirement.

    Attributes:
        requirement: Id of the requirement.
        test: Id of the test, such as ``tests/trace/test_links.py::test_a_cycle``; with parameters
            where it was run with them.
        end: How it ended; None if it was not run.
    """

    __test__ = False  # pytest collects what is called Test

    requirement: str
    test: str
    end: TestEnd | None


@dataclass(frozen=True, slots=True, kw_only=True)
class SoftwareEvidence:
    """Evidence of the tests for one requirement.

    Attributes:
        requirement: Its id.
        tests: The tests marked as verifying it, in the order of files; parametrised tests once for each parameter set.
        marks: The marks in the source, for messages.
        causes: Causes of staleness since the tests ran; empty if there are none, or if they did not run.
    """

    requirement: str
    tests: tuple[TestEvidence, ...]
    marks: tuple[MarkedTest, ...]
    causes: tuple[StaleCause, ...]

    @property
    def verdict(self) -> Verdict:
        """Met if every marked test passed, not met if one failed, not run if one did not run.

        Stale if the tested inputs or the requirement have changed since.
        """
        ends = [test.end for test in self.tests]
        if self.causes and any(end is not None for end in ends):
            return Verdict.STALE
        if TestEnd.FAILED in ends:
            return Verdict.NOT_MET
        return Verdict.MET if ends and all(end is TestEnd.PASSED for end in ends) else Verdict.NOT_RUN


def software_evidence(
    requirements: Iterable[Requirement],
    marked: Iterable[MarkedTest],
    report: JUnitReport | None,
    *,
    software: str,
    qualifier: str = "",
) -> Mapping[str, SoftwareEvidence]:
    """Join marks and results.

    A test that is marked in the source, but is not in the result, was not run. A test in the result whose mark has been
    removed from the source is ignored. One whose mark the source does not show, such as that of a class with another
    name, counts while the result holds.

    Args:
        requirements: The system requirements.
        marked: The marks in the source.
        report: The result of the last run; None if there is none.
        software: Present `software_digest` of the project.
        qualifier: Prefix of the ids in the recorded digests, as in `run_properties`.

    Returns:
        The evidence of each requirement that is verified by test, or is inspected or demonstrated
        by marked tests, by its id.
    """
    runs: dict[str, list[tuple[str, TestEnd]]] = {}
    for test in report.tests if report is not None else ():
        runs.setdefault(test.function, []).append((test.id, test.end))
    marks: dict[str, list[MarkedTest]] = {}
    for mark in marked:
        for name in mark.requirements:
            marks.setdefault(name, []).append(mark)
    shown = {(mark.id, f"{qualifier}{name}") for name, own in marks.items() for mark in own}
    unseen = {} if report is None else _unseen(report, shown)
    found = {}
    for requirement in requirements:
        causes = () if report is None else tuple(_causes(requirement, report, software, qualifier))
        hidden = [] if causes else unseen.get(f"{qualifier}{requirement.id}", [])
        own = marks.get(requirement.id, [])
        if not _is_tested(requirement, is_marked=bool(own or hidden)):
            continue
        ends = [(test, end) for mark in own for test, end in runs.get(mark.id, [(mark.id, None)])]
        ends += [(test.id, test.end) for test in hidden]
        found[requirement.id] = SoftwareEvidence(
            requirement=requirement.id,
            tests=tuple(TestEvidence(requirement=requirement.id, test=test, end=end) for test, end in ends),
            marks=tuple(own),
            causes=causes,
        )
    return MappingProxyType(found)


def _unseen(report: JUnitReport, shown: Collection[tuple[str, str]]) -> Mapping[str, list[RunTest]]:
    """Tests of a run by the requirements that they were marked with, without the marks that the source shows."""
    found: dict[str, list[RunTest]] = {}
    for test in report.tests:
        for name in test.requirements:
            if (test.function, name) not in shown:
                found.setdefault(name, []).append(test)
    return found


def run_properties(project: Path, requirements: Iterable[Requirement], *, qualifier: str = "") -> Mapping[str, str]:
    """Digests recorded by a test run, for later detection of staleness.

    Args:
        project: The project's folder.
        requirements: System requirements of one set.
        qualifier: Prefix of the ids of a set, such as ``bench/``; empty for the default set.

    Raises:
        EvidenceError: A file of the project cannot be read.
    """
    return {
        SOFTWARE: software_digest(project),
        **{f"{REQUIREMENT_PREFIX}{qualifier}{one.id}": verification_digest(one) for one in requirements},
    }


def software_digest(project: Path) -> str:
    """SHA-256 of the inputs of a project's tests: code, tests, measures, designs, scenes, studies, lock.

    Code is what lies in the project's folder, in ``src`` or in a package of the folder. Requirements are not included;
    each has its own digest.

    Raises:
        EvidenceError: A file cannot be read.
    """
    content = hashlib.sha256()
    for path in tested_files(project):
        content.update(path.relative_to(project).as_posix().encode())
        content.update(b"\0")
        try:
            content.update(_text_digest(path))
        except OSError as error:
            raise EvidenceError(f"{path.name} cannot be read: {error.strerror}", hint="check its permissions") from None
    return content.hexdigest()


def _text_digest(path: Path) -> bytes:
    """The SHA-256 of a text whose lines end as they do here; it is read piece by piece."""
    hashed, held = hashlib.sha256(), b""
    for chunk in chunks_of(path, largest=_LARGEST_BYTES):
        text = held + chunk
        # The end of a line may be cut in two.
        held = text[-1:] if text.endswith(b"\r") else b""
        hashed.update(text[: len(text) - len(held)].replace(b"\r\n", b"\n"))
    hashed.update(held)
    return hashed.digest()


def tested_files(project: Path) -> list[Path]:
    """Files of a project that its tests run with: code, tests and data, on which their results rest."""
    found = [project / name for name in TESTED_FILES if (project / name).is_file()]
    # Those of the default set, and those of each set in a folder of its own.
    default = project / "requirements"
    found += [path for path in (default / MEASURES_FILE, *default.glob(f"*/{MEASURES_FILE}")) if path.is_file()]
    found += project.glob("*.py")
    packages = {path.parent.name for path in project.glob("*/__init__.py")}
    for folder in packages.union(TESTED_FOLDERS):
        found += [path for path in (project / folder).rglob("*") if path.suffix in _SUFFIXES and path.is_file()]
    return sorted(found)


def _is_tested(requirement: Requirement, *, is_marked: bool) -> bool:
    """True if tests decide: it is verified by test, or marked tests inspect or demonstrate it."""
    method = requirement.verification
    if method is VerificationMethod.TEST:
        return True
    by_hand = method in (VerificationMethod.INSPECTION, VerificationMethod.DEMONSTRATION)
    return by_hand and requirement.criterion is None and is_marked


def _causes(requirement: Requirement, report: JUnitReport, software: str, qualifier: str) -> Iterable[StaleCause]:
    """Changes since the run; what a run without digests tested is unknown."""
    if SOFTWARE not in report.properties:
        yield StaleCause.UNRECORDED
        return
    if report.properties.get(f"{REQUIREMENT_PREFIX}{qualifier}{requirement.id}") != verification_digest(requirement):
        yield StaleCause.REQUIREMENT
    if report.properties[SOFTWARE] != software:
        yield StaleCause.CODE
