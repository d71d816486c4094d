"""What a project's own tests say of its requirements: marks, results, and whether they still hold."""

from __future__ import annotations

import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import pytest

from rgss.errors import EvidenceError
from rgss.measures import StaleCause, Verdict
from rgss.requirements import load_requirements
from rgss.studies import named_sets, qualifier_of
from rgss.trace.evidence.digest import verification_digest
from rgss.trace.evidence.evidence_state import EvidenceState
from rgss.trace.evidence.junit_file import JUnitReport, RunTest, TestEnd, read_junit
from rgss.trace.evidence.software import (
    REQUIREMENT_PREFIX,
    SOFTWARE,
    run_properties,
    software_digest,
    software_evidence,
)
from rgss.trace.evidence.test_marks import MarkedTest, marked_tests

ROOT = Path(__file__).parents[3]
CRITERION = '    criterion: {measure: P, comparison: ">=", threshold: "800 g"}\n'
PASSED, FAILED, SKIPPED = TestEnd.PASSED, TestEnd.FAILED, TestEnd.SKIPPED


@pytest.fixture
def requirement(project):
    project.edit("system.yaml", "analysis", "test")
    (found,) = load_requirements(project.folder).system
    return found


def mark(name, *requirements):
    return MarkedTest(
        id=f"tests/test_it.py::{name}", requirements=requirements, file="tests/test_it.py", line=1, column=1
    )


def report(ends, *requirements, software="now", **properties):
    """A run of the tests of some requirements, with the digests that it recorded."""
    recorded = {f"{REQUIREMENT_PREFIX}{one.id}": verification_digest(one) for one in requirements}
    properties = {SOFTWARE: software, **recorded, **properties} if requirements else properties
    tests = [RunTest(id=f"tests/test_it.py::{name}", requirements=(), end=end) for name, end in ends.items()]
    return JUnitReport(tests=tuple(tests), properties=properties)


MARKS = (mark("test_a", "SYS-1"), mark("test_b", "SYS-1", "SYS-2"), mark("test_c", "SYS-2"))


@pytest.mark.parametrize(
    ("ends", "verdict"),
    [
        ({"test_a": PASSED, "test_b": PASSED, "test_c": FAILED}, Verdict.MET),
        ({"test_a": PASSED, "test_b[1]": PASSED, "test_b[2]": PASSED}, Verdict.MET),
        ({"test_a": PASSED, "test_b[1]": PASSED, "test_b[2]": FAILED}, Verdict.NOT_MET),
        ({"test_a": FAILED}, Verdict.NOT_MET),
        ({"test_a": PASSED}, Verdict.NOT_RUN),
        ({"test_a": PASSED, "test_b": SKIPPED}, Verdict.NOT_RUN),
        ({"test_c": PASSED}, Verdict.NOT_RUN),
        ({}, Verdict.NOT_RUN),
    ],
)
def test_verdicts(requirement, ends, verdict):
    found = software_evidence([requirement], MARKS, report(ends, requirement), software="now")["SYS-1"]

    assert (found.verdict, found.causes) == (verdict, ())


def test_without_a_run_or_a_mark_nothing_is_known(requirement):
    assert software_evidence([requirement], MARKS, None, software="now")["SYS-1"].verdict is Verdict.NOT_RUN
    unmarked = software_evidence([requirement], (), report({"test_a": PASSED}), software="now")["SYS-1"]
    assert (unmarked.verdict, unmarked.tests) == (Verdict.NOT_RUN, ())


def test_a_mark_that_the_source_does_not_show_counts_while_the_run_holds(requirement):
    """As of a unittest.TestCase with another name, or in the parameters of a test."""
    shown = RunTest(id="tests/test_it.py::test_a", requirements=("SYS-1",), end=PASSED)
    hidden = RunTest(id="tests/test_it.py::CaseOfIt::test_h[1]", requirements=("SYS-1", "SYS-2"), end=FAILED)
    noted = report({}, requirement).properties
    ran = JUnitReport(tests=(shown, hidden), properties=noted)

    found = software_evidence([requirement], MARKS[:1], ran, software="now")["SYS-1"]
    assert [(test.test, test.end) for test in found.tests] == [(shown.id, PASSED), (hidden.id, FAILED)]
    assert found.verdict is Verdict.NOT_MET
    # A set of parameters has a further mark, beside that of the function.
    further = replace(shown, requirements=("SYS-2", "SYS-1"))
    ran_so = JUnitReport(tests=(further,), properties=noted)
    beside = software_evidence([requirement], (mark("test_a", "SYS-2"),), ran_so, software="now")["SYS-1"]
    assert [(test.test, test.end) for test in beside.tests] == [(shown.id, PASSED)]
    # Nothing says that the mark is still there.
    stale = software_evidence([requirement], MARKS[:1], ran, software="later")["SYS-1"]
    assert [test.test for test in stale.tests] == [shown.id]
    # That of another set of requirements.
    other = software_evidence([requirement], MARKS[:1], ran, software="now", qualifier="bench/")["SYS-1"]
    assert [test.test for test in other.tests] == [shown.id]


