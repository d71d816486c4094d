"""Values of a comparison: one metric of one phase with its baseline."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from enum import Enum

import numpy as np
from numpy.typing import NDArray

Series = Mapping[int, Mapping[int, float | None]]
"""Values by variant and seed; None where a trial does not tell."""

WHOLE_TRIAL = "trial"
"""In place of a phase: over the whole trial."""


class Outcome(str, Enum):
    """Outcome of the comparison of one metric."""

    BETTER = "better"
    MOVED = "moved"
    SAME = "same"
    WORSE = "worse"
    INCONCLUSIVE = "inconclusive"
    MISSING = "missing"

    @property
    def is_final(self) -> bool:
        """True if more seeds change nothing about it."""
        return self is not Outcome.INCONCLUSIVE


@dataclass(frozen=True, slots=True, kw_only=True, order=True)
class Subject:
    """Compared quantity: a metric of a run at a phase.

    Attributes:
        run: The run whose trials observe it.
        metric: The metric.
        phase: The phase, or ``trial``.
    """

    run: str
    metric: str
    phase: str

    def __str__(self) -> str:
        return f"{self.metric} at {self.phase}" if self.phase != WHOLE_TRIAL else f"{self.metric} of the trial"


@dataclass(frozen=True, slots=True, kw_only=True)
class Guard:
    """Bounds within which a metric may move.

    Attributes:
        unit: Its unit.
        higher_is_better: Whether more of it is better.
        margin: How far it may move, in its unit; above 0.
        is_success: Whether it is 1 or 0 in each trial.
        both_ways: Whether neither direction is better: a move by more than the margin is a change either way.
        relative: Share of the baseline's mean that is the margin where that is more than `margin`; 0 if none.
    """

    unit: str
    higher_is_better: bool
    margin: float
    is_success: bool
    both_ways: bool = False
    relative: float = 0.0

    @property
    def direction(self) -> str:
        """``higher``, ``lower`` or ``neither``: which direction is better."""
        return "neither" if self.both_ways else "higher" if self.higher_is_better else "lower"

    def for_baseline(self, mean: float | None) -> Guard:
        """Copy with the margin derived from a baseline's mean.

        Args:
            mean: The mean of the baseline's values; None if there are none.
        """
        if mean is None or not self.relative:
            return self
        return replace(self, margin=max(self.margin, self.relative * abs(mean)))


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Pairs:
    """Paired trials of the baseline and the present, by variant and seed, with the metric in both.

    Attributes:
        worsening: Mean deterioration of each seed over its variants, shape (n,).
        net: For success, number of worse minus better variants of each seed.
        worse_seeds: Number of seeds that are worse on some variant.
        better_seeds: Number of seeds that are better on some variant.
        count: Number of pairs.
        lost: Number of pairs of the baseline that are missing now.
        baseline_mean: Mean of the baseline's values in the pairs.
        current_mean: Mean of the present ones.
    """

    worsening: NDArray[np.float64]
    net: tuple[int, ...]
    worse_seeds: int
    better_seeds: int
    count: int
    lost: int
    baseline_mean: float
    current_mean: float


@dataclass(frozen=True, slots=True, kw_only=True)
class Comparison:
    """Comparison of a metric with its baseline.

    Attributes:
        subject: Compared quantity: a metric of a run at a phase.
        guard: Its guard.
        outcome: The outcome.
        worsening: Deterioration in its unit; negative if better; None if unknown. Without a preferred direction, the
        increase.
        low: Lower end of a 95 % interval of that.
        high: Upper end.
        baseline_mean: The baseline's mean over the pairs.
        current_mean: The present mean.
        pairs: Number of compared trials.
        lost: Number of missing values of the baseline.
        seeds: Number of seeds.
        look: The deciding look, or the last.
        identical: True if every trial of its run is bitwise equal, which needs no statistics.
        p_values: The adjusted p-values; empty if there are none. Without a preferred direction, ``worse`` is that of an
        increase.
    """

    subject: Subject
    guard: Guard
    outcome: Outcome
    worsening: float | None
    low: float | None
    high: float | None
    baseline_mean: float | None
    current_mean: float | None
    pairs: int
    lost: int
    seeds: int
    look: int
    identical: bool = False
    p_values: Mapping[str, float] = field(default_factory=dict, hash=False)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Candidate:
    """A comparison that is to be judged.

    Attributes:
        subject: Compared quantity: a metric of a run at a phase.
        guard: How it may move.
        baseline: The baseline's values.
        current: The present values.
        seeds: The seeds that were run by now.
        identical: Whether all trials of the run are the same bit by bit.
    """

    subject: Subject
    guard: Guard
    baseline: Series
    current: Series
    seeds: tuple[int, ...]
    identical: bool
