"""The outcomes of resampled replicates, each made when it is read, so that memory does not grow with their number."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from rgss.tradeoff.problem import Array, EvidenceTable, Resamples, Samples
from rgss.tradeoff.programs import Preferences, single_values, violations

MOST_MEANS_AT_ONCE = 4_000_000
"""So many means are in memory at once, 32 MB: alternatives times measures times resamples."""

MOST_KEPT = 8_000_000
"""Up to so many values, 64 MB, all outcomes are kept once they were made."""


class ResampledTables:
    """The evidence in each of the resamples, made when it is read.

    A quantity moves by as much as the mean of its replicates does, an end of an interval included.
    The means are made for a block of resamples at a time: reading in ascending order makes each once.
    """

    def __init__(self, table: EvidenceTable, resamples: Resamples) -> None:
        self._table = table
        self._resamples = resamples
        self._sampled = {
            measure: _known_replicates(samples)
            for measure, samples in table.samples.items()
            if measure in table.measures
        }
        self._means = {measure: _means(whole) for measure, whole in self._sampled.items()}
        self._at_once = max(1, MOST_MEANS_AT_ONCE // max(1, len(table) * len(self._sampled)))
        self._block = -1
        self._shifts: dict[str, Array] = {}

    def __len__(self) -> int:
        return len(self._resamples.counts)

    def __iter__(self) -> Iterator[EvidenceTable]:
        return (self[place] for place in range(len(self)))

    def __getitem__(self, place: int) -> EvidenceTable:
        """The evidence in one resample."""
        if not 0 <= place < len(self):
            raise IndexError(place)
        block, row = divmod(place, self._at_once)
        if block != self._block:
            here = slice(block * self._at_once, (block + 1) * self._at_once)
            self._shifts = {
                measure: self._resamples.ordered_means(whole, here) - self._means[measure]
                for measure, whole in self._sampled.items()
            }
            self._block = block
        counts = self._resamples.counts[place]
        quantities = self._table.quantities.copy()
        for measure, moved in self._shifts.items():
            quantities[:, self._table.measures.index(measure)] += moved[row]
        return EvidenceTable(
            variants=self._table.variants,
            measures=self._table.measures,
            quantities=quantities,
            samples=_DrawnSamples(self._table.samples, np.repeat(np.arange(len(counts)), counts)),
        )


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ResampledOutcomes:
    """Outcomes under resampled evidence: every alternative valued and judged in each resample of the replicates.

    Conditions on replicates are judged by those of the resample.

    Attributes:
        preferences: Preferences that the alternatives are compared by.
        tables: The evidence in each resample.
        shape: The numbers of resamples b, alternatives n and weighted measures m.
        probabilities: The probability of each resample, shape (b,).
        exact: Whether these are all the distinct resamples there are.
        kept: The outcomes that were made, where all of them are few.
    """

    preferences: Preferences
    tables: ResampledTables
    shape: tuple[int, ...]
    probabilities: Array
    exact: bool
    kept: dict[int, tuple[Array, NDArray[np.bool_]]] = field(default_factory=dict)

    @staticmethod
    def of(preferences: Preferences, table: EvidenceTable, resamples: Resamples) -> ResampledOutcomes:
        """The outcomes of resamples of a table.

        Args:
            preferences: Preferences that the alternatives are compared by.
            table: The evidence.
            resamples: The resamples.
        """
        return ResampledOutcomes(
            preferences=preferences,
            tables=ResampledTables(table, resamples),
            shape=(len(resamples.counts), len(table), len(preferences.weighting.deciding_measures)),
            probabilities=resamples.probabilities,
            exact=resamples.exact,
        )

    def at(self, outcome: int) -> tuple[Array, NDArray[np.bool_]]:
        """The values of the alternatives in one resample, shape (n, m), and which can be chosen, shape (n,)."""
        if outcome in self.kept:
            return self.kept[outcome]
        table = self.tables[outcome]
        feasible: NDArray[np.bool_] = np.asarray(~violations(self.preferences, table).any(axis=1))
        found = single_values(self.preferences, table), feasible
        if self.shape[0] * self.shape[1] * self.shape[2] <= MOST_KEPT:
            self.kept[outcome] = found
        return found


class _DrawnSamples(Mapping[str, Samples]):
    """The replicates of a resample, drawn when a condition needs them."""

    def __init__(self, samples: Mapping[str, Samples], draw: NDArray[np.intp]) -> None:
        self._samples = samples
        self._draw = draw

    def __getitem__(self, measure: str) -> Samples:
        samples = self._samples[measure]
        return Samples(values=samples.values[:, self._draw], ran=samples.ran[:, self._draw])

    def __iter__(self) -> Iterator[str]:
        return iter(self._samples)

    def __len__(self) -> int:
        return len(self._samples)


def _known_replicates(samples: Samples) -> Array:
    whole = np.full(samples.values.shape, np.nan)
    whole[samples.ran] = samples.values[samples.ran]
    return whole


def _means(whole: Array) -> Array:
    known = np.isfinite(whole)
    means = np.divide(
        np.where(known, whole, 0.0).sum(axis=1),
        known.sum(axis=1),
        out=np.full(len(whole), np.nan),
        where=known.any(axis=1),
    )
    return np.asarray(means, dtype=np.float64)
