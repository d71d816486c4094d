"""Price of each requirement of a study: the value that its limit costs."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from rgss.decision.robustness.findings import RequirementPrice
from rgss.tradeoff import AdditiveValue, TradeProblem
from rgss.tradeoff.problem import Comparison, EvidenceTable
from rgss.tradeoff.programs import condition_column, orderings_of, unknown_evidence, weighted_values
from rgss.tradeoff.robustness import condition_masks, price_list

_NO_ANCHORS: Mapping[str, tuple[str, ...]] = MappingProxyType({})


def requirement_prices(
    problem: TradeProblem, table: EvidenceTable, anchored: Mapping[str, tuple[str, ...]] = _NO_ANCHORS
) -> tuple[RequirementPrice, ...]:
    """Price of each requirement: the best value at every limit of it.

    The limit moves as a demand alone; a value function that is anchored on it stays as it is.

    Args:
        problem: The trade-off.
        table: The alternatives.
        anchored: Measures whose value functions are anchored on each requirement, by the requirement's id.
    """
    totals = weighted_values(problem, table)
    masks = condition_masks(problem, table)
    # No limit admits a design without a measure that the program needs, in every replicate if it does there.
    known = ~np.isnan(totals) & ~unknown_evidence(problem, table).any(axis=1)

    orderings = orderings_of(problem.program, problem, table)

    def best_of(among: NDArray[np.bool_]) -> NDArray[np.bool_]:
        return orderings(among).best(among)

    found = []
    for place, condition in enumerate(problem.conditions):
        others = np.logical_and.reduce([known, *(mask for other, mask in enumerate(masks) if other != place)])
        found.append(
            RequirementPrice(
                condition=condition,
                anchored=anchored.get(condition.requirement, ()),
                steps=price_list(
                    condition_column(condition, table),
                    totals,
                    others,
                    at_least=condition.sense is Comparison.AT_LEAST,
                    best_of=None if isinstance(problem.program, AdditiveValue) else best_of,
                ),
            )
        )
    return tuple(found)
