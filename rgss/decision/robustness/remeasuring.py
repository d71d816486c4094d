"""The evidence of a trade-off with one number of the model changed, without a simulation."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from rgss.assessment import VariantMeasures, replicates_of
from rgss.decision.what_if import ModelNumber, measures_with, symbols_of, variant_with
from rgss.designs import sources
from rgss.measures import MeasureSet, design_values
from rgss.studies import Project
from rgss.tradeoff.problem import EvidenceTable, Samples

Column = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class Remeasuring:
    """Evaluator of the columns of a trade-off from stored trials, with a changed number.

    Attributes:
        project: The project.
        measured: Its variants with their records, by ascending id.
        table: The evidence of the trade-off, whose rows are these variants.
        fixed: The values that measures take from each of the variants.
        kinds: Cache of groups of variants with equal values.
    """

    project: Project
    measured: Sequence[VariantMeasures]
    table: EvidenceTable
    fixed: tuple[Mapping[str, float | str], ...]
    kinds: dict[tuple[str, ...], NDArray[np.intp]] = field(default_factory=dict)

    @staticmethod
    def of(project: Project, measured: Sequence[VariantMeasures], table: EvidenceTable) -> Remeasuring:
        """An evaluator of a trade-off's evidence."""
        fixed = tuple(sources(entry.variant) for entry in measured)
        return Remeasuring(project=project, measured=measured, table=table, fixed=fixed)

    def measure_of(self, column: str) -> str:
        """The measure of a column; a column may be an end of the measure's interval, such as ``S.low``."""
        known = {measure.id for measure in self.project.measures.measures}
        return column if column in known else column.rpartition(".")[0]

    def affected(self, number: ModelNumber) -> tuple[str, ...]:
        """The columns that depend on a number."""
        measures = self.project.measures
        symbols = symbols_of(measures, number)
        return tuple(column for column in self.table.measures if symbols & measures.used[self.measure_of(column)])

    def users(self, number: ModelNumber) -> NDArray[np.intp]:
        """The rows of the variants that a number is part of; all of them for a constant."""
        return np.array(
            [
                row
                for row, entry in enumerate(self.measured)
                if not number.component
                or any(component.id == number.component for component in entry.variant.components.values())
            ],
            dtype=np.intp,
        )

    def table_with(self, number: ModelNumber, value: float) -> EvidenceTable:
        """The evidence with another value of a number.

        Results of trials are held fixed: a number that a trial was simulated with keeps its old effect in
        them (see `simulated_numbers`).

        Args:
            number: The number.
            value: Its value in SI.

        Raises:
            DefinitionError: A measure is not defined there, for instance by a division by zero.
        """
        measures = measures_with(self.project.measures, number, value)
        quantities, samples = self.table.quantities.copy(), dict(self.table.samples)
        rows = self.users(number)
        affected = self.affected(number)
        noisy = {self.measure_of(column) for column in affected if column in self.table.samples}
        observed: list[Mapping[str, tuple[float | None, ...]]] | None = None
        known: dict[int, dict[str, float]] = {}
        for column in affected:
            measure = self.measure_of(column)
            place = self.table.measures.index(column)
            if not measures.measure(measure).from_trials:
                quantities[rows, place] = self._by_design(measures, measure, rows, number, value, known)
                continue
            if column not in self.table.samples:
                quantities[rows, place] = self._exact(measures, measure, rows, number, value)
                continue
            if observed is None:
                observed = [replicates_of(measures, self._changed(row, number, value), only=noisy) for row in rows]
            old = self.table.samples[column]
            values = old.values.copy()
            fresh = _padded([one[measure] for one in observed], values.shape[1])
            if column != measure:
                # An end of an interval moves with the mean; its replicates keep their distances from it.
                observed_now = _padded(self._replicates(measure, rows), values.shape[1])
                fresh += (_mean(old.values[rows]) - _mean(observed_now))[:, None]
            values[rows] = fresh
            quantities[rows, place] += _mean(values[rows]) - _mean(old.values[rows])
            samples[column] = Samples(values=values, ran=old.ran)
        return replace(self.table, quantities=quantities, samples=samples)

    def _changed(self, row: int, number: ModelNumber, value: float) -> VariantMeasures:
        entry = self.measured[row]
        return replace(entry, variant=variant_with(entry.variant, number, value))

    def _exact(
        self, measures: MeasureSet, measure: str, rows: NDArray[np.intp], number: ModelNumber, value: float
    ) -> Column:
        """Quantities that are the same in all trials of a variant, computed once for equal ones; NaN if unknown."""
        alike = self._alike(tuple(measures.sources(measure)))[rows]
        _, firsts, kinds = np.unique(alike, return_index=True, return_inverse=True)
        found = np.full(len(firsts), np.nan)
        for kind, row in enumerate(rows[firsts]):
            entry = self._changed(row, number, value)
            first = replicates_of(measures, replace(entry, records=entry.records[:1]), only=(measure,))[measure]
            found[kind] = next((one for one in first if one is not None), np.nan)
        return np.asarray(found[kinds], dtype=np.float64)

    def _by_design(
        self,
        measures: MeasureSet,
        measure: str,
        rows: NDArray[np.intp],
        number: ModelNumber,
        value: float,
        known: dict[int, dict[str, float]],
    ) -> Column:
        """Quantities that follow from the design alone, computed once for equal designs; `known` are those of rows."""
        alike = self._alike(tuple(measures.sources(measure)))[rows]
        _, firsts, kinds = np.unique(alike, return_index=True, return_inverse=True)
        found = np.empty(len(firsts))
        for kind, row in enumerate(rows[firsts]):
            if row not in known:
                fixed = self.fixed[row]
                changed = {**fixed, number.source: value} if number.component else fixed
                known[row] = design_values(measures, fixed=changed, variant=self.measured[row].variant.id)
            found[kind] = known[row][measure] / measures.measure(measure).si_per_unit
        return np.asarray(found[kinds], dtype=np.float64)

    def _alike(self, stands_on: tuple[str, ...]) -> NDArray[np.intp]:
        """Index of the group of each variant by these sources, of trials those of its first one, shape (n,); cached."""
        if stands_on not in self.kinds:
            known: dict[tuple[object, ...], int] = {}
            keys = (
                tuple(fixed[source] if source in fixed else _in_first_trial(entry, source) for source in stands_on)
                for fixed, entry in zip(self.fixed, self.measured, strict=True)
            )
            self.kinds[stands_on] = np.array([known.setdefault(key, len(known)) for key in keys], dtype=np.intp)
        return self.kinds[stands_on]

    def _replicates(self, measure: str, rows: NDArray[np.intp]) -> list[tuple[float | None, ...]]:
        return [replicates_of(self.project.measures, self.measured[row], only=(measure,))[measure] for row in rows]


def _in_first_trial(entry: VariantMeasures, source: str) -> object:
    """Metric of the first trial of a variant, such as ``trial.bench_payload_kg``; None if it has none."""
    found = next((record.metrics.get(source.partition(".")[2]) for record in entry.records), None)
    return tuple(found) if isinstance(found, list) else found


def _padded(rows: Sequence[Sequence[float | None]], width: int) -> Column:
    """Replicates as rows of one width, padded with NaN; NaN where unknown."""
    values = np.full((len(rows), width), np.nan)
    for place, row in enumerate(rows):
        values[place, : len(row)] = np.array(row, dtype=np.float64)
    return values


def _mean(replicates: Column) -> Column:
    """Mean of the known replicates of each row; NaN if there are none."""
    known = np.isfinite(replicates)
    total = np.where(known, replicates, 0.0).sum(axis=1)
    mean = np.divide(total, known.sum(axis=1), out=np.full(len(total), np.nan), where=known.any(axis=1))
    return np.asarray(mean, dtype=np.float64)
