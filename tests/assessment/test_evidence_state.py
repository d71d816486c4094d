"""The state of a project's evidence, as the rules of evidence and the reports see it."""

from __future__ import annotations

import pytest

from rgss.assessment.evidence_status import evidence_state, project_marks, trial_verdicts
from rgss.assessment.measuring import measure_variants, record_of, requirements_with_criteria
from rgss.assessment.recorded_verdicts import VerdictRecord
from rgss.errors import EvidenceError
from rgss.measures import StaleCause, Verdict
from rgss.studies.project import load_project
from rgss.trace import check_trace
from rgss.trace.evidence import run_properties

TEST = """\
import pytest

@pytest.mark.verifies("SYS-018")
def test_it():
    pass
"""
PASSED = '<testsuite><testcase classname="tests.test_it" name="test_it"/></testsuite>'


@pytest.fixture(scope="module")
def measured(shipped, filled, record_of):
    return measure_variants(shipped, filled(shipped, record_of))


def test_the_verdicts_of_trials_by_requirement(shipped, measured):
    found = trial_verdicts(shipped, measured)

    assert list(found) == [requirement.id for requirement in requirements_with_criteria(shipped)]
    for name, one in found.items():
        assert dict(one.verdicts) == {entry.variant.id: entry.verdicts[name] for entry in measured}
        assert (dict(one.recorded), dict(one.causes)) == ({}, {})


def test_recorded_verdicts_and_causes_come_with_them(folder, edit, filled, record_of_trial, shipped):
    store = filled(shipped, record_of_trial)
    recorded = record_of(shipped, measure_variants(shipped, store), VerdictRecord())
    edit("requirements/system/1-manipulator.yaml", "execute the task within", "finish the task within")
    project = load_project(folder)
    found = trial_verdicts(project, measure_variants(project, store, recorded=recorded), recorded=recorded)

    assert set(found["SYS-005"].verdicts.values()) == {Verdict.STALE}
    assert found["SYS-005"].recorded.keys() == set(range(1, 73))
    assert found["SYS-005"].all_causes == (StaleCause.REQUIREMENT,)
    assert found["SYS-024"].all_causes == ()


@pytest.fixture
def record_of_trial(record_of):
    return record_of


def test_a_project_without_tests_of_its_own(folder):
    project = load_project(folder)

    assert project_marks(folder) is None
    assert evidence_state(project, measure_variants(project, None)).software is None


def test_a_project_with_tests(folder):
    (folder / "tests").mkdir()
    (folder / "tests" / "test_it.py").write_text(TEST, encoding="utf-8")
    project, measured = load_project(folder), measure_variants(load_project(folder), None)

    assert evidence_state(project, measured).software["SYS-018"].verdict is Verdict.NOT_RUN
    result = folder / ".rgss" / "junit.xml"
    result.parent.mkdir()
    result.write_text(PASSED, encoding="utf-8")
    assert evidence_state(project, measured).software["SYS-018"].causes == (StaleCause.UNRECORDED,)
    noted = run_properties(folder, project.requirements.system)
    of_run = "".join(f'<property name="{name}" value="{value}"/>' for name, value in noted.items())
    passed = PASSED.replace("<testsuite>", f"<testsuite><properties>{of_run}</properties>")
    result.write_text(passed, encoding="utf-8")
    state = evidence_state(project, measured)
    assert state.software["SYS-018"].verdict is Verdict.MET
    findings = check_trace(project.requirements, project.measure_traces, marked=project_marks(folder), evidence=state)
    assert {finding.rule for finding in findings} >= {"trace.no-test", "evidence.none"}
    assert not any("'SYS-018'" in finding.message for finding in findings if finding.severity.value != "info")

    other = folder / "other.xml"
    with pytest.raises(EvidenceError, match="there is no test result"):
        evidence_state(project, measured, junit=other)
    failed = passed.replace('name="test_it"/>', 'name="test_it"><failure/></testcase>')
    other.write_text(failed, encoding="utf-8")
    assert evidence_state(project, measured, junit=other).software["SYS-018"].verdict is Verdict.NOT_MET
