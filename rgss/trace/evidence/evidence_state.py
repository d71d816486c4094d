"""State of the evidence for each requirement, as the rules of evidence see it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType

from rgss.measures import StaleCause, Verdict
from rgss.trace.evidence.record_evidence import RecordEvidence
from rgss.trace.evidence.software import SoftwareEvidence


@dataclass(frozen=True, slots=True, kw_only=True)
class TrialVerdicts:
    """Verdicts of one requirement with a criterion.

    Attributes:
        requirement: Its id.
        verdicts: Present verdict of the evidence, for each variant by its id.
        recorded: Last recorded verdict of each variant; empty without recorded verdicts.
        causes: Causes of staleness of each variant with a stale verdict.
    """

    requirement: str
    verdicts: Mapping[int, Verdict]
    recorded: Mapping[int, Verdict]
    causes: Mapping[int, tuple[StaleCause, ...]]

    def variants(self, verdict: Verdict) -> tuple[int, ...]:
        """The variants on which it is the verdict now."""
        return tuple(variant for variant, one in self.verdicts.items() if one is verdict)

    @property
    def all_causes(self) -> tuple[StaleCause, ...]:
        """Causes of staleness over all variants, in the order of `StaleCause`."""
        there = {cause for causes in self.causes.values() for cause in causes}
        return tuple(cause for cause in StaleCause if cause in there)

    @property
    def contradicted(self) -> tuple[int, ...]:
        """Variants whose recorded verdict is another one than the evidence gives now.

        A verdict that is stale, or for which nothing was run, contradicts nothing.
        """
        undecided = (Verdict.STALE, Verdict.NOT_RUN)
        return tuple(
            variant
            for variant, now in self.verdicts.items()
            if now not in undecided and self.recorded.get(variant, now) not in (now, *undecided)
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class FailedVerifications:
    """Requirements that no design meets, as other evidence than trials shows.

    Attributes:
        tests: Ids of those of which a marked test of the project failed.
        records: Ids of those that a verification record says are not met.
    """

    tests: tuple[str, ...] = ()
    records: tuple[str, ...] = ()

    @property
    def requirements(self) -> tuple[str, ...]:
        """Ids of all of them, each once."""
        return tuple(dict.fromkeys((*self.tests, *self.records)))


@dataclass(frozen=True, slots=True, kw_only=True)
class EvidenceState:
    """Evidence of a project.

    Attributes:
        trials: Verdicts of each requirement with a criterion, by id.
        software: Test evidence of each requirement verified by test, by id; None if the project has no tests.
        records: Verification record of each requirement that has one, by id.
    """

    trials: Mapping[str, TrialVerdicts] = field(default_factory=lambda: MappingProxyType({}))
    software: Mapping[str, SoftwareEvidence] | None = None
    records: Mapping[str, RecordEvidence] = field(default_factory=lambda: MappingProxyType({}))

    @property
    def failed(self) -> FailedVerifications:
        """The requirements that are not met by a result of tests, or by a record, that still holds."""
        return FailedVerifications(
            tests=tuple(name for name, one in (self.software or {}).items() if one.verdict is Verdict.NOT_MET),
            records=tuple(name for name, one in self.records.items() if one.verdict is Verdict.NOT_MET),
        )