def test_each_test_is_told_with_its_end(requirement):
    found = software_evidence([requirement], MARKS, report({"test_b[x]": FAILED}), software="now")["SYS-1"]

    assert [(test.requirement, test.test, test.end) for test in found.tests] == [
        ("SYS-1", "tests/test_it.py::test_a", None),
        ("SYS-1", "tests/test_it.py::test_b[x]", FAILED),
    ]


def test_what_a_criterion_decides_is_passed_over(project):
    requirements = load_requirements(project.folder).system
    assert dict(software_evidence(requirements, MARKS, None, software="now")) == {}


@pytest.mark.parametrize("method", ["inspection", "demonstration"])
def test_a_marked_test_may_inspect_or_demonstrate(project, method):
    project.edit("system.yaml", "analysis", method)
    project.edit("system.yaml", CRITERION, "    success: The gripper lifts a cup.\n")
    requirements = load_requirements(project.folder).system
    ran = report({"test_a": PASSED, "test_b": PASSED}, *requirements)

    assert software_evidence(requirements, MARKS, ran, software="now")["SYS-1"].verdict is Verdict.MET
    assert dict(software_evidence(requirements, (), ran, software="now")) == {}


def test_what_a_run_without_digests_tested_is_unknown(requirement):
    """As another program than pytest writes it, or pytest without the plugin of rgss."""
    ran = report({"test_a": PASSED, "test_b": PASSED})
    found = software_evidence([requirement], MARKS, ran, software="now")["SYS-1"]
    assert (found.verdict, found.causes) == (Verdict.STALE, (StaleCause.UNRECORDED,))
    # A requirement that the run did not know.
    partly = report({"test_a": PASSED, "test_b": PASSED}, **{SOFTWARE: "now"})
    found = software_evidence([requirement], MARKS, partly, software="now")["SYS-1"]
    assert (found.verdict, found.causes) == (Verdict.STALE, (StaleCause.REQUIREMENT,))


@pytest.mark.parametrize(
    ("software", "change", "causes"),
    [
        ("then", {}, ()),
        ("now", {}, (StaleCause.CODE,)),
        ("then", {"text": "Another."}, (StaleCause.REQUIREMENT,)),
        ("then", {"criterion": None}, (StaleCause.REQUIREMENT,)),
        ("now", {"text": "Another."}, (StaleCause.REQUIREMENT, StaleCause.CODE)),
        ("then", {"text": "The gripper shall\nlift at least 0.8 kg."}, ()),
        ("then", {"owner": "another", "rationale": "Another.", "derived_from": ()}, ()),
    ],
)
def test_a_result_is_stale_when_what_was_tested_changed(requirement, software, change, causes):
    noted = {SOFTWARE: "then", f"{REQUIREMENT_PREFIX}SYS-1": verification_digest(requirement)}
    ran = report({"test_a": PASSED, "test_b": FAILED}, **noted)
    found = software_evidence([replace(requirement, **change)], MARKS, ran, software=software)["SYS-1"]

    assert found.causes == causes
    assert found.verdict is (Verdict.STALE if causes else Verdict.NOT_MET)


def test_a_success_criterion_in_words_is_part_of_what_was_tested(requirement):
    opens, closes = (replace(requirement, criterion=None, success=words) for words in ("It opens.", "It closes."))
    assert verification_digest(opens) != verification_digest(closes)
    assert verification_digest(opens) == verification_digest(replace(opens, success="It\nopens."))


def test_what_was_never_run_is_not_stale(requirement):
    ran = report({"test_c": PASSED}, **{SOFTWARE: "then"})
    assert software_evidence([requirement], MARKS, ran, software="now")["SYS-1"].verdict is Verdict.NOT_RUN


