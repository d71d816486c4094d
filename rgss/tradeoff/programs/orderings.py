"""Orderings of many alternatives: by one score, or by one criterion after another."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from rgss.requirements import Comparison
from rgss.tradeoff.problem import TIE_TOLERANCE
from rgss.tradeoff.programs.columns import keeps

Mask = NDArray[np.bool_]
Rows = NDArray[np.intp]
Column = NDArray[np.float64]

MOST_COMPARED = 5_000_000
"""Largest number of alternatives that are evaluated in all to rank them one after another."""


class Ordering(Protocol):
    """Ordering of the alternatives of a trade-off."""

    @property
    def objectives(self) -> tuple[str, ...]:
        """Criteria that are optimised, in turn."""
        ...

    def at(self, row: int) -> tuple[float, ...]:
        """The objectives of an alternative, as people read them."""
        ...

    def best(self, among: Mask) -> Mask:
        """Mask of those of some alternatives that are tied best, shape (n,)."""
        ...

    def near(self, among: Mask, margin: float) -> Mask:
        """Mask of those of some alternatives within a practical margin of the best, shape (n,)."""
        ...

    def shortfall(self, row: int, among: Mask) -> float | None:
        """By how much one of some alternatives misses the best in the last objective.

        None where it is not even kept to the last.
        """
        ...

    def beats(self, row: int) -> Mask:
        """Mask of the alternatives that are better than one by more than a tie, shape (n,)."""
        ...

    def ranked(self, among: Mask, most: int) -> NDArray[np.intp]:
        """The first of some alternatives, best first; equals by ascending row."""
        ...

    def criteria(self) -> Column | None:
        """Columns of which more never makes an alternative worse, shape (n, k); None if there are too many."""
        ...


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ScoreOrdering:
    """By one score, of which more is better.

    Attributes:
        name: Name of the score.
        scores: Scores, shape (n,); NaN where unknown.
        monotone: The criteria, shape (n, k).
        reported: 1, or -1 where people read the score with the other sign.
    """

    name: str
    scores: Column
    monotone: Column | None
    reported: float = 1.0

    @property
    def objectives(self) -> tuple[str, ...]:
        """The one score."""
        return (self.name,)

    def at(self, row: int) -> tuple[float, ...]:
        """The score."""
        return (self.reported * float(self.scores[row]) + 0.0,)

    def best(self, among: Mask) -> Mask:
        """Those within a tie of the highest score."""
        return self.near(among, TIE_TOLERANCE)

    def near(self, among: Mask, margin: float) -> Mask:
        """Those within the margin of the highest score."""
        if not among.any():
            return np.zeros_like(among)
        return np.asarray(among & (self.scores >= self.scores[among].max() - max(margin, TIE_TOLERANCE)))

    def shortfall(self, row: int, among: Mask) -> float | None:
        """Distance of its score below the highest."""
        difference = float(self.scores[among].max() - self.scores[row]) if among.any() else math.nan
        return None if math.isnan(difference) else difference

    def beats(self, row: int) -> Mask:
        """Those whose score is higher by more than a tie."""
        return np.asarray(self.scores > self.scores[row] + TIE_TOLERANCE)

    def ranked(self, among: Mask, most: int) -> NDArray[np.intp]:
        """The tied by row, then the others by score."""
        rows = np.flatnonzero(among)
        if len(rows) > most:
            # The best are a small part of many: partition first, keeping all that equal the last one.
            least = np.partition(self.scores[rows], len(rows) - most)[len(rows) - most]
            rows = rows[self.scores[rows] >= least]
        tied = self.best(among)[rows]
        return np.asarray(rows[np.lexsort((rows, np.where(tied, -np.inf, -self.scores[rows])))][:most])

    def criteria(self) -> Column | None:
        """The criteria."""
        return self.monotone


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Step:
    """Criterion of a sequence.

    Attributes:
        name: Its name.
        column: Its values, greater is better, shape (n,); NaN if unknown.
        absolute: Absolute tolerance.
        relative: Tolerance as a share of the best.
        reported: 1, or -1 if the column is reported with the opposite sign.
    """

    name: str
    column: Column
    absolute: float = 0.0
    relative: float = 0.0
    reported: float = 1.0

    def keeps(self, rows: Rows, *, exactly: bool) -> Rows:
        """Mask of those of some rows that are good enough; with ``exactly`` the tolerance is 0."""
        if not rows.size:
            return rows
        column = self.column[rows]
        best = float(column.max())
        given_up = 0.0 if exactly else self.absolute + self.relative * abs(best)
        return rows[at_least(column, best - given_up)]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SequenceOrdering:
    """By one criterion after another, each keeping those before within their tolerances.

    Attributes:
        steps: The criteria, the most important first.
        ties_by_value: The weighted values that break ties last, shape (n,); None if nothing does.
    """

    steps: tuple[Step, ...]
    ties_by_value: Column | None = None

    @property
    def objectives(self) -> tuple[str, ...]:
        """The criteria in order."""
        return tuple(step.name for step in self.steps) + (() if self.ties_by_value is None else ("value",))

    def at(self, row: int) -> tuple[float, ...]:
        """The criteria of an alternative."""
        found = tuple(step.reported * float(step.column[row]) + 0.0 for step in self.steps)
        return found if self.ties_by_value is None else (*found, float(self.ties_by_value[row]))

    def best(self, among: Mask) -> Mask:
        """Those that are kept to the end."""
        return self._mask(self._best(np.flatnonzero(among)))

    def near(self, among: Mask, margin: float) -> Mask:  # noqa: ARG002 - the last tolerance is the margin
        """Those that are kept to the last criterion and lie within its tolerance, the best among them."""
        kept = self._kept(np.flatnonzero(among))
        return np.asarray(self._mask(self.steps[-1].keeps(kept, exactly=False)) | self.best(among))

    def shortfall(self, row: int, among: Mask) -> float | None:
        """Distance from the best in the last criterion, among the alternatives within the tolerances of the others."""
        kept = self._kept(np.flatnonzero(among))
        column = self.steps[-1].column
        if self.ties_by_value is not None:
            kept = self.steps[-1].keeps(kept, exactly=True)
            column = self.ties_by_value
        return float(column[kept].max() - column[row]) if row in kept else None

    def beats(self, row: int) -> Mask:
        """Those that would be chosen if there were only the two."""
        size = len(self.steps[0].column)
        # Of each pair: is the other one still in, is the given one?
        other, given = np.ones(size, dtype=np.bool_), np.ones(size, dtype=np.bool_)
        for place, step in enumerate(self.steps):
            best = np.fmax(np.where(other, step.column, -np.inf), np.where(given, step.column[row], -np.inf))
            # A pair of which neither is left needs no best.
            best = np.where(np.isfinite(best), best, 0.0)
            last = place == len(self.steps) - 1
            given_up = 0.0 if last else step.absolute + step.relative * np.abs(best)
            other &= at_least(step.column, best - given_up)
            given &= at_least(np.full(size, step.column[row]), best - given_up)
        if self.ties_by_value is not None:
            given &= ~(other & (self.ties_by_value > self.ties_by_value[row] + TIE_TOLERANCE))
        return np.asarray(other & ~given)

    def ranked(self, among: Mask, most: int) -> NDArray[np.intp]:
        """The best, then the best of the rest, and so on, as far as `MOST_COMPARED` allows."""
        rest = np.flatnonzero(among)
        found: list[int] = []
        most = min(most, max(10, MOST_COMPARED // max(rest.size, 1)))
        while len(found) < most and rest.size:
            chosen = self._best(rest)
            if not chosen.size:
                break
            found.extend(int(row) for row in chosen)
            rest = np.setdiff1d(rest, chosen, assume_unique=True)
        return np.array(found[:most], dtype=np.intp)

    def criteria(self) -> Column | None:
        """The criteria, and the values that break ties."""
        columns = [step.column for step in self.steps]
        if self.ties_by_value is not None:
            columns.append(self.ties_by_value)
        return np.stack(columns, axis=1)

    def _kept(self, rows: Rows) -> Rows:
        for step in self.steps[:-1]:
            rows = step.keeps(rows, exactly=False)
        return rows

    def _best(self, rows: Rows) -> Rows:
        kept = self.steps[-1].keeps(self._kept(rows), exactly=True)
        if self.ties_by_value is not None and kept.size:
            values = self.ties_by_value[kept]
            kept = kept[values >= values.max() - TIE_TOLERANCE]
        return kept

    def _mask(self, rows: Rows) -> Mask:
        mask = np.zeros(len(self.steps[0].column), dtype=np.bool_)
        mask[rows] = True
        return mask


def at_least(column: Column, bound: float | Column) -> Mask:
    """Mask of the quantities that reach a bound; those that differ by less than one part in 10⁹ do."""
    return keeps(Comparison.AT_LEAST, column, bound)
