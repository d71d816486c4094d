"""Decision variables that choose levels: the mixed-integer form of a design space."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Generic, TypeVar

from rgss.tradeoff.milp import LinearQuantity, Row, read_choice
from rgss.tradeoff.problem import Alternative, LevelSpace, LevelStructure, replicates_of

Entry = TypeVar("Entry")

LARGEST_TABLE = 100
"""Tables of one measure are merged while the merged one has no more entries than this.

A merged table needs a variable for each of its entries: with up to 20,000 of them a problem of 18,900
combinations took 12.7 s that takes less than 2 s as sums. On random problems of
``benchmarks/tradeoff_guard.py`` the limits 1, 100 and 500 differ by less than a sixth; 100 is the fastest, and
the solver was right with each. Tables over two factors of up to ten levels are still merged, which saves the
booleans that say in which segment of a value function a sum lies.
"""

LARGEST_CURVED = 20_000
"""The same where the value of the measure is not piecewise linear: it can be valued in one table only."""


@dataclass(frozen=True, slots=True, kw_only=True)
class LevelTable(Generic[Entry]):
    """Contribution of a combination of levels of some factors.

    Attributes:
        factors: The factors that it depends on; none for a constant.
        entries: The entry of each combination of their levels.
    """

    factors: tuple[str, ...]
    entries: Mapping[tuple[str, ...], Entry] = field(hash=False)


@dataclass(frozen=True, slots=True, kw_only=True)
class LevelModel:
    """Model of a choice of levels: the factors, and the tables that give its quantities.

    Attributes:
        space: The factors with the compatibility rules.
        quantities: The quantity of each measure as the sum of its tables.
        replicates: The replicates of each measure, by the combination of levels that decides them.
        alternative_of: The alternative that a level of each factor makes.
        levels_of: The level of each factor of the alternative with an id.
        curved: The measures whose value is not piecewise linear, which therefore need one table.
    """

    space: LevelSpace
    quantities: Mapping[str, tuple[LevelTable[float | None], ...]] = field(hash=False)
    replicates: Mapping[str, LevelTable[Row]] = field(hash=False)
    alternative_of: Callable[[tuple[str, ...]], Alternative]
    levels_of: Callable[[int], tuple[str, ...]]
    curved: frozenset[str] = frozenset()

    @staticmethod
    def of(structure: LevelStructure, alternatives: Sequence[Alternative], measures: Sequence[str]) -> LevelModel:
        """Model of enumerated alternatives.

        Each measure becomes a table over a minimal set of factors that determine it, found by removing factors one
        after another while the rest still determines every quantity.

        Args:
            structure: The levels of each alternative.
            alternatives: The alternatives.
            measures: The measures that the program uses.
        """
        by_levels = {structure.levels[alternative.variant]: alternative for alternative in alternatives}
        factors = tuple(factor.id for factor in structure.space.factors)
        return LevelModel(
            space=structure.space,
            quantities={
                measure: (
                    smallest_table(factors, {levels: one.measures[measure] for levels, one in by_levels.items()}),
                )
                for measure in measures
            },
            replicates={
                measure: smallest_table(
                    factors, {levels: tuple(replicates_of(one, measure)) for levels, one in by_levels.items()}
                )
                for measure in measures
            },
            alternative_of=by_levels.__getitem__,
            levels_of=structure.levels.__getitem__,
        )


class LevelSelection:
    """One boolean variable for each level of each factor, exactly one of a factor being 1.

    For each set of factors that a measure or a rule depends on there is one continuous variable for
    each combination of their levels that is a design; over every level they sum to the level's
    boolean. Where the booleans are 0 or 1, so are they, and the one that is 1 is the combination.
    """

    def __init__(self, model: LevelModel) -> None:
        import cvxpy

        self._model = model
        self._levels = {factor.id: cvxpy.Variable(len(factor.levels), boolean=True) for factor in model.space.factors}
        self._ids = {factor.id: factor.levels for factor in model.space.factors}
        self._combinations: dict[tuple[str, ...], dict[tuple[str, ...], Any]] = {}
        self._variables: dict[tuple[str, ...], Any] = {}
        self._structure: list[tuple[str, Any]] = [
            (f"choose one level of {factor}", cvxpy.sum(variable) == 1.0) for factor, variable in self._levels.items()
        ]
        self._quantities: dict[str, tuple[LevelTable[float | None], ...]] = {}
        self._linear: dict[str, LinearQuantity] = {}
        for rule in model.space.rules:
            self._variable(rule.factors)

    @property
    def structure(self) -> Sequence[tuple[str, Any]]:
        """One level of each factor, and combinations that agree with the levels."""
        return tuple(self._structure)

    def quantities(self, measure: str) -> Sequence[float | None]:
        """The quantity of each combination that decides the measure."""
        table = self._table(measure)
        # A combination that only rules on further factors exclude has no entry, and cannot be selected.
        return [table.entries.get(combination) for combination in self._of_scope(table.factors)]

    def of_selected(self, measure: str, coefficients: Sequence[float]) -> Any:
        """The coefficient of the selected combination."""
        return self._times(self._table(measure).factors, [[entry] for entry in coefficients])[0]

    def replicates(self, measure: str) -> Sequence[Row]:
        """The replicates of each combination that decides them."""
        table = self._model.replicates[measure]
        return [table.entries.get(combination, (None,)) for combination in self._of_scope(table.factors)]

    def of_selected_replicates(self, measure: str, coefficients: Sequence[Sequence[float]]) -> Any:
        """The coefficients of the selected combination."""
        return self._times(self._model.replicates[measure].factors, coefficients)

    def linear_quantity(self, measure: str) -> LinearQuantity | None:
        """The measure as a sum over tables, where merging these would be too large a table."""
        tables = self._merged(measure)
        if len(tables) == 1:
            return None
        if measure not in self._linear:
            self._linear[measure] = self._sum_of(measure, tables)
        return self._linear[measure]

    def _sum_of(self, measure: str, tables: Sequence[LevelTable[float | None]]) -> LinearQuantity:
        parts, low, high = [], 0.0, 0.0
        for table in tables:
            entries = [table.entries.get(combination) for combination in self._of_scope(table.factors)]
            known = [0.0 if entry is None else entry for entry in entries]
            parts.append(self._times(table.factors, [[entry] for entry in known])[0])
            if None in entries:
                unknown = [[float(entry is None)] for entry in entries]
                self.require(self._times(table.factors, unknown)[0] <= 0.0)
            low, high = low + min(known), high + max(known)
        return LinearQuantity(measure=measure, expression=sum(parts), low=low, high=high, require=self.require)

    def require(self, constraint: Any) -> None:
        """Add a constraint on variables that a term added."""
        self._structure.append(("auxiliary", constraint))

    def exclusion(self, alternative: Alternative) -> Any:
        """At least one level differs from those of an alternative."""
        levels = self._model.levels_of(alternative.variant)
        chosen = [
            variable[self._ids[factor].index(level)]
            for (factor, variable), level in zip(self._levels.items(), levels, strict=True)
        ]
        return sum(chosen) <= len(chosen) - 1.0

    def read(self) -> tuple[Alternative, float]:
        """The alternative that the chosen levels make."""
        places = {factor: read_choice(variable.value) for factor, variable in self._levels.items()}
        levels = tuple(self._ids[factor][place] for factor, (place, _) in places.items())
        return self._model.alternative_of(levels), max(error for _, error in places.values())

    def _table(self, measure: str) -> LevelTable[float | None]:
        (table,) = self._merged(measure)
        return table

    def _merged(self, measure: str) -> tuple[LevelTable[float | None], ...]:
        if measure not in self._quantities:
            most = LARGEST_CURVED if measure in self._model.curved else LARGEST_TABLE
            self._quantities[measure] = merged_tables(self._model.space, self._model.quantities[measure], most)
        return self._quantities[measure]

    def _of_scope(self, factors: tuple[str, ...]) -> Sequence[tuple[str, ...]]:
        self._variable(factors)
        return tuple(self._combinations[factors])

    def _times(self, factors: tuple[str, ...], coefficients: Sequence[Sequence[float]]) -> Any:
        """The coefficients of the selected combination of some factors, as a vector."""
        import cvxpy
        import numpy as np

        return cvxpy.Constant(np.array(coefficients, dtype=np.float64).T) @ self._variable(factors)

    def _variable(self, factors: tuple[str, ...]) -> Any:
        """The variables of the combinations of some factors; made when they are first used."""
        import cvxpy
        import numpy as np
        import scipy.sparse

        if factors in self._variables:
            return self._variables[factors]
        designs = self._designs(factors)
        self._combinations[factors] = dict.fromkeys(designs)
        if len(factors) == 1 and len(designs) == len(self._ids[factors[0]]):
            self._variables[factors] = self._levels[factors[0]]
            return self._variables[factors]
        variable = cvxpy.Variable(len(designs), nonneg=True)
        self._variables[factors] = variable
        if not factors:
            self._structure.append(("a constant", variable == 1.0))
        for place, factor in enumerate(factors):
            # One constraint of many rows: CVXPY takes as long for one of a single row.
            at = {level: row for row, level in enumerate(self._ids[factor])}
            rows = [at[combination[place]] for combination in designs]
            members = scipy.sparse.csr_array(
                (np.ones(len(rows)), (rows, np.arange(len(rows)))), shape=(len(at), len(rows))
            )
            self._structure.append(
                (f"combinations of {', '.join(factors)} at {factor}", members @ variable == self._levels[factor])
            )
        return variable

    def _designs(self, factors: tuple[str, ...]) -> list[tuple[str, ...]]:
        """The combinations of some factors that no rule on them alone excludes."""
        rules = [
            ([factors.index(factor) for factor in rule.factors], rule.combinations)
            for rule in self._model.space.rules
            if set(rule.factors) <= set(factors)
        ]
        return [
            combination
            for combination in self._model.space.levels_of(factors)
            if not any(tuple(combination[place] for place in at) in excluded for at, excluded in rules)
        ]


def smallest_table(factors: tuple[str, ...], entries: Mapping[tuple[str, ...], Entry]) -> LevelTable[Entry]:
    """The table over as few factors as still determine every entry.

    Args:
        factors: The factors of the combinations.
        entries: The entry of each combination that is a design.
    """
    table = LevelTable(factors=factors, entries=entries)
    for factor in factors:
        place = table.factors.index(factor)
        smaller: dict[tuple[str, ...], Entry] = {}
        for combination, entry in table.entries.items():
            left = combination[:place] + combination[place + 1 :]
            if smaller.setdefault(left, entry) != entry:
                break
        else:
            table = LevelTable(factors=table.factors[:place] + table.factors[place + 1 :], entries=smaller)
    return table


def merged_tables(
    space: LevelSpace, tables: Sequence[LevelTable[float | None]], most: int
) -> tuple[LevelTable[float | None], ...]:
    """Tables whose sum is a measure as one, if that one is not too large.

    Args:
        space: The factors.
        tables: The tables.
        most: The largest number of entries of the merged table.

    Returns:
        The one table over the factors of all; or the tables as they are.
    """
    counts = {factor.id: len(factor.levels) for factor in space.factors}
    wanted = [factor for factor in counts if any(factor in table.factors for table in tables)]
    if len(tables) == 1 or math.prod(counts[factor] for factor in wanted) > most:
        return tuple(tables)
    entries: dict[tuple[str, ...], float | None] = {}
    for combination in space.levels_of(wanted):
        of = dict(zip(wanted, combination, strict=True))
        parts = [table.entries.get(tuple(of[factor] for factor in table.factors)) for table in tables]
        known = [part for part in parts if part is not None]
        entries[combination] = math.fsum(known) if len(known) == len(parts) else None
    return (LevelTable(factors=tuple(wanted), entries=entries),)
