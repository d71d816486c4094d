"""Drivers of failures: draws that differ between the trials of a design with one kind of failure and its others."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from enum import Enum

import numpy as np
from numpy.typing import NDArray

from rgss.assessment.seed_permutations import permutation_p_values
from rgss.assessment.within_designs import Mask, WithinDesigns, weighted_auc
from rgss.evidence import Failure, TrialRecord

Array = NDArray[np.float64]

SIGNIFICANT = 0.05
"""Adjusted p below which a quantity is called a driver."""

_FEWEST = 3
_CARRY = "carry"


class Aspect(str, Enum):
    """Part of a draw that is compared."""

    VALUE = "value"
    SIZE = "size"
    CASE = "case"


@dataclass(frozen=True, slots=True, kw_only=True)
class Driver:
    """Association of one quantity with one kind of failure.

    Attributes:
        quantity: Name of the draw, or of the case of the workload.
        aspect: The compared quantity: draws, their distances from the median draw, or trials of a case against others.
        auc: Probability that a trial with the failure has a greater value than one of the same design without; 0.5
            without effect.
        p: Two-sided p-value of a permutation of the draws over the seeds that the same designs ran with.
        adjusted_p: The same, adjusted by Holm for all quantities and kinds of failure.
    """

    quantity: str
    aspect: Aspect
    auc: float
    p: float
    adjusted_p: float


@dataclass(frozen=True, slots=True, kw_only=True)
class FailureDrivers:
    """One kind of failure with its drivers.

    Attributes:
        failure: The kind.
        stage: Part of the task in which it occurred: ``carry`` for the moves with the object, else the phase, since a
            drop during the carry has other causes than one at the place.
        trials: Number of trials with it.
        seeds: Number of their seeds.
        designs: Number of designs that are compared: those with trials of both kinds.
        drivers: Each quantity at its stronger aspect, the least adjusted p first, then the AUC farthest from 0.5.
    """

    failure: Failure
    stage: str
    trials: int
    seeds: int
    designs: int
    drivers: tuple[Driver, ...]

    @property
    def significant(self) -> tuple[Driver, ...]:
        """The drivers with an adjusted p below the limit."""
        return tuple(one for one in self.drivers if one.adjusted_p < SIGNIFICANT)


@dataclass(frozen=True, slots=True, kw_only=True)
class DriversOfFailures:
    """All kinds of failure of some trials with their drivers.

    Attributes:
        trials: Number of trials.
        seeds: Number of their seeds.
        failures: The kinds that a draw could drive, the most frequent first.
        too_few: Kinds that occurred, at each stage, with fewer than three seeds, or whose absence did, of the designs
            that show both.
    """

    trials: int
    seeds: int
    failures: tuple[FailureDrivers, ...]
    too_few: tuple[Failure, ...]


def drivers_of_failures(records: Sequence[TrialRecord], *, carried: Collection[str]) -> DriversOfFailures:
    """Compare the draws of failed trials with those of the other trials of the same design, for each kind of failure.

    Designs fail by their own parameters too, and may have other seeds than others: pooled trials would take the one
    for the effect of a draw, or hide it (Simpson 1951). The AUC is that of Mann and Whitney (1947) within designs,
    combined as Mantel and Haenszel (1959) combine strata. p is that of a permutation of the draws over the seeds that
    the same designs ran with, since designs share the draws of a seed and are not independent observations. The
    permuted statistic is the rank sum of a design's failures less its expectation, summed over designs: the score of a
    logistic regression that is conditional on the failures of each design (Breslow and Day 1980). With one design this
    is the permutation test of Mann and Whitney.

    Args:
        records: The trials.
        carried: The moves of the task with an object in the hand.
    """
    table = _Table(records, carried)
    kinds = {kind for one in records if (kind := _kind(one, carried)) is not None}
    within = {kind: table.within_designs(kind) for kind in sorted(kinds, key=lambda each: (each[0].value, each[1]))}
    compared = {kind: one for kind, one in within.items() if one.fewest_seeds >= _FEWEST and table.columns}
    p_values = table.p_values(tuple(compared.values()))
    adjusted = _holm(p_values.ravel().tolist())
    failures = []
    for (kind, one), row in zip(compared.items(), p_values.tolist(), strict=True):
        failed, pairs = table.failures(kind), one.pairs
        drivers = [
            Driver(quantity=name, aspect=aspect, auc=weighted_auc(pairs, values), p=p, adjusted_p=next(adjusted))
            for ((name, aspect), values), p in zip(table.columns.items(), row, strict=True)
        ]
        failures.append(
            FailureDrivers(
                failure=kind[0],
                stage=kind[1],
                trials=int(failed.sum()),
                seeds=int(failed.any(axis=0).sum()),
                designs=one.designs,
                drivers=_strongest(drivers),
            )
        )
    failures.sort(key=lambda one: -one.trials)
    named = {kind for kind, _ in compared}
    return DriversOfFailures(
        trials=len(records),
        seeds=len(table.seeds),
        failures=tuple(failures),
        too_few=tuple(each for each in dict.fromkeys(kind for kind, _ in within) if each not in named),
    )


_Kind = tuple[Failure, str]


def _kind(record: TrialRecord, carried: Collection[str]) -> _Kind | None:
    """Failure and stage of a trial; None of one that succeeded."""
    if record.failure is None:
        return None
    phase = record.failed_phase
    stage = _CARRY if phase in carried else "" if phase is None else phase
    return record.failure, stage


class _Table:
    """Trials by design and seed: which were run, their kind of failure, and the values of each column."""

    def __init__(self, records: Sequence[TrialRecord], carried: Collection[str]) -> None:
        drawn = [record for record in records if record.draws or record.workload]
        self.seeds = sorted({record.seed for record in drawn})
        places = {seed: place for place, seed in enumerate(self.seeds)}
        rows = {variant: row for row, variant in enumerate(sorted({record.variant for record in drawn}))}
        self._ran = np.zeros((len(rows), len(places)), dtype=np.bool_)
        self._failed: dict[_Kind, Mask] = {}
        for record in drawn:
            at = rows[record.variant], places[record.seed]
            self._ran[at] = True
            kind = _kind(record, carried)
            if kind is not None:
                self._failed.setdefault(kind, np.zeros_like(self._ran))[at] = True
        self.columns = _columns({record.seed: record for record in records}, self.seeds)

    def failures(self, kind: _Kind) -> Mask:
        """Mask of the trials with this failure, shape (designs, seeds)."""
        return self._failed.get(kind, np.zeros_like(self._ran))

    def within_designs(self, kind: _Kind) -> WithinDesigns:
        """The trials of designs that have some with this failure and some without."""
        return WithinDesigns.of(self.failures(kind), self._ran)

    def p_values(self, compared: Sequence[WithinDesigns]) -> Array:
        """The p of each column in each comparison, shape (comparisons, columns)."""
        from scipy.stats import rankdata

        if not compared:
            return np.zeros((0, len(self.columns)))
        contrasts = np.array([one.contrast for one in compared])
        same_designs = np.unique(self._ran, axis=1, return_inverse=True)[1].ravel()
        scores = rankdata(np.array(list(self.columns.values())), axis=1)
        return permutation_p_values(contrasts, scores, same_designs.tolist())


def _columns(by_seed: Mapping[int, TrialRecord], seeds: Sequence[int]) -> dict[tuple[str, Aspect], Array]:
    """The compared values of each seed; constant ones are omitted."""
    columns: dict[tuple[str, Aspect], Array] = {}
    names = dict.fromkeys(name for seed in seeds for name in by_seed[seed].draws)
    for name in names:
        values = np.array([by_seed[seed].draws.get(name, math.nan) for seed in seeds])
        if np.isnan(values).any() or len({*values.tolist()}) < _FEWEST:
            continue
        columns[name, Aspect.VALUE] = values
        columns[name, Aspect.SIZE] = np.abs(values - np.median(values))
    cases = dict.fromkeys(by_seed[seed].workload for seed in seeds)
    if len(cases) > 1:
        for case in cases:
            columns[case, Aspect.CASE] = np.array([float(by_seed[seed].workload == case) for seed in seeds])
    return columns


def _holm(values: Sequence[float]) -> Iterator[float]:
    """The p adjusted by Holm's step-down method, in the order of the values."""
    order = sorted(range(len(values)), key=lambda index: values[index])
    adjusted = [1.0] * len(values)
    greatest = 0.0
    for place, index in enumerate(order):
        greatest = max(greatest, min(1.0, (len(values) - place) * values[index]))
        adjusted[index] = greatest
    return iter(adjusted)


def _strongest(drivers: Sequence[Driver]) -> tuple[Driver, ...]:
    """Each quantity once, at its stronger aspect; the most significant first."""
    ordered = sorted(drivers, key=lambda one: (one.adjusted_p, one.p, -abs(one.auc - 0.5), one.quantity))
    kept: dict[str, Driver] = {}
    for one in ordered:
        kept.setdefault(one.quantity, one)
    return tuple(kept.values())