def test_the_digest_is_of_what_tests_run_on(tmp_path):
    own = ("logger.py", "src/own/log.py", "package/__init__.py", "package/inner/deep.py")
    tested = ("rgss/a.py", "tests/test_a.py", "designs/d.yaml", "requirements/measures.yaml", *own)
    for name in (*tested, "requirements/system.yaml"):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text("1\n", encoding="utf-8")
    digests = [software_digest(tmp_path)]

    for name in tested:
        (tmp_path / name).write_text("2\n", encoding="utf-8")
        digests.append(software_digest(tmp_path))
    (tmp_path / "rgss/a.py").rename(tmp_path / "rgss/b.py")
    digests.append(software_digest(tmp_path))
    assert len(set(digests)) == len(digests)

    (tmp_path / "rgss/b.py").write_bytes(b"2\r\n")
    (tmp_path / "requirements/system.yaml").write_text("2\n", encoding="utf-8")
    (tmp_path / "rgss/notes.txt").write_text("2\n", encoding="utf-8")
    assert software_digest(tmp_path) == digests[-1]


def test_a_file_that_cannot_be_read_is_told(tmp_path, monkeypatch):
    (tmp_path / "rgss").mkdir()
    (tmp_path / "rgss/a.py").write_text("1\n", encoding="utf-8")

    def refuse(*_):
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr("os.open", refuse)
    with pytest.raises(EvidenceError, match=r"a\.py cannot be read: Permission denied"):
        software_digest(tmp_path)


def test_a_run_notes_its_marks_and_what_it_ran_on(tmp_path):
    """The plugin of this project's tests, on one of its own marked tests."""
    result = tmp_path / "junit.xml"
    own = "tests/trace/rules/test_coverage.py"
    command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", own, f"--junitxml={result}"]
    run = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    assert run.returncode == 0, run.stdout

    report = read_junit(result)
    requirements = load_requirements(ROOT / "requirements").system
    expected = dict(run_properties(ROOT, requirements))
    for folder in named_sets(ROOT):
        further = load_requirements(ROOT / folder).system
        expected |= run_properties(ROOT, further, qualifier=qualifier_of(folder))
    assert "rgss.requirement.yumi/SYS-01" in expected
    assert report.properties.keys() == expected.keys()
    assert {name: value for name, value in report.properties.items() if name != SOFTWARE}.items() <= expected.items()
    marked = {test.id: test.requirements for test in marked_tests(ROOT)}
    assert len(report.tests) > 10
    for test in report.tests:
        assert test.requirements == marked.get(test.function, ())
    noted = {test.function for test in report.tests if test.requirements}
    assert noted == {name for name in marked if name.startswith(own)}


def test_marked_tests_of_this_project_verify_what_is_there():
    """Every requirement that is verified by test has a test, and every mark is of a requirement."""
    requirements = load_requirements(ROOT / "requirements")
    marked = marked_tests(ROOT)
    found = software_evidence(requirements.system, marked, None, software="")

    assert [name for name, evidence in found.items() if not evidence.tests] == []
    known = {requirement.id for requirement in requirements.system}
    for folder in named_sets(ROOT):
        qualifier = qualifier_of(folder)
        known |= {f"{qualifier}{one.id}" for one in load_requirements(ROOT / folder).system}
    assert {name for test in marked for name in test.requirements} <= known


@pytest.mark.parametrize(
    ("ends", "causes", "text"),
    [
        ({}, {}, "warning: 'SYS-1' has no result of 2 of the 2 tests that verify it"),
        ({"test_a": PASSED}, {}, "warning: 'SYS-1' has no result of 1 of the 2 tests that verify it"),
        ({"test_a": FAILED, "test_b": FAILED}, {}, "error: 'SYS-1' is not met: tests/test_it.py::test_a and 1 more"),
        ({"test_a": PASSED, "test_b": FAILED}, {}, "error: 'SYS-1' is not met: tests/test_it.py::test_b failed"),
        ({"test_a": PASSED, "test_b": PASSED}, {SOFTWARE: "then"}, "warning: 'SYS-1' was tested before: the code has"),
        ({"test_a": PASSED, "test_b": PASSED}, None, "warning: 'SYS-1' was tested before: the run did not record what"),
        ({"test_a": PASSED, "test_b": PASSED}, {}, None),
    ],
)  # fmt: skip
def test_findings_on_tests(project, requirement, ends, causes, text):
    marks = (*MARKS[:1], mark("test_b", "SYS-1"))
    ran = report(ends) if causes is None else report(ends, requirement, **causes)
    evidence = software_evidence([requirement], marks, ran, software="now")
    project.evidence, project.marked = EvidenceState(software=evidence), marks
    findings = project.findings()

    assert len(findings) == (text is not None)
    for finding in findings:
        assert finding.startswith(f"{project.position('system.yaml', 'test')}: {text}")
