"""Each rule of the registry is broken by a minimal document, and by nothing else is that document broken."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from datetime import date
from types import MappingProxyType
from typing import Any

import pytest

from rgss.measures import StaleCause, Verdict
from rgss.requirements import RecordedResult, load_requirements
from rgss.trace import RULES, MeasureKind
from rgss.trace.evidence.evidence_state import EvidenceState, TrialVerdicts
from rgss.trace.evidence.junit_file import TestEnd
from rgss.trace.evidence.record_evidence import evidence_of_records
from rgss.trace.evidence.record_writing import new_record, with_record, write_records
from rgss.trace.evidence.software import SoftwareEvidence, TestEvidence
from rgss.trace.evidence.test_marks import MarkedTest
from rgss.trace.rules.review_stamps import stamped, write_reviews
from rgss.trace.rules.rule import SentenceRule

TEXT = "The gripper shall lift at least 0.8 kg."
NEED_NO_HINT = {"trace.idle-element", "trace.unknown-mark", "requirements.wrong-kind", "exempt.unknown-rule"}
CRITERION = '    criterion: {measure: P, comparison: ">=", threshold: "800 g"}\n'
METHOD = "    verification: analysis\n"
BLOCK = "  - {id: BLK-2, name: Arm, level: subsystem, text: Moves.}\n"
BEHAVIOUR = "behaviours:\n  - {id: UC-1, name: Lift, kind: use_case, text: Lifts.}\n"
REQUIREMENT = """\
  - id: SYS-2
    group: gripper
    text: The gripper shall open.
    rationale: A closed one holds on.
    source: catalogue
    priority: low
    status: draft
    owner: engineer
    derived_from: [STK-1]
    satisfied_by: [BLK-1]
    verification: test
    success: It opens.
    facility: desk
    phase: development
"""
NEED = """\
  - id: STK-2
    kind: design
    text: The system shall fit on a table.
    rationale: R
    source: S
    priority: low
    status: draft
    owner: O
