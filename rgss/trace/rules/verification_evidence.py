"""Rules of evidence: each verification has evidence, and that of the present files."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from rgss.findings import Severity
from rgss.measures import StaleCause, Verdict
from rgss.requirements import VerificationMethod
from rgss.trace.evidence import EvidenceState, TestEnd
from rgss.trace.model import TraceModel
from rgss.trace.rules.rule import EvidenceRule, Violation

_SHOWN = 6


def _none(_: TraceModel, evidence: EvidenceState) -> Iterator[Violation]:
    for name, trials in evidence.trials.items():
        open_ones = trials.variants(Verdict.NOT_RUN)
        if open_ones:
            message = f"{name!r} has no evidence for {_variants(open_ones, len(trials.verdicts))}"
            yield Violation(subject=name, message=message, hint="rgss sweep", at=("criterion",))
    for name, software in (evidence.software or {}).items():
        if software.verdict is Verdict.NOT_RUN and software.marks:
            missing = sum(test.end is not TestEnd.PASSED for test in software.tests)
            message = f"{name!r} has no result of {missing} of the {len(software.tests)} tests that verify it"
            yield Violation(
                subject=name, message=message, hint="pytest --junitxml=.rgss/junit.xml", at=("verification",)
            )


def _unrecorded(model: TraceModel, evidence: EvidenceState) -> Iterator[Violation]:
    decided = {name for name, software in (evidence.software or {}).items() if software.tests} | set(evidence.records)
    for requirement in model.requirements.system:
        method, name = requirement.verification, requirement.id
        if method is None or requirement.criterion is not None or name in decided:
            continue
        # Where the project has tests of its own, trace.no-test asks for one.
        if method is not VerificationMethod.TEST or evidence.software is None:
            message = f"{name!r} is verified by {method.value}, and nothing records it"
            hint = f"rgss verify {name} --result met --by NAME --on DATE, or mark a test with it"
            yield Violation(subject=name, message=message, hint=hint, at=("verification",))


def _not_met_by_record(_: TraceModel, evidence: EvidenceState) -> Iterator[Violation]:
    for name, found in evidence.records.items():
        if found.verdict is Verdict.NOT_MET:
            message = f"{name!r} is not met, as {found.record.by} found on {found.record.date}"
            hint = f"mend it, then 'rgss verify {name}'"
            yield Violation(subject=name, message=message, hint=hint, at=("verification",))


def _of_nothing(model: TraceModel, _: EvidenceState) -> Iterator[Violation]:
    known = {requirement.id for requirement in model.requirements.system}
    for name, place in model.requirements.record_places.items():
        if name not in known:
            message = f"there is no system requirement {name!r} that this would be the verification of"
            hint = "the next 'rgss verify' removes it"
            yield Violation(subject=place, message=message, hint=hint, at=(), at_key=True)


def _stale(_: TraceModel, evidence: EvidenceState) -> Iterator[Violation]:
    for name, trials in evidence.trials.items():
        old_ones = trials.variants(Verdict.STALE)
        if old_ones:
            what = _causes(trials.all_causes)
            message = f"{name!r} has stale evidence for {_variants(old_ones, len(trials.verdicts))}: {what}"
            hint = "rgss sweep, then rgss measure --record"
            yield Violation(subject=name, message=message, hint=hint, at=("criterion",))
    for name, software in (evidence.software or {}).items():
        if software.verdict is Verdict.STALE:
            message = f"{name!r} was tested before: {_causes(software.causes)}"
            yield Violation(
                subject=name, message=message, hint="pytest --junitxml=.rgss/junit.xml", at=("verification",)
            )
    for name, found in evidence.records.items():
        if found.verdict is Verdict.STALE:
            files = f" ({', '.join(found.changed)})" if found.changed else ""
            message = f"{name!r} was verified by {found.record.by} before: {_causes(found.causes)}{files}"
            hint = f"verify it again, then 'rgss verify {name}'"
            yield Violation(subject=name, message=message, hint=hint, at=("verification",))


def _contradiction(_: TraceModel, evidence: EvidenceState) -> Iterator[Violation]:
    for name, trials in evidence.trials.items():
        for variant in trials.contradicted:
            recorded, now = trials.recorded[variant].value, trials.verdicts[variant].value
            message = f"{name!r} is recorded as {recorded} by variant {variant}, but the evidence says {now}"
            hint = "see what changed, then 'rgss measure --record'"
            yield Violation(subject=name, message=message, hint=hint, at=("criterion",))


def _failed(_: TraceModel, evidence: EvidenceState) -> Iterator[Violation]:
    for name, software in (evidence.software or {}).items():
        if software.verdict is Verdict.NOT_MET:
            failed = [test.test for test in software.tests if test.end is TestEnd.FAILED]
            more = f" and {len(failed) - 1} more" if len(failed) > 1 else ""
            message = f"{name!r} is not met: {failed[0]}{more} failed"
            yield Violation(
                subject=name, message=message, hint="fix it, then run the tests again", at=("verification",)
            )


def _variants(ids: Sequence[int], total: int) -> str:
    if len(ids) == total:
        return f"any of the {total} variants"
    listed = ", ".join(map(str, ids[:_SHOWN])) + (", …" if len(ids) > _SHOWN else "")
    return f"{len(ids)} of {total} variants ({listed})"


def _causes(causes: Sequence[StaleCause]) -> str:
    if StaleCause.UNRECORDED in causes:
        return "the run did not record what it tested"
    names = [f"the {cause.value}" for cause in causes]
    verb = "has" if len(names) == 1 and causes[0] not in (StaleCause.ENGINES, StaleCause.FILES) else "have"
    return f"{' and '.join(names) or 'something'} {verb} changed since"


RULES: tuple[EvidenceRule, ...] = (
    EvidenceRule(
        id="evidence.none",
        severity=Severity.WARNING,
        explanation=(
            "Each planned verification has evidence: trials of each variant for a criterion, a result of each "
            "marked test for a requirement that is verified by test."
        ),
        check=_none,
    ),
    EvidenceRule(
        id="evidence.stale",
        severity=Severity.WARNING,
        explanation=(
            "Evidence is no older than what it is evidence for: the requirement, the definition of its measure and "
            "of all below it, the model, the code, the engines, the files of a verification record. Digests of content "
            "determine age, not clocks."
        ),
        check=_stale,
    ),
    EvidenceRule(
        id="evidence.contradiction",
        severity=Severity.ERROR,
        explanation=(
            "A verdict that was recorded is the one that the evidence gives. Where it is not, evidence was added, "
            "or somebody changed the record or the judging."
        ),
        check=_contradiction,
    ),
    EvidenceRule(
        id="evidence.failed-test",
        severity=Severity.ERROR,
        explanation="Each test that is marked with a requirement passes; one that fails shows that it is not met.",
        check=_failed,
    ),
    EvidenceRule(
        id="evidence.no-record",
        severity=Severity.WARNING,
        explanation=(
            "A requirement that neither a criterion nor a marked test decides has a verification record ('rgss "
            "verify'): what a person found who inspected, demonstrated, analysed or tested it."
        ),
        check=_unrecorded,
    ),
    EvidenceRule(
        id="evidence.failed-record",
        severity=Severity.ERROR,
        explanation="No verification record that still holds says that its requirement is not met.",
        check=_not_met_by_record,
    ),
    EvidenceRule(
        id="evidence.unknown-record",
        of_elements=False,
        severity=Severity.WARNING,
        explanation="A verification record is of a system requirement that is there.",
        check=_of_nothing,
    ),
)
