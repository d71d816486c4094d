"""The explanation of a decision: ranking, runner-up, exclusions and contributions."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from rgss.tradeoff.conflicts import RequirementCount, excluded_counts
from rgss.tradeoff.decision import Contribution, InfeasibleAlternative, RankedAlternative
from rgss.tradeoff.values import TIE_TOLERANCE

if TYPE_CHECKING:
    from rgss.tradeoff.enumeration import Enumeration
    from rgss.tradeoff.problem import TradeProblem


def rank(enumeration: Enumeration) -> tuple[RankedAlternative, ...]:
    """Order the feasible alternatives: the tied best by id, then the others by value and id."""
    variants, values, feasible, tied = (
        enumeration.variants,
        enumeration.values,
        enumeration.feasible,
        enumeration.tied,
    )
    # The last key of lexsort is the first to be compared; a tie counts as one value.
    order = np.lexsort((variants, np.where(tied, -np.inf, -values)))
    return tuple(
        RankedAlternative(variant=int(variants[row]), value=float(values[row])) for row in order if feasible[row]
    )


def find_runner_up(ranking: tuple[RankedAlternative, ...], ties: tuple[int, ...]) -> int | None:
    """The best that is not tied with the chosen one, else the next tie, else None."""
    if len(ranking) > len(ties):
        return ranking[len(ties)].variant
    return ties[1] if len(ties) > 1 else None


def infeasible_alternatives(enumeration: Enumeration) -> tuple[InfeasibleAlternative, ...]:
    """The alternatives that cannot be chosen, by ascending id, with what each violates."""
    return tuple(_infeasible(enumeration, int(variant)) for variant in enumeration.variants[~enumeration.feasible])


def excluded_better(
    enumeration: Enumeration,
) -> tuple[tuple[InfeasibleAlternative, ...], tuple[RequirementCount, ...]]:
    """What is better than the best feasible alternative, and the requirements that exclude it.

    An alternative whose value is unknown is not counted: no one can say that it is better.

    Args:
        enumeration: Every alternative evaluated.

    Returns:
        The alternatives, best first, and the requirements that exclude at least one of them, with
        the number; both empty if nothing is feasible.
    """
    best = enumeration.best_value
    if best is None:
        return (), ()
    better = ~enumeration.feasible & (enumeration.values > best + TIE_TOLERANCE)
    order = np.lexsort((enumeration.variants, -enumeration.values))
    alternatives = tuple(_infeasible(enumeration, int(enumeration.variants[row])) for row in order if better[row])
    counts = tuple(count for count in excluded_counts(enumeration, better) if count.excluded)
    return alternatives, counts


def contributions(problem: TradeProblem, variant: int | None) -> tuple[Contribution, ...]:
    """What each measure adds to the value of a feasible alternative; empty for None."""
    if variant is None:
        return ()
    measures = next(alternative.measures for alternative in problem.alternatives if alternative.variant == variant)
    found = []
    for measure, weight in problem.weighting.weights.items():
        quantity = measures[measure]
        value = None if quantity is None else problem.value_function(measure).value_at(quantity)
        found.append(
            Contribution(
                measure=measure,
                quantity=quantity,
                value=value,
                weight=weight,
                contribution=0.0 if value is None else weight * value,
            )
        )
    return tuple(found)


def _infeasible(enumeration: Enumeration, variant: int) -> InfeasibleAlternative:
    return InfeasibleAlternative(
        variant=variant, requirements=enumeration.violated_by(variant), value=enumeration.value_of(variant)
    )
