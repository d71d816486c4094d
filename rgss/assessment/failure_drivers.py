"""Drivers of failures: draws that differ between the trials with one kind of failure and the others."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from enum import Enum

import numpy as np
from numpy.typing import NDArray

from rgss.evidence import Failure, TrialRecord

Array = NDArray[np.float64]

SIGNIFICANT = 0.05
"""Adjusted p below which a quantity is called a driver."""

_PERMUTATIONS = 19_999
_BATCH = 500
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
        auc: Probability that a trial with the failure has a greater value than one without; 0.5 without effect.
        p: Two-sided p-value of a permutation of the draws over the seeds.
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
        drivers: Each quantity at its stronger aspect, the least adjusted p first, then the AUC farthest from 0.5.
    """

    failure: Failure
    stage: str
    trials: int
    seeds: int
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
        too_few: Kinds that occurred, at each stage, with fewer than three seeds or with all but fewer than three.
    """

    trials: int
    seeds: int
    failures: tuple[FailureDrivers, ...]
    too_few: tuple[Failure, ...]


def drivers_of_failures(records: Sequence[TrialRecord], *, carried: Collection[str]) -> DriversOfFailures:
    """Compare the draws of failed trials with those of the others, for each kind of failure.

    The AUC is that of Mann and Whitney (1947) over the trials. Designs share the draws of a seed, so that trials are
    not independent observations: p is that of a permutation of the draws over the seeds, for the rank sum weighted by
    the number of trials of a seed with this failure. With one design this is the permutation test of Mann and Whitney.

    Args:
        records: The trials.
        carried: The moves of the task with an object in the hand.
    """
    table = _Table(records, carried)
    found: dict[_Kind, list[tuple[str, Aspect, float, float]]] = {}
    too_few = []
    kinds = {kind for one in records if (kind := _kind(one, carried)) is not None}
    for kind in sorted(kinds, key=lambda each: (each[0].value, each[1])):
        counts = table.failures(kind)
        if not _FEWEST <= int((counts > 0).sum()) <= len(counts) - _FEWEST or not table.columns:
            too_few.append(kind[0])
            continue
        found[kind] = list(table.compared(counts))
    adjusted = _holm([p for rows in found.values() for *_, p in rows])
    failures = []
    for kind, rows in found.items():
        counts = table.failures(kind)
        drivers = [
            Driver(quantity=name, aspect=aspect, auc=auc, p=p, adjusted_p=next(adjusted))
            for name, aspect, auc, p in rows
        ]
        failures.append(
            FailureDrivers(
                failure=kind[0],
                stage=kind[1],
                trials=int(counts.sum()),
                seeds=int((counts > 0).sum()),
                drivers=_strongest(drivers),
            )
        )
    failures.sort(key=lambda one: -one.trials)
    compared = {kind for kind, _ in found}
    return DriversOfFailures(
        trials=len(records),
        seeds=len(table.seeds),
        failures=tuple(failures),
        too_few=tuple(each for each in dict.fromkeys(too_few) if each not in compared),
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
    """Trials by seed: number of trials, number of failures, and the values of each column."""

    def __init__(self, records: Sequence[TrialRecord], carried: Collection[str]) -> None:
        self._carried = carried
        self._records = records
        self.seeds = sorted({record.seed for record in records if record.draws or record.workload})
        self._row = {seed: index for index, seed in enumerate(self.seeds)}
        self._trials = self._counted(lambda _: True)
        self.columns = _columns({record.seed: record for record in records}, self.seeds)

    def failures(self, kind: _Kind) -> Array:
        """Number of trials of each seed with this failure."""
        return self._counted(lambda record: _kind(record, self._carried) == kind)

    def compared(self, failed: Array) -> Iterator[tuple[str, Aspect, float, float]]:
        """Each column's name, aspect, AUC and p."""
        from scipy.stats import permutation_test, rankdata

        ranks = rankdata(np.array(list(self.columns.values())), axis=1)
        centred = ranks - ranks.mean(axis=1, keepdims=True)

        def weighted_rank_sums(shares: Array, axis: int) -> Array:
            sums: Array = (shares * centred).sum(axis=axis)
            return sums

        tested = permutation_test(
            (np.broadcast_to(failed / self._trials, centred.shape),),
            weighted_rank_sums,
            permutation_type="pairings",
            vectorized=True,
            axis=-1,
            batch=_BATCH,
            n_resamples=_PERMUTATIONS,
            rng=np.random.Generator(np.random.Philox(key=1)),
        )
        for (name, aspect), values, p in zip(self.columns, self.columns.values(), tested.pvalue, strict=True):
            yield name, aspect, self._auc(failed, values), float(p)

    def _auc(self, failed: Array, values: Array) -> float:
        others = self._trials - failed
        wins = np.sign(values[:, None] - values[None, :]) / 2 + 0.5
        return float(failed @ wins @ others / (failed.sum() * others.sum()))

    def _counted(self, holds: Callable[[TrialRecord], bool]) -> Array:
        counts = np.zeros(len(self.seeds))
        for record in self._records:
            if record.seed in self._row and holds(record):
                counts[self._row[record.seed]] += 1
        return counts


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
