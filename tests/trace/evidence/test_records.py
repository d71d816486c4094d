"""Verification records: what a person found, how it weighs beside tests and trials, and when it no longer holds."""

from __future__ import annotations

import hashlib
from dataclasses import replace
from datetime import date

import pytest

from rgss.documents import read_document
from rgss.errors import DefinitionError, DocumentError, EvidenceError
from rgss.measures import StaleCause, Verdict
from rgss.requirements import RecordedResult, load_requirements
from rgss.trace.evidence import SoftwareEvidence, TestEnd, TestEvidence
from rgss.trace.evidence.evidence_state import FailedVerifications
from rgss.trace.evidence.record_evidence import evidence_of_records
from rgss.trace.evidence.record_writing import new_record, records_yaml, with_record, write_records
from rgss.trace.evidence.verification import verification_matrix


@pytest.fixture
def folder(tmp_path, story):
    story.write(tmp_path / "requirements")
    (tmp_path / "protocol.md").write_text("20 strokes, 1.8 s at most.\n", encoding="utf-8")
    (tmp_path / "drawing.dxf").write_bytes(b"\0\1")
    return tmp_path


def verified(folder, *ids, result=RecordedResult.MET, files=("protocol.md",), **stated):
    """The requirements after some were verified and the record was written and read again."""
    fields = {"by": "A. Reader", "on": "2026-05-12", "today": date(2026, 12, 31)} | stated
    record = new_record(folder, result=result, files=[str(folder / name) for name in files], **fields)
    return recorded(folder, ids, record)


def recorded(folder, ids, record):
    requirements = load_requirements(folder / "requirements")
    write_records(folder / "requirements", with_record(requirements, ids, record))
    return load_requirements(folder / "requirements")


def state_of(story, folder, requirements, **changes):
    """Evidence of the story with these records."""
    evidence = story.evidence()
    state = replace(evidence.state, records=evidence_of_records(requirements, folder), **changes)
    return replace(evidence, state=state)


def verdict_on(story, folder, requirements, name, **changes):
    evidence = state_of(story, folder, requirements, **changes)
    return evidence.verdict(requirements.requirement(name))


def test_a_record_states_what_was_found_and_the_digests_of_what_it_rests_on(folder):
    requirements = verified(folder, "SYS-3", note="Opened 20 times.", files=("protocol.md", "drawing.dxf"))
    record = requirements.records["SYS-3"]
    assert (record.result, record.by, record.date) == (RecordedResult.MET, "A. Reader", "2026-05-12")
    assert record.note == "Opened 20 times."
    assert record.files == {
        name: hashlib.sha256((folder / name).read_bytes()).hexdigest() for name in ("drawing.dxf", "protocol.md")
    }


@pytest.mark.parametrize("result", list(RecordedResult))
def test_the_record_decides_a_requirement_without_criterion_and_test(folder, story, result):
    requirements = verified(folder, "SYS-4", result=result)
    evidence = state_of(story, folder, requirements)
    requirement = requirements.requirement("SYS-4")
    assert evidence.verdict(requirement) is Verdict(result.value)
    assert evidence.has_evidence(requirement)
    assert evidence.causes(requirement) == ()
    failed = FailedVerifications(records=("SYS-4",) if result is RecordedResult.NOT_MET else ())
    assert evidence.state.failed == failed


def test_what_has_changed_since_makes_it_stale_and_is_named(folder, story):
    requirements = verified(folder, "SYS-4", result=RecordedResult.NOT_MET)
    requirement = requirements.requirement("SYS-4")
    (folder / "protocol.md").write_text("19 strokes.\n", encoding="utf-8")
    evidence = state_of(story, folder, requirements)
    assert evidence.causes(requirement) == (StaleCause.FILES,)
    assert evidence.record("SYS-4").changed == ("protocol.md",)
    assert (evidence.verdict(requirement), evidence.has_evidence(requirement)) == (Verdict.STALE, False)
    assert evidence.state.failed == FailedVerifications()

    (folder / "protocol.md").unlink()
    system = folder / "requirements/system.yaml"
    system.write_text(system.read_text(encoding="utf-8").replace(requirement.text, f"{requirement.text[:-1]} now."))
    again = load_requirements(folder / "requirements")
    evidence = state_of(story, folder, again)
    assert evidence.causes(again.requirement("SYS-4")) == (StaleCause.REQUIREMENT, StaleCause.FILES)


@pytest.mark.parametrize(
    ("end", "causes", "result", "verdict"),
    [
        (TestEnd.PASSED, (), RecordedResult.MET, Verdict.MET),
        (TestEnd.PASSED, (), RecordedResult.INCONCLUSIVE, Verdict.INCONCLUSIVE),
        (TestEnd.PASSED, (), RecordedResult.NOT_MET, Verdict.NOT_MET),
        (TestEnd.FAILED, (), RecordedResult.MET, Verdict.NOT_MET),
        (None, (), RecordedResult.MET, Verdict.NOT_RUN),
        (TestEnd.PASSED, (StaleCause.CODE,), RecordedResult.MET, Verdict.STALE),
        (TestEnd.PASSED, (StaleCause.CODE,), RecordedResult.NOT_MET, Verdict.NOT_MET),
    ],
)
def test_of_tests_and_record_the_worst_decides(folder, story, end, causes, result, verdict):
    requirements = verified(folder, "SYS-2", result=result)
    test = TestEvidence(requirement="SYS-2", test="tests/test_gripper.py::test_it_opens", end=end)
    software = {"SYS-2": SoftwareEvidence(requirement="SYS-2", tests=(test,), marks=(), causes=causes)}
    assert verdict_on(story, folder, requirements, "SYS-2", software=software) is verdict


