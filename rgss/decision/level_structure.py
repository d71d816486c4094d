"""Levels of each variant of a design space, for a choice of levels instead of variants."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from rgss.designs import DesignSpace, DesignVariant
from rgss.errors import DefinitionError
from rgss.tradeoff import Incompatibility, LevelFactor, LevelSpace, LevelStructure, smallest_table

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray


def level_structure(designs: DesignSpace, variants: Sequence[DesignVariant]) -> LevelStructure:
    """The factors, the combinations that each rule excludes, and the levels of each variant.

    A rule is formulated over the fewest factors that determine what it excludes: one on the number of fingers
    and the gripper's mass is a condition on these two, independent of other factors.

    Raises:
        DefinitionError: The designs are not combinations of levels.
    """
    factors = tuple(factor.id for factor in designs.factors)
    if designs.sample is not None or not factors or any(set(variant.levels) != set(factors) for variant in variants):
        raise DefinitionError(
            "levels can be chosen only where designs are combinations of levels",
            hint="write 'choose: variants' in the study's trade_off",
        )
    by_rule: dict[str, dict[tuple[str, ...], bool]] = {rule.id: {} for rule in designs.rules}
    for _, levels, parameters in designs.combinations():
        against = designs.rules_against(parameters)
        for rule, excluded in by_rule.items():
            excluded[tuple(levels[factor] for factor in factors)] = rule in against
    rules = []
    for rule, excluded in by_rule.items():
        if any(excluded.values()):
            table = smallest_table(factors, excluded)
            rules.append(
                Incompatibility(
                    id=rule,
                    factors=table.factors,
                    combinations=frozenset(combination for combination, out in table.entries.items() if out),
                )
            )
    space = LevelSpace(
        factors=tuple(
            LevelFactor(id=factor.id, levels=tuple(level.id for level in factor.levels)) for factor in designs.factors
        ),
        rules=tuple(rules),
    )
    return LevelStructure(
        space=space,
        levels={variant.id: tuple(variant.levels[factor] for factor in factors) for variant in variants},
    )


def level_numbers(designs: DesignSpace, variants: Sequence[int]) -> NDArray[np.intp] | None:
    """The level of each variant in each factor as a number, shape (variants, factors).

    Returns:
        The numbers; None if designs are a sample of ranges, or a variant is not in the design space.
    """
    import numpy as np

    factors = tuple(factor.id for factor in designs.factors)
    if designs.sample is not None or not factors:
        return None
    levels = {number: row for number, row, _ in designs.combinations()}
    if not levels.keys() >= set(variants):
        return None
    columns = [np.unique([levels[one][factor] for one in variants], return_inverse=True)[1] for factor in factors]
    return np.column_stack(columns)
