"""What a comparison with the baseline came to."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import Enum

from rgss.regression.comparing import Comparison, Outcome


class Trouble(str, Enum):
    """Why the guard fails beside a metric that is worse."""

    MISSING_METRIC = "missing metric"
    FEWER_REPLICATES = "fewer replicates"
    CHANGED_SCHEMA = "changed schema"
    NOT_RUN = "not run"
    UNSTABLE = "unstable"


@dataclass(frozen=True, slots=True, kw_only=True)
class Failing:
    """One thing for which the guard fails.

    Attributes:
        trouble: What kind of thing.
        text: What is wrong, in one line.
    """

    trouble: Trouble
    text: str


@dataclass(frozen=True, slots=True, kw_only=True)
class ChangedTrial:
    """A trial that is not what it was bit by bit.

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
    """Whether trials are the same bit by bit.

    Attributes:
        compared: How many trials; 0 on another platform.
        changed: Those that are not.
        platform: Why nothing was compared; empty if it was.
    """

    compared: int
    changed: tuple[ChangedTrial, ...]
    platform: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class RegressionReport:
    """What a comparison with the baseline came to.

    Attributes:
        study: The study's file.
        baseline: The baseline's file.
        comparisons: Every metric, by run, metric and phase.
        behaviour: Whether trials are the same bit by bit.
        failing: What fails beside metrics that are worse or missing.
        notes: What is told of the decision and the inputs and does not fail.
        looks: How often was looked.
        trials: How many trials each run took for each variant.
        error_rate: The probability of any false alarm.
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

    def of(self, *outcomes: Outcome) -> tuple[Comparison, ...]:
        """The comparisons with one of some outcomes."""
        return tuple(one for one in self.comparisons if one.outcome in outcomes)

    @property
    def fails(self) -> bool:
        """Whether anything is worse, missing, unstable or otherwise failing."""
        return bool(self.failing or self.of(Outcome.WORSE, Outcome.MISSING))

    @property
    def incomplete(self) -> bool:
        """Whether a trial could not be run, so that something was not compared at all."""
        return any(one.trouble is Trouble.NOT_RUN for one in self.failing)

    @property
    def verdict(self) -> str:
        """One word: ``failed``, ``worse``, ``inconclusive``, ``better`` or ``same``."""
        if self.failing or self.of(Outcome.MISSING):
            return "failed"
        for outcome in (Outcome.WORSE, Outcome.INCONCLUSIVE, Outcome.BETTER):
            if self.of(outcome):
                return str(outcome.value)
        return str(Outcome.SAME.value)
