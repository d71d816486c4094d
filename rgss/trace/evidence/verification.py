"""The requirements verification matrix (NASA Systems Engineering Handbook, table D-1)."""

from __future__ import annotations

from dataclasses import dataclass

from rgss.measures import Estimate, StaleCause, Verdict
from rgss.requirements import Requirement
from rgss.trace.evidence.record_evidence import RecordEvidence
from rgss.trace.evidence.software import TestEvidence
from rgss.trace.evidence.verdict_evidence import TraceEvidence, TrialEvidence
from rgss.trace.model import TraceModel


@dataclass(frozen=True, slots=True, kw_only=True)
class VerificationRow:
    """Verification of one system requirement, and its result.

    Attributes:
        requirement: The requirement.
        document: Position of its declaration, as ``file:line``.
        success: Its success criterion in words; the stated reason if it has none.
        verdict: The verdict; None if no variant is shown and the variants differ.
        causes: Causes of a stale verdict.
        estimate: The estimate of the criterion's measure for the shown variant; None without one.
        variant: The shown variant; None if a test decides or there is none.
        trials: The trials that decide.
        tests: The tests that verify it.
        record: Its verification record; None without one.
        tally: Number of variants by verdict, best first; empty if tests decide.
    """

    requirement: Requirement
    document: str
    success: str
    verdict: Verdict | None
    causes: tuple[StaleCause, ...]
    estimate: Estimate | None
    variant: int | None
    trials: tuple[TrialEvidence, ...]
    tests: tuple[TestEvidence, ...]
    record: RecordEvidence | None
    tally: tuple[tuple[Verdict, int], ...]

    @property
    def has_gap(self) -> bool:
        """True if anything is open: the method, the criterion, the evidence, or that it is met."""
        return self.requirement.verification is None or not self.success or self.verdict is not Verdict.MET


def verification_matrix(model: TraceModel, evidence: TraceEvidence) -> tuple[VerificationRow, ...]:
    """One row for each system requirement, in the order of its file.

    Args:
        model: The project's requirements, architecture and measures.
        evidence: Evidence of the project.
    """
    return tuple(_row(model, evidence, requirement) for requirement in model.requirements.system)


def success_criterion(requirement: Requirement) -> str:
    """Criterion or success condition of a requirement, or why it has none, in words; empty while that is open."""
    if requirement.criterion is not None:
        return str(requirement.criterion)
    exemption = requirement.criterion_exemption
    return requirement.success or (f"none: {exemption}" if exemption else "")


def _row(model: TraceModel, evidence: TraceEvidence, requirement: Requirement) -> VerificationRow:
    place = model.requirements.finding("", requirement.id, "")
    measure = None if requirement.criterion is None else requirement.criterion.measure
    shown = None if measure is None else evidence.shown
    return VerificationRow(
        requirement=requirement,
        document=f"{place.file}:{place.line}",
        success=success_criterion(requirement),
        verdict=evidence.verdict(requirement),
        causes=evidence.causes(requirement),
        estimate=shown.estimates.get(measure) if shown is not None and measure is not None else None,
        variant=None if shown is None else shown.variant,
        trials=shown.deciding_trials(measure) if shown is not None and measure is not None else (),
        tests=evidence.tests(requirement.id),
        record=evidence.record(requirement.id),
        tally=evidence.tally(requirement.id),
    )
