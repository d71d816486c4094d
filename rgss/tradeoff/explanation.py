"""The explanation of a decision: ranking, runner-up, exclusions, contributions, flat measures."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from rgss.tradeoff.decision import LONGEST_LIST, Contribution, FlatMeasure, InfeasibleAlternative, RankedAlternative
from rgss.tradeoff.infeasibility import RequirementCount, excluded_counts
from rgss.tradeoff.problem import surpassed_equals
from rgss.tradeoff.programs import AdditiveValue, Tchebycheff, orderings_of

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from rgss.tradeoff.programs import Enumeration, TradeProblem


_MOST_COMPARED = 10_000_000
"""Largest number of alternatives that are ordered in all to find those that are excluded."""


def ordered_ties(
    problem: TradeProblem, enumeration: Enumeration, *, last_of_equals: bool
) -> tuple[tuple[int, ...], tuple[int, ...]]:
    """The tied alternatives by rising or falling id, those last that another of them surpasses; and these alone."""
    rows = np.flatnonzero(enumeration.tied)
    mask = surpassed_equals(enumeration.table, problem.deciding_functions, rows)
    step = -1 if last_of_equals else 1
    surpassed = tuple(int(variant) for variant in enumeration.variants[rows[mask]][::step])
    others = tuple(int(variant) for variant in enumeration.variants[rows[~mask]][::step])
    return (*others, *surpassed), surpassed


def rank(enumeration: Enumeration, ties: tuple[int, ...]) -> tuple[RankedAlternative, ...]:
    """Ranking of the feasible alternatives: the tied best in their order, then the best of the rest, and so on."""
    ranked = enumeration.ordering.ranked(enumeration.feasible, LONGEST_LIST)
    tied = [enumeration.table.row_of(variant) for variant in ties[:LONGEST_LIST]]
    rows = [*tied, *(int(row) for row in ranked[len(tied) :])]
    return tuple(
        RankedAlternative(
            variant=int(enumeration.variants[row]),
            value=enumeration.value_of(int(enumeration.variants[row])),
            objectives=enumeration.ordering.at(int(row)),
        )
        for row in rows
    )


def find_runner_up(
    enumeration: Enumeration, ranking: tuple[RankedAlternative, ...], ties: tuple[int, ...]
) -> int | None:
    """The best that is not tied with the chosen one, else the next tie, else None."""
    if len(ranking) > len(ties):
        return ranking[len(ties)].variant
    rest = enumeration.ordering.ranked(enumeration.feasible & ~enumeration.tied, 1)
    if rest.size:
        return int(enumeration.variants[rest[0]])
    return ties[1] if len(ties) > 1 else None


def near_ties(
    enumeration: Enumeration, ranking: tuple[RankedAlternative, ...], ties: tuple[int, ...], margin: float
) -> tuple[int, ...]:
    """Alternatives within the practical margin of the best, other than the tied."""
    near = set(enumeration.variants[enumeration.ordering.near(enumeration.feasible, margin)].tolist()) - set(ties)
    return tuple(ranked.variant for ranked in ranking if ranked.variant in near)


def infeasible_alternatives(enumeration: Enumeration) -> tuple[InfeasibleAlternative, ...]:
    """Infeasible alternatives by ascending id, with their violations."""
    rows = np.flatnonzero(~enumeration.feasible)[:LONGEST_LIST]
    return tuple(_infeasible(enumeration, int(enumeration.variants[row])) for row in rows)


def excluded_better(
    problem: TradeProblem, enumeration: Enumeration
) -> tuple[tuple[InfeasibleAlternative, ...], tuple[RequirementCount, ...], int]:
    """Alternatives preferred to the best feasible one, with the demands that exclude them.

    An alternative of which the program does not know enough is not counted: it is unknown whether it
    is better.

    Args:
        problem: The trade-off.
        enumeration: Every alternative evaluated.

    Returns:
        The alternatives by descending weighted value; the demands that exclude at least one of them,
        with the number; how many alternatives there are in all. Empty if nothing is feasible.
    """
    best = enumeration.best_row
    if best is None:
        return (), (), 0
    if isinstance(problem.program, (AdditiveValue, Tchebycheff)):
        better = ~enumeration.feasible & enumeration.ordering.beats(best)
    else:
        better = _chosen_if_allowed(problem, enumeration, best)
    rows = np.flatnonzero(better)
    order = rows[np.lexsort((rows, -enumeration.values[rows]))][:LONGEST_LIST]
    alternatives = tuple(_infeasible(enumeration, int(enumeration.variants[row])) for row in order)
    counts = tuple(count for count in excluded_counts(enumeration, better) if count.excluded)
    return alternatives, counts, len(rows)


def _chosen_if_allowed(problem: TradeProblem, enumeration: Enumeration, best: int) -> NDArray[np.bool_]:
    """Mask of the infeasible alternatives that the program would choose if each alone were feasible too.

    Regrets and tolerances are relative to the best of all feasible alternatives, so that comparing two does not tell.
    Of too many alternatives those come first that are preferred when two are compared, then those of the highest value.
    """
    preferred = enumeration.ordering.beats(best)
    orders = orderings_of(problem.program, problem, enumeration.table)
    found = np.zeros(len(preferred), dtype=np.bool_)
    rows = np.flatnonzero(~enumeration.feasible)
    rows = rows[np.lexsort((rows, -enumeration.values[rows], ~preferred[rows]))]
    for row in rows[: max(1, _MOST_COMPARED // len(found))]:
        if not np.isfinite(enumeration.ordering.at(int(row))).all():
            continue
        among = enumeration.feasible.copy()
        among[row] = True
        tied = orders(among).best(among)
        found[row] = tied[row] and not tied[best]
    return found


def contributions(problem: TradeProblem, enumeration: Enumeration, variant: int | None) -> tuple[Contribution, ...]:
    """Contributions of the measures to the weighted value of an alternative; empty for None."""
    if variant is None:
        return ()
    measures = enumeration.table[enumeration.table.row_of(variant)].measures
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


def flat_measures(problem: TradeProblem, enumeration: Enumeration) -> tuple[FlatMeasure, ...]:
    """Weighted measures with the same value for all alternatives, or all feasible ones.

    Values are compared, not quantities: a measure that varies only where its value is clipped to 0 or 1 has no effect
    either.
    """
    found = []
    everyone = np.ones(len(enumeration.table), dtype=np.bool_)
    for measure in problem.weighting.deciding_measures:
        column = enumeration.table.column(measure)
        values = problem.value_function(measure).values_at(column)
        among_all = _is_flat(values, everyone)
        if among_all or _is_flat(values, enumeration.feasible):
            flat = ~np.isnan(column) & (everyone if among_all else enumeration.feasible)
            known = column[flat]
            found.append(
                FlatMeasure(
                    measure=measure,
                    weight=problem.weighting.weights[measure],
                    low=float(known.min()),
                    high=float(known.max()),
                    among_feasible=not among_all,
                    value=float(values[flat][0]),
                )
            )
    return tuple(found)


def _is_flat(values: NDArray[np.float64], among: NDArray[np.bool_]) -> bool:
    # A single alternative has none to differ from.
    known = values[among & ~np.isnan(values)]
    return known.size > 1 and bool(np.ptp(known) <= 1e-12)


def _infeasible(enumeration: Enumeration, variant: int) -> InfeasibleAlternative:
    return InfeasibleAlternative(
        variant=variant, requirements=enumeration.violated_by(variant), value=enumeration.value_of(variant)
    )