def test_beside_trials_only_a_record_of_not_met_counts(folder, story):
    met = verified(folder, "SYS-1")
    assert verdict_on(story, folder, met, "SYS-1") is Verdict.MET
    failed = verified(folder, "SYS-1", result=RecordedResult.NOT_MET)
    assert verdict_on(story, folder, failed, "SYS-1") is Verdict.NOT_MET
    (row,) = (
        row
        for row in verification_matrix(story.model(folder / "requirements"), state_of(story, folder, failed))
        if row.requirement.id == "SYS-1"
    )
    assert row.has_gap
    assert row.record.record.result is RecordedResult.NOT_MET
    assert row.trials


def test_the_text_of_records_is_canonical_and_read_as_it_was_stated(folder):
    odd = 'She said "2 s" – é; # not: a \\ comment'
    requirements = verified(folder, "SYS-3", "SYS-2", note=odd, by="O'Neil: B.")
    path = folder / "requirements/verifications.yaml"
    assert path.read_text(encoding="utf-8") == records_yaml(dict(reversed(requirements.records.items())))
    assert list(requirements.records) == ["SYS-2", "SYS-3"]
    assert {(one.note, one.by) for one in requirements.records.values()} == {(odd, "O'Neil: B.")}
    assert requirements.records["SYS-2"].requirement != requirements.records["SYS-3"].requirement


def test_a_later_record_replaces_the_earlier_and_others_stay(folder):
    verified(folder, "SYS-2", "SYS-3")
    requirements = verified(folder, "SYS-3", result=RecordedResult.NOT_MET, on="2026-06-01", files=())
    assert {name: (one.result.value, one.date) for name, one in requirements.records.items()} == {
        "SYS-2": ("met", "2026-05-12"),
        "SYS-3": ("not_met", "2026-06-01"),
    }
    assert list(recorded(folder, ["SYS-3"], None).records) == ["SYS-2"]
    assert not recorded(folder, ["SYS-2"], None).records


def test_a_record_of_a_requirement_that_is_gone_is_left_out(folder, story):
    requirements = verified(folder, "SYS-3")
    path = folder / "requirements/verifications.yaml"
    path.write_text(path.read_text(encoding="utf-8").replace("SYS-3:", "SYS-9:"), encoding="utf-8")
    requirements = load_requirements(folder / "requirements")
    assert not evidence_of_records(requirements, folder)
    assert not with_record(requirements, (), None)


@pytest.mark.parametrize(
    ("stated", "message"),
    [
        ({"on": "yesterday"}, "'yesterday' is no date"),
        ({"on": "2026-02-30"}, "'2026-02-30' is no date"),
        ({"on": "2027-01-02"}, "2027-01-02 has not come yet"),
        ({"by": " "}, "who verified is stated by 1 to 80 printable characters"),
        ({"by": "A" * 81}, "who verified is stated by 1 to 80 printable characters"),
        ({"note": "A" * 1001}, "a note is stated by 1 to 1000 printable characters"),
        ({"note": "a\x1b[2J"}, "a note is stated by 1 to 1000 printable characters"),
        ({"files": ("/etc/hostname",)}, "'/etc/hostname' is not a file of the project"),
        ({"files": ("../other.md",)}, "not a file of the project"),
    ],
)
def test_what_states_nothing_is_refused(folder, stated, message):
    with pytest.raises(DefinitionError, match=message) as caught:
        verified(folder, "SYS-3", **stated)
    assert caught.value.hint
    assert not (folder / "requirements/verifications.yaml").exists()


def test_a_file_that_cannot_be_read_is_named(folder):
    for name, reason in (("gone.md", "No such file"), ("requirements", "")):
        with pytest.raises(EvidenceError, match=f"cannot be read: {reason}"):
            verified(folder, "SYS-3", files=(name,))
    (folder / "line\nend.md").write_text("", encoding="utf-8")
    with pytest.raises(DefinitionError, match="has a character that cannot be printed"):
        verified(folder, "SYS-3", files=("line\nend.md",))


def test_ids_that_have_no_record_or_are_none_are_refused(folder):
    with pytest.raises(DefinitionError, match="'STK-1' is not a system requirement"):
        verified(folder, "STK-1")
    with pytest.raises(DefinitionError, match="'SYS-3' has no verification record"):
        recorded(folder, ["SYS-3"], None)


@pytest.mark.parametrize(
    ("before", "after", "message"),
    [
        ('date: "2026-05-12"', 'date: "12 May"', "a date is expected, such as 2026-05-12"),
        ("protocol.md", "../protocol.md", "a file of the project is expected, relative to its folder"),
        ("protocol.md", "/protocol.md", "a file of the project is expected, relative to its folder"),
        ("result: met", "result: passed", "met"),
    ],
)
def test_a_file_that_was_edited_into_nonsense_is_refused_at_its_line(folder, before, after, message):
    verified(folder, "SYS-3")
    path = folder / "requirements/verifications.yaml"
    path.write_text(path.read_text(encoding="utf-8").replace(before, after), encoding="utf-8")
    with pytest.raises(DocumentError, match=message) as caught:
        load_requirements(folder / "requirements")
    (finding,) = caught.value.findings
    assert finding.file == "requirements/verifications.yaml"
    assert read_document(path, label="v").data["verifications"]
