"""The verification matrix, and what evidence says of each requirement."""

from __future__ import annotations

from dataclasses import replace

import pytest

from rgss.measures import StaleCause, Verdict
from rgss.requirements import VerificationMethod
from rgss.trace.evidence import SoftwareEvidence, TestEnd, TestEvidence
from rgss.trace.evidence.verdict_evidence import TraceEvidence
from rgss.trace.evidence.verification import verification_matrix


@pytest.fixture
def model(tmp_path, story):
    return story.model(story.write(tmp_path / "requirements"))


def rows_of(model, evidence):
    return {row.requirement.id: row for row in verification_matrix(model, evidence)}


def test_a_criterion_is_judged_on_the_shown_variant_by_the_trials_that_decide(model, story):
    row = rows_of(model, story.evidence())["SYS-1"]

    assert row.success == "P >= 800 g"
    assert row.requirement.verification is VerificationMethod.ANALYSIS
    assert (row.verdict, row.variant) == (Verdict.MET, 7)
    assert [trial.key for trial in row.trials] == [story.KEYS[1], story.KEYS[2]]
    assert row.tally == ((Verdict.MET, 2), (Verdict.NOT_MET, 1))
    assert row.estimate.value == 0.865
    assert not row.has_gap


def test_a_trial_names_the_commands_that_run_it(model, story):
    trial = rows_of(model, story.evidence())["SYS-1"].trials[1]

    assert trial.replay_command == f"rgss replay {story.KEYS[2][:12]}"
    assert trial.run_command == "rgss run 7 --seed 2 --fidelity contact"


def test_tests_decide_where_there_is_no_criterion(model, story):
    rows = rows_of(model, story.evidence())

    assert (rows["SYS-2"].verdict, rows["SYS-2"].success) == (Verdict.MET, "It opens in 20 of 20 runs.")
    assert [test.test for test in rows["SYS-2"].tests] == ["tests/test_gripper.py::test_it_opens[fast]"]
    assert (rows["SYS-3"].verdict, rows["SYS-3"].has_gap) == (Verdict.NOT_RUN, True)
    assert (rows["SYS-4"].verdict, rows["SYS-4"].success, rows["SYS-4"].trials) == (Verdict.NOT_RUN, "", ())


def test_a_failed_test_outweighs_what_trials_show(model, story):
    evidence = story.evidence()
    for end, causes, verdict in (
        (TestEnd.FAILED, (), Verdict.NOT_MET),
        (TestEnd.FAILED, (StaleCause.CODE,), Verdict.MET),
        (TestEnd.PASSED, (), Verdict.MET),
        (None, (), Verdict.MET),
    ):
        test = TestEvidence(requirement="SYS-1", test="tests/test_gripper.py::test_it_lifts", end=end)
        of_tests = SoftwareEvidence(requirement="SYS-1", tests=(test,), marks=(), causes=causes)
        state = replace(evidence.state, software={**evidence.state.software, "SYS-1": of_tests})
        row = rows_of(model, replace(evidence, state=state))["SYS-1"]
        assert (row.verdict, row.has_gap) == (verdict, verdict is not Verdict.MET)


def test_each_row_says_where_its_requirement_stands(model, story):
    documents = {name: row.document for name, row in rows_of(model, story.evidence()).items()}

    assert documents["SYS-1"] == "requirements/system.yaml:2"
    assert len(set(documents.values())) == 4


def test_a_stale_verdict_says_what_changed(model, story):
    row = rows_of(model, story.evidence(causes=(StaleCause.MEASURE, StaleCause.CODE)))["SYS-1"]

    assert (row.verdict, row.causes) == (Verdict.STALE, (StaleCause.MEASURE, StaleCause.CODE))


def test_without_a_shown_variant_the_verdict_is_the_one_on_which_all_agree(model, story):
    differing = rows_of(model, story.evidence(shown=False))["SYS-1"]
    agreed = rows_of(model, TraceEvidence())["SYS-1"]

    assert (differing.verdict, differing.variant, differing.trials) == (None, None, ())
    assert differing.has_gap
    assert agreed.verdict is Verdict.NOT_RUN


def test_evidence_that_is_stale_is_none_that_holds(model, story):
    (requirement, *_) = model.requirements.system

    assert story.evidence().has_evidence(requirement)
    assert not story.evidence(causes=(StaleCause.CODE,)).has_evidence(requirement)
    assert not TraceEvidence().has_evidence(requirement)
