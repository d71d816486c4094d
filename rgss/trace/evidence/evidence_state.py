"""State of the evidence for each requirement, as the rules of evidence see it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType

from rgss.measures import StaleCause, Verdict
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
class EvidenceState:
    """Evidence of a project.

    Attributes:
        trials: Verdicts of each requirement with a criterion, by id.
        software: Test evidence of each requirement verified by test, by id; None if the project has no tests.
    """

    trials: Mapping[str, TrialVerdicts] = field(default_factory=lambda: MappingProxyType({}))
    software: Mapping[str, SoftwareEvidence] | None = None

    @property
    def failed_tests(self) -> tuple[str, ...]:
        """Ids of the requirements of which a marked test failed, by a result that still holds."""
        return tuple(name for name, one in (self.software or {}).items() if one.verdict is Verdict.NOT_MET)