"""


@dataclass(frozen=True, kw_only=True)
class Break:
    """A way to break a rule.

    Attributes:
        make: Breaks the sound project.
        file: The file in the requirements folder that the finding is in; otherwise its place as a text.
        start_of: A text that stands there once and starts at the finding.
    """

    make: Callable[[Any], Any]
    file: str
    start_of: str = ""

    def place(self, project: Any) -> str:
        return project.position(self.file, self.start_of) if self.start_of else self.file


def _text(new: str) -> Break:
    """Another sentence without a criterion, found at its start."""
    return Break(make=lambda project: _with_text(project, new), file="system.yaml", start_of=new)


def _with_text(project: Any, new: str) -> None:
    project.edit("system.yaml", f"text: {TEXT}", f"text: {new}")
    project.edit("system.yaml", CRITERION, "    criterion_exemption: The text says it.\n")


def _measure(make: Callable[[Any], Any], line: int) -> Break:
    return Break(make=make, file=f"requirements/measures.yaml:{line}:5")


def _reviewed(project: Any, *ids: str) -> None:
    requirements = load_requirements(project.folder)
    write_reviews(project.folder, stamped(requirements, ids, "Reader"))


def _changed_after_review(project: Any) -> None:
    _reviewed(project, "SYS-1")
    project.edit("system.yaml", "lift at least", "raise at least")


def _upstream_changed_after_review(project: Any) -> None:
    _reviewed(project, "SYS-1")
    project.edit("stakeholder.yaml", "serve the cup", "bring the cup")


def _gone_after_review(project: Any) -> None:
    project.append("architecture.yaml", BLOCK)
    _reviewed(project, "BLK-2")
    project.edit("architecture.yaml", BLOCK, "")


def _marked(project: Any, *requirements: str) -> None:
    test = MarkedTest(
        id="tests/test_it.py::test_it", requirements=requirements, file="tests/test_it.py", line=7, column=2
    )
    project.marked = (test,)


def _by_test(project: Any) -> Any:
    return project.edit("system.yaml", "analysis", "test")


def _trials(project: Any, verdict: Verdict, **changes: Any) -> None:
    state = {"recorded": {}, "causes": {}} | changes
    found = TrialVerdicts(requirement="SYS-1", verdicts={1: verdict}, **state)
    project.evidence = EvidenceState(trials={"SYS-1": found})


def _failed_test(project: Any) -> None:
    _by_test(project)
    _marked(project, "SYS-1")
    test = TestEvidence(requirement="SYS-1", test="tests/test_it.py::test_it", end=TestEnd.FAILED)
    evidence = SoftwareEvidence(requirement="SYS-1", tests=(test,), marks=project.marked, causes=())
    project.evidence = EvidenceState(software={"SYS-1": evidence})


def _verified(project: Any, result: RecordedResult, name: str = "SYS-1") -> Any:
    """The record of the requirement, under this id."""
    requirements = load_requirements(project.folder)
    record = new_record(project.folder, result=result, by="Reader", on="2026-05-12", today=date(2026, 5, 12))
    kept = with_record(requirements, ["SYS-1"], record)
    write_records(project.folder, {name: kept["SYS-1"]})
    project.evidence = EvidenceState(records=evidence_of_records(load_requirements(project.folder), project.folder))
    return project


def _unrecorded(project: Any) -> None:
    project.edit("system.yaml", CRITERION, "    criterion_exemption: The text says it.\n")
    project.evidence = EvidenceState()


def _exempt(rule: str) -> Callable[[Any], Any]:
    entry = f"    exempt:\n      - rule: {rule}\n        reason: there is none\n"
    return lambda project: project.append("system.yaml", entry)


def _setting(entry: str) -> Callable[[Any], Any]:
    return lambda project: project.append("rules.yaml", f"  {entry}\n")


BREAKS: Mapping[str, Break] = MappingProxyType(
    {rule.id: _text(rule.breaking[0]) for rule in RULES if isinstance(rule, SentenceRule)}
    | {
        "requirements.duplicate-id": Break(
            make=lambda p: p.append("architecture.yaml", "  - {id: SYS-1 , name: A, level: context, text: T.}\n"),
            file="architecture.yaml",
            start_of="SYS-1 ",
        ),
        "requirements.dangling-id": Break(
            make=lambda p: p.edit("system.yaml", "[STK-1]", "[STK-1, STK-9]"), file="system.yaml", start_of="STK-9"
        ),
        "requirements.wrong-kind": Break(
            make=lambda p: p.edit("system.yaml", "[BLK-1]", "[BLK-1, STK-1 ]"), file="system.yaml", start_of="STK-1 "
        ),
        "requirements.repeated-id": Break(
            make=lambda p: p.edit("system.yaml", "[BLK-1]", "[BLK-1, BLK-1 ]"), file="system.yaml", start_of="BLK-1 "
        ),
        "requirements.cycle": Break(
            make=lambda p: p.edit("system.yaml", "[STK-1]", "[STK-1, SYS-1 ]"), file="system.yaml", start_of="SYS-1 "
        ),
        "trace.dangling-id": _measure(lambda p: p.change("P", traces=("STK-1", "STK-9")), 2),
        "trace.duplicate-id": _measure(lambda p: p.add("P_g", MeasureKind.MOP, contributes_to=("P",)), 4),
        "trace.cycle": _measure(lambda p: p.change("P_g", contributes_to=("P", "P_g")), 3),
        "trace.orphan": Break(
            make=lambda p: p.append("system.yaml", REQUIREMENT.replace("    derived_from: [STK-1]\n", "")),
            file="system.yaml",
            start_of="SYS-2",
        ),
        "trace.childless": Break(
            make=lambda p: p.append("stakeholder.yaml", NEED).change("P", traces=("STK-1", "STK-2")),
            file="stakeholder.yaml",
            start_of="STK-2",
        ),
        "trace.no-moe": Break(
            make=lambda p: p.append("stakeholder.yaml", NEED).edit("system.yaml", "[STK-1]", "[STK-1, STK-2]"),
            file="stakeholder.yaml",
            start_of="STK-2",
        ),
        "trace.moe-without-need": _measure(lambda p: p.add("C", MeasureKind.MOE, observed=True), 4),
        "trace.moe-without-mop": _measure(lambda p: p.add("C", MeasureKind.MOE, traces=("STK-1",)), 4),
        "trace.mop-without-moe": _measure(lambda p: p.add("C", MeasureKind.MOP), 4),
        "trace.unallocated": Break(
            make=lambda p: p.append("system.yaml", REQUIREMENT.replace("    satisfied_by: [BLK-1]\n", "")),
            file="system.yaml",
            start_of="SYS-2",
        ),
        "trace.unallocated-behaviour": Break(
            make=lambda p: p.append("architecture.yaml", BEHAVIOUR).edit("system.yaml", "[BLK-1]", "[BLK-1, UC-1]"),
            file="architecture.yaml",
            start_of="UC-1",
        ),
        "trace.idle-element": Break(
            make=lambda p: p.append(
                "architecture.yaml", "  - {id: BLK-2, name: Arm, level: subsystem, text: Moves.}\n"
            ),
            file="architecture.yaml",
            start_of="BLK-2",
        ),
        "trace.no-method": Break(
            make=lambda p: p.edit("system.yaml", METHOD, ""), file="system.yaml", start_of="SYS-1"
        ),
        "trace.no-criterion": Break(
            make=lambda p: p.edit("system.yaml", CRITERION, ""), file="system.yaml", start_of="analysis"
        ),
        "trace.no-success": Break(
            make=lambda p: _by_test(p).edit("system.yaml", CRITERION, ""),
            file="system.yaml",
            start_of="test",
        ),
        "trace.unplanned": Break(
            make=lambda p: p.edit("system.yaml", "    facility: desk\n", ""), file="system.yaml", start_of="analysis"
        ),
        "trace.unknown-measure": Break(
            make=lambda p: p.edit("system.yaml", "measure: P,", "measure: Q,"), file="system.yaml", start_of="Q,"
        ),
        "trace.criterion-unit": Break(make=lambda p: p.change("P", unit="s"), file="system.yaml", start_of='"800 g"'),
        "trace.contradicting-number": Break(
            make=lambda p: p.edit("system.yaml", "0.8 kg", "0.9 kg"), file="system.yaml", start_of="The gripper shall"
        ),
        "trace.contradicting-comparison": Break(
            make=lambda p: p.edit("system.yaml", "at least", "at most"),
            file="system.yaml",
            start_of="The gripper shall",
        ),
        "trace.no-test": Break(make=lambda p: _marked(_by_test(p)), file="system.yaml", start_of="test\n"),
        "trace.unknown-mark": Break(make=lambda p: _marked(p, "SYS-9"), file="tests/test_it.py:7:2"),
        "evidence.none": Break(make=lambda p: _trials(p, Verdict.NOT_RUN), file="system.yaml", start_of="{measure"),
        "evidence.stale": Break(
            make=lambda p: _trials(p, Verdict.STALE, causes={1: (StaleCause.CODE,)}),
            file="system.yaml",
            start_of="{measure",
        ),
        "evidence.contradiction": Break(
            make=lambda p: _trials(p, Verdict.NOT_MET, recorded={1: Verdict.MET}),
            file="system.yaml",
            start_of="{measure",
        ),
        "evidence.failed-test": Break(make=_failed_test, file="system.yaml", start_of="test\n"),
        "evidence.no-record": Break(make=_unrecorded, file="system.yaml", start_of="analysis"),
        "evidence.failed-record": Break(
            make=lambda p: _verified(p, RecordedResult.NOT_MET), file="system.yaml", start_of="analysis"
        ),
        "evidence.unknown-record": Break(
            make=lambda p: _verified(p, RecordedResult.MET, "SYS-9"), file="verifications.yaml", start_of="SYS-9"
        ),
        "wording.duplicate": Break(
            make=lambda p: p.append("system.yaml", REQUIREMENT.replace("shall open.", "shall  lift at least 0.8 kg")),
            file="system.yaml",
            start_of="The gripper shall  lift",
        ),
        "review.missing": Break(
            make=lambda p: (p.write("rules.yaml", "rules: {}\n"), _reviewed(p, "STK-1")),
            file="system.yaml",
            start_of="SYS-1",
        ),
        "review.changed": Break(make=_changed_after_review, file="system.yaml", start_of="SYS-1"),
        "review.suspect-link": Break(make=_upstream_changed_after_review, file="system.yaml", start_of="STK-1"),
        "review.unknown-id": Break(make=_gone_after_review, file="reviews.yaml", start_of="BLK-2"),
        "exempt.unknown-rule": Break(make=_exempt("wording.R99"), file="system.yaml", start_of="wording.R99"),
        "exempt.unused": Break(make=_exempt("wording.R7"), file="system.yaml", start_of="wording.R7"),
        "settings.unknown-rule": Break(
            make=_setting("wording.R99: {enabled: false, reason: none}"), file="rules.yaml", start_of="wording.R99"
        ),
        "settings.unused": Break(
            make=_setting("wording.R7: {terms_removed: [green], reason: none}"), file="rules.yaml", start_of="green"
        ),
    }
)


@pytest.mark.verifies("SYS-030")
def test_the_sound_project_breaks_no_rule(project):
    assert project.findings() == []


@pytest.mark.verifies("SYS-030")
@pytest.mark.parametrize("rule", RULES, ids=lambda rule: rule.id)
def test_a_minimal_document_yields_exactly_that_finding(project, rule):
    assert rule.id in BREAKS, f"say how the smallest project breaks {rule.id!r}"
    way = BREAKS[rule.id]
    way.make(project)
    found = project.found()

    assert [each.rule for each in found] == [rule.id], "\n".join(map(str, found)) or "the rule is not broken"
    (finding,) = found
    assert finding.severity == rule.severity
    assert f"{finding.file}:{finding.line}:{finding.column}" == way.place(project)
    assert finding.hint or rule.id in NEED_NO_HINT
    assert "\n" not in str(finding)


def test_no_break_is_of_a_rule_that_is_gone():
    assert set(BREAKS) == {rule.id for rule in RULES}
