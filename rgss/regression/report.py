"""Report of a comparison with the baseline."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import Enum

from rgss.regression.comparing import Comparison, Outcome, Subject
from rgss.regression.input_changes import InputChange, InputKind
from rgss.regression.power import Power


class FailureCause(str, Enum):
    """Cause of a failed guard other than a worse metric."""

    MISSING_METRIC = "missing metric"
    FEWER_REPLICATES = "fewer replicates"
    CHANGED_SCHEMA = "changed schema"
    INCONSISTENT_BASELINE = "inconsistent baseline"
    NOT_RUN = "not run"
    UNSTABLE = "unstable"


@dataclass(frozen=True, slots=True, kw_only=True)
class Failing:
    """Failure of the guard.

    Attributes:
        trouble: Kind of the failure.
        text: Description, in one line.
    """

    trouble: FailureCause
    text: str


@dataclass(frozen=True, slots=True, kw_only=True)
class ChangedTrial:
    """Trial with a record that is not bitwise equal to the baseline.

    Attributes:
        run: Its run.
        variant: Its variant.
        seed: Its seed.
        phase: The first phase that differs.
    """

    run: str
    variant: int
    seed: int
    phase: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Behaviour:
    """Comparison of the trials' records bit by bit.

    Attributes:
        compared: How many trials were compared.
        changed: Those whose records differ.
        machine: The machines of both sides if they differ and nothing else does, so that differing records
            may be the machine's; empty otherwise.
    """

    compared: int
    changed: tuple[ChangedTrial, ...]
    machine: str = ""

    @property
    def is_changed(self) -> bool:
        """True if records differ for another reason than the machine."""
        return bool(self.changed) and not self.machine


@dataclass(frozen=True, slots=True, kw_only=True)
class RegressionReport:
    """Report of a comparison with the baseline.

    Attributes:
        study: The study's file.
        baseline: The baseline's file.
        comparisons: Every metric, by run, metric and phase.
        behaviour: Bitwise comparison of the trials' records.
        failing: Failures other than worse or missing metrics.
        notes: Reported changes of the decision and the inputs that are not failures.
        looks: Number of looks.
        trials: Number of trials of each run for each variant.
        error_rate: The probability of any false alarm.
        inputs: The inputs that differ from those of the baseline.
        powers: The power of the comparisons, by subject.
        accepted: The stated reason for which changed behaviour is accepted in this run; empty if none.
        undecided: Changes of the decision that may be chance, and are not shown to be.
    """

    study: str
    baseline: str
    comparisons: tuple[Comparison, ...]
    behaviour: Behaviour
    failing: tuple[Failing, ...]
    notes: tuple[str, ...]
    looks: int
    trials: Mapping[str, int] = field(hash=False)
    error_rate: float
    inputs: tuple[InputChange, ...] = ()
    powers: Mapping[Subject, Power] = field(default_factory=dict, hash=False)
    accepted: str = ""
    undecided: tuple[str, ...] = ()

    def of(self, *outcomes: Outcome) -> tuple[Comparison, ...]:
        """The comparisons with one of some outcomes."""
        return tuple(one for one in self.comparisons if one.outcome in outcomes)

    @property
    def fails(self) -> bool:
        """True if anything is worse, missing, unstable or otherwise failing."""
        return bool(self.failing or self.of(Outcome.WORSE, Outcome.MISSING))

    @property
    def is_inconclusive(self) -> bool:
        """True if the seeds leave a metric, or a change of the decision, open."""
        return bool(self.undecided or self.of(Outcome.INCONCLUSIVE))

    @property
    def incomplete(self) -> bool:
        """True if a trial could not be run, so that the comparison is incomplete."""
        return any(one.trouble is FailureCause.NOT_RUN for one in self.failing)

    @property
    def has_changes(self) -> bool:
        """True if anything changed that needs a stated reason.

        Records that are not the same bit by bit, another version of an engine or other numerics, under which
        no trial but the few that are watched is known to be the same, and any metric that moved by more than
        its margin, for better or worse. Code and values that leave every record as it was need none.
        """
        engines = any(one.kind is InputKind.ENGINE for one in self.inputs)
        return self.behaviour.is_changed or engines or bool(self.of(Outcome.BETTER, Outcome.MOVED, Outcome.WORSE))

    @property
    def is_unexplained(self) -> bool:
        """True if anything changed and no reason is stated."""
        return self.has_changes and not self.accepted

    @property
    def verdict(self) -> str:
        """One word: ``failed``, ``worse``, ``changed``, ``inconclusive``, ``moved``, ``better`` or ``same``."""
        if self.failing or self.of(Outcome.MISSING):
            return "failed"
        if self.of(Outcome.WORSE):
            return str(Outcome.WORSE.value)
        if self.is_unexplained:
            return "changed"
        if self.is_inconclusive:
            return str(Outcome.INCONCLUSIVE.value)
        for outcome in (Outcome.MOVED, Outcome.BETTER):
            if self.of(outcome):
                return str(outcome.value)
        return str(Outcome.SAME.value)
