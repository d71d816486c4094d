"""Factors and their levels, which combinations of them make a design, and which alternative each is."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field

from rgss.errors import TradeoffError
from rgss.tradeoff.problem.evidence_table import Alternative


@dataclass(frozen=True, slots=True, kw_only=True)
class LevelFactor:
    """Something that is chosen: a component, or parameters that are set together.

    Attributes:
        id: Its id.
        levels: The ids of its levels, one of which is chosen.

    Raises:
        TradeoffError: It has no levels, or one twice.
    """

    id: str
    levels: tuple[str, ...]

    def __post_init__(self) -> None:
        if not self.levels or len(set(self.levels)) < len(self.levels):
            raise TradeoffError(f"factor {self.id!r} has no levels, or one twice", hint="give it different levels")


@dataclass(frozen=True, slots=True, kw_only=True)
class Incompatibility:
    """Combinations of levels that make no design.

    Attributes:
        id: The id of the rule that excludes them.
        factors: The factors that the rule depends on.
        combinations: The combinations of their levels that it excludes.
    """

    id: str
    factors: tuple[str, ...]
    combinations: frozenset[tuple[str, ...]]


@dataclass(frozen=True, slots=True, kw_only=True)
class LevelSpace:
    """Space of the combinations of levels.

    Attributes:
        factors: The factors; the last one varies fastest in `combinations`.
        rules: Combinations that the compatibility rules exclude.

    Raises:
        TradeoffError: A factor is given twice, or a rule names one that is not there.
    """

    factors: tuple[LevelFactor, ...]
    rules: tuple[Incompatibility, ...] = ()

    def __post_init__(self) -> None:
        ids = [factor.id for factor in self.factors]
        if not ids or len(set(ids)) < len(ids):
            raise TradeoffError("there are no factors, or one is given twice", hint="give different factors")
        for rule in self.rules:
            for factor in rule.factors:
                if factor not in ids:
                    raise TradeoffError(
                        f"rule {rule.id!r} names the unknown factor {factor!r}", hint=f"factors: {', '.join(ids)}"
                    )

    @property
    def size(self) -> int:
        """The number of combinations, excluded ones included."""
        size = 1
        for factor in self.factors:
            size *= len(factor.levels)
        return size

    def levels_of(self, factors: Sequence[str]) -> Iterator[tuple[str, ...]]:
        """Every combination of the levels of some factors, the last one varying fastest."""
        by_id = {factor.id: factor.levels for factor in self.factors}
        return itertools.product(*(by_id[factor] for factor in factors))

    def combinations(self) -> Iterator[tuple[int, tuple[str, ...]]]:
        """Every combination that no rule excludes, with its number among all, from 1."""
        places = {factor.id: place for place, factor in enumerate(self.factors)}
        rules = [([places[factor] for factor in rule.factors], rule.combinations) for rule in self.rules]
        for number, levels in enumerate(self.levels_of([factor.id for factor in self.factors]), start=1):
            if not any(tuple(levels[place] for place in at) in excluded for at, excluded in rules):
                yield number, levels


@dataclass(frozen=True, slots=True, kw_only=True)
class LevelStructure:
    """The levels that make each alternative.

    Attributes:
        space: The factors with the compatibility rules.
        levels: The level of each factor of the space, in their order, by id of the alternative.
    """

    space: LevelSpace
    levels: Mapping[int, tuple[str, ...]] = field(hash=False)

    def check(self, alternatives: Sequence[Alternative]) -> None:
        """Check that alternatives and allowed combinations are the same.

        Raises:
            TradeoffError: An alternative has no levels or excluded ones, two have the same, or a
                combination that the rules allow has no alternative.
        """
        allowed = {levels for _, levels in self.space.combinations()}
        taken: dict[tuple[str, ...], int] = {}
        for alternative in alternatives:
            levels = self.levels.get(alternative.variant)
            if levels is None or levels not in allowed:
                raise TradeoffError(
                    f"variant {alternative.variant} must be a combination of levels that the rules allow",
                    hint="give every alternative a level of each factor",
                )
            if levels in taken:
                raise TradeoffError(
                    f"variants {taken[levels]} and {alternative.variant} have the same levels",
                    hint="a combination of levels is one design",
                )
            taken[levels] = alternative.variant
        for levels in sorted(allowed - taken.keys()):
            raise TradeoffError(
                f"the combination {', '.join(levels)} has no alternative",
                hint="measure every design, or exclude the combination by a rule",
            )
