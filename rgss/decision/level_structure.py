"""The levels that make each variant of a design space, for a choice of levels instead of variants."""

from __future__ import annotations

from collections.abc import Sequence

from rgss.designs import DesignSpace, DesignVariant
from rgss.errors import DefinitionError
from rgss.tradeoff import Incompatibility, LevelFactor, LevelSpace, LevelStructure, smallest_table


def level_structure(designs: DesignSpace, variants: Sequence[DesignVariant]) -> LevelStructure:
    """The factors, the combinations that each rule excludes, and the levels of each variant.

    A rule is put over as few factors as determine what it excludes; so one on the number of fingers and
    the gripper's mass is a condition on these two, whatever else varies.

    Args:
        designs: The design space.
        variants: Its variants.

    Raises:
        DefinitionError: The designs are no combinations of levels.
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
