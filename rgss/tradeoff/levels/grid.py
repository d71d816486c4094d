"""Designs of a level problem in NumPy: quantities, rules and all combinations, many at a time."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from rgss.tradeoff.levels.selection import LevelTable
from rgss.tradeoff.levels.stage_bounds import Intervals, Quantities, stage_bound
from rgss.tradeoff.milp import Constraint, Stage
from rgss.tradeoff.problem import EvidenceTable, LevelSpace

Column = NDArray[np.float64]
Designs = NDArray[np.intp]
"""Level of each factor by its place, shape (n, f)."""

BLOCK = 200_000
"""So many designs are evaluated at once: tens of megabytes."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class LevelGrid:
    """The tables and rules of a level problem as arrays.

    Attributes:
        counts: The number of levels of each factor.
        tables: For each measure its tables: the places of the factors, and the entries, one axis a
            factor; NaN where unknown.
        rules: For each rule the places of its factors, and which combinations it excludes.
    """

    counts: tuple[int, ...]
    tables: Mapping[str, tuple[tuple[tuple[int, ...], Column], ...]]
    rules: tuple[tuple[tuple[int, ...], NDArray[np.bool_]], ...]

    @staticmethod
    def of(space: LevelSpace, tables: Mapping[str, Sequence[LevelTable[float | None]]]) -> LevelGrid:
        """The arrays of a space and its tables."""
        places = {factor.id: place for place, factor in enumerate(space.factors)}
        counts = tuple(len(factor.levels) for factor in space.factors)
        found = {
            measure: tuple(
                (
                    tuple(places[factor] for factor in table.factors),
                    np.array(
                        [table.entries[each] for each in space.levels_of(table.factors)], dtype=np.float64
                    ).reshape([counts[places[factor]] for factor in table.factors]),
                )
                for table in parts
            )
            for measure, parts in tables.items()
        }
        rules = tuple(
            (
                tuple(places[factor] for factor in rule.factors),
                np.array([each in rule.combinations for each in space.levels_of(rule.factors)]).reshape(
                    [counts[places[factor]] for factor in rule.factors]
                ),
            )
            for rule in space.rules
        )
        return LevelGrid(counts=counts, tables=found, rules=rules)

    @property
    def size(self) -> int:
        """The number of combinations, excluded ones included."""
        return math.prod(self.counts)

    def blocks(self) -> Iterator[Designs]:
        """All combinations, block by block, the last factor varying fastest."""
        for start in range(0, self.size, BLOCK):
            yield np.stack(np.unravel_index(np.arange(start, min(start + BLOCK, self.size)), self.counts), axis=1)

    def allowed(self, designs: Designs) -> NDArray[np.bool_]:
        """Mask of the designs that no rule excludes, shape (n,)."""
        kept = np.ones(len(designs), dtype=np.bool_)
        for places, excluded in self.rules:
            kept &= ~excluded[tuple(designs[:, place] for place in places)]
        return kept

    def quantity(self, measure: str, designs: Designs) -> Column:
        """The quantity of each design in a measure, shape (n,); NaN where unknown."""
        return compensated_sum(
            [entries[tuple(designs[:, place] for place in places)] for places, entries in self.tables[measure]],
            len(designs),
        )

    def scores(self, stage: Stage, constraints: Sequence[Constraint], designs: Designs) -> Column:
        """The objective of each design, shape (n,); minus infinity where it is not feasible."""
        scores = stage_bound(stage, constraints, self.quantities(designs))
        return np.where(self.allowed(designs), np.broadcast_to(scores, len(designs)), -np.inf)

    def best(self, stage: Stage, constraints: Sequence[Constraint]) -> tuple[float, Designs] | None:
        """The highest objective of all designs and the first design, shape (f,), that has it; None if infeasible."""
        best: tuple[float, Designs] | None = None
        for designs in self.blocks():
            scores = self.scores(stage, constraints, designs)
            row = int(scores.argmax())
            if scores[row] > (-np.inf if best is None else best[0]):
                best = (float(scores[row]), designs[row])
        return best

    def quantities(self, designs: Designs) -> Quantities:
        """The quantities of designs as intervals of no width, each measure evaluated once.

        NaN where a quantity is unknown, which is in no order.
        """

        def interval(measure: str) -> Intervals:
            column = self.quantity(measure, designs)
            return Intervals(low=column, high=column)

        return lru_cache(maxsize=None)(interval)

    def table(self) -> EvidenceTable:
        """Every design that the rules allow, as alternatives numbered by their combination, from 1."""
        blocks = list(self.blocks())
        kept = np.concatenate([self.allowed(designs) for designs in blocks])
        columns = {
            measure: np.concatenate([self.quantity(measure, designs) for designs in blocks])[kept]
            for measure in self.tables
        }
        return EvidenceTable.of(
            np.flatnonzero(kept).astype(np.int64) + 1,
            columns,
            known={measure: ~np.isnan(column) for measure, column in columns.items()},
        )


def compensated_sum(parts: Sequence[Column], count: int) -> Column:
    """Compensated sum of columns (Neumaier, 1974), shape (n,).

    Cancelling quantities give the result of `math.fsum`, independent of their order.
    """
    total, lost = np.zeros(count), np.zeros(count)
    for part in parts:
        raised = total + part
        lost += np.where(np.abs(total) >= np.abs(part), (total - raised) + part, (part - raised) + total)
        total = raised
    return np.asarray(total + lost)
