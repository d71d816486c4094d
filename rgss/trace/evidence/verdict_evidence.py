"""Verdicts and their evidence, as matrices, chains and reports show them."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType

from rgss.evidence.records import Metric
from rgss.measures import Estimate, StaleCause, Verdict
from rgss.requirements import Requirement
from rgss.trace.evidence.evidence_state import EvidenceState
from rgss.trace.evidence.record_evidence import RecordEvidence
from rgss.trace.evidence.software import SoftwareEvidence, TestEvidence

KEY_DIGITS = 12
"""Number of digits of a trial's key that name it, as `rgss replay` takes it."""

_WORST_FIRST = (Verdict.NOT_MET, Verdict.STALE, Verdict.NOT_RUN, Verdict.INCONCLUSIVE, Verdict.MET)


@dataclass(frozen=True, slots=True, kw_only=True)
class TrialEvidence:
    """One stored trial.

    Attributes:
        key: Its key in the evidence store.
        variant: Id of its variant.
        seed: Its seed.
        fidelity: Its fidelity, such as ``contact``.
        outcome: ``success``, or the failure.
        values: The value of each measure in this trial, in the measure's unit; None if not observed.
        metrics: Its metrics, by name with unit, such as ``slip_m``.
    """

    key: str
    variant: int
    seed: int
    fidelity: str
    outcome: str
    values: Mapping[str, float | None]
    metrics: Mapping[str, Metric] = field(default_factory=lambda: MappingProxyType({}))

    @property
    def replay_command(self) -> str:
        """The command that runs it again and compares it bit for bit."""
        return f"rgss replay {self.key[:KEY_DIGITS]}"

    @property
    def run_command(self) -> str:
        """The command that runs it and shows it phase by phase."""
        return f"rgss run {self.variant} --seed {self.seed} --fidelity {self.fidelity}"


@dataclass(frozen=True, slots=True, kw_only=True)
class VariantEvidence:
    """Evidence of one variant.

    Attributes:
        variant: Its id.
        trials: Its trials, in the order of their seeds.
        missing: How many of its trials have no evidence.
        estimates: The estimate of each measure by its id.
        deciding: For each measure, the keys of the trials that its estimate depends on; none for
            a measure that follows from the design alone.
    """

    variant: int
    trials: tuple[TrialEvidence, ...]
    missing: int
    estimates: Mapping[str, Estimate]
    deciding: Mapping[str, tuple[str, ...]]

    def deciding_trials(self, measure: str) -> tuple[TrialEvidence, ...]:
        """The trials that the estimate of a measure depends on."""
        keys = frozenset(self.deciding.get(measure, ()))
        return tuple(trial for trial in self.trials if trial.key in keys)


@dataclass(frozen=True, slots=True, kw_only=True)
class TraceEvidence:
    """Evidence of a project: trials, verdicts and test results.

    Attributes:
        shown: The variant whose trials and verdicts are shown; None if there is none to show.
        choice: Reason for this variant, or for none.
        variants: Number of variants of the study.
        state: Verdicts of all variants, and test results.
        sweep: The command that makes the evidence of these trials.
    """

    shown: VariantEvidence | None = None
    choice: str = "no evidence was read"
    variants: int = 0
    state: EvidenceState = field(default_factory=EvidenceState)
    sweep: str = "rgss sweep"

    def tests(self, requirement_id: str) -> tuple[TestEvidence, ...]:
        """The tests that verify a requirement, each with how it ended."""
        software = self._software(requirement_id)
        return () if software is None else software.tests

    def all_tests(self) -> Mapping[str, TestEvidence]:
        """Every test that verifies a requirement, by its id."""
        software = self.state.software or {}
        return {test.test: test for one in software.values() for test in one.tests}

    def record(self, requirement_id: str) -> RecordEvidence | None:
        """The verification record of a requirement; None without one."""
        return self.state.records.get(requirement_id)

    def verdict(self, requirement: Requirement) -> Verdict | None:
        """Verdict of the evidence on a requirement.

        A criterion is judged on the shown variant; without one the tests and the verification record decide, the
        worst of them. A marked test that failed, and a record that says not met, outweigh what trials show.

        Returns:
            The verdict; None where no variant is shown and the variants do not agree.
        """
        other = self._beside_trials(requirement.id)
        if other is not None and (requirement.criterion is None or other is Verdict.NOT_MET):
            return other
        if requirement.criterion is None:
            return Verdict.NOT_RUN
        verdicts = self._verdicts(requirement.id)
        if self.shown is not None:
            return verdicts.get(self.shown.variant, Verdict.NOT_RUN)
        found = set(verdicts.values()) or {Verdict.NOT_RUN}
        return found.pop() if len(found) == 1 else None

    def causes(self, requirement: Requirement) -> tuple[StaleCause, ...]:
        """Changes since the evidence for a requirement, where its verdict is stale."""
        if self.verdict(requirement) is not Verdict.STALE:
            return ()
        software, trials = self._software(requirement.id), self.state.trials.get(requirement.id)
        if requirement.criterion is None:
            record = self.record(requirement.id)
            found = {*(() if software is None else software.causes), *(() if record is None else record.causes)}
            return tuple(cause for cause in StaleCause if cause in found)
        if trials is None:
            return ()
        return trials.all_causes if self.shown is None else trials.causes.get(self.shown.variant, ())

    def tally(self, requirement_id: str) -> tuple[tuple[Verdict, int], ...]:
        """Number of variants by their verdict on a requirement; empty if no criterion decides."""
        counts = Counter(self._verdicts(requirement_id).values())
        return tuple((verdict, counts[verdict]) for verdict in Verdict if counts[verdict])

    def has_evidence(self, requirement: Requirement) -> bool:
        """True if there is evidence that holds now: trials, the design, a test that was run, or a record."""
        verdict = self.verdict(requirement)
        if requirement.criterion is not None:
            return verdict not in (Verdict.NOT_RUN, Verdict.STALE)
        if verdict is Verdict.STALE:
            return False
        return self.record(requirement.id) is not None or any(
            test.end is not None for test in self.tests(requirement.id)
        )

    def _beside_trials(self, requirement_id: str) -> Verdict | None:
        """Verdict of tests and record, the worst of both; None without either."""
        software, record = self._software(requirement_id), self.record(requirement_id)
        found = {one.verdict for one in (software, record) if one is not None}
        return next((verdict for verdict in _WORST_FIRST if verdict in found), None)

    def _verdicts(self, requirement_id: str) -> Mapping[int, Verdict]:
        trials = self.state.trials.get(requirement_id)
        return {} if trials is None else trials.verdicts

    def _software(self, requirement_id: str) -> SoftwareEvidence | None:
        return (self.state.software or {}).get(requirement_id)
