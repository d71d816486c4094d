"""Looking again with more seeds while something is inconclusive, at one error rate in all."""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass, field

from rgss.regression.comparing import Candidate, Comparison, Outcome, Subject
from rgss.regression.error_rates import level_of_look
from rgss.regression.judging import judge


@dataclass(frozen=True, slots=True, kw_only=True)
class Settled:
    """Result of all looks.

    Attributes:
        comparisons: Every comparison, as first decided or at the end.
        looks: Number of looks.
    """

    comparisons: dict[Subject, Comparison] = field(hash=False)
    looks: int


def settle(
    candidates_at: Callable[[int, Collection[str] | None], Sequence[Candidate]],
    *,
    looks: int,
    error_rate: float,
    on_look: Callable[[int, int], None] | None = None,
) -> Settled:
    """Group-sequential test: repeated looks with more seeds until no comparison is inconclusive or no look is left.

    A change that is found is final. That a metric is the same is claimed anew wherever more of its seeds were run, also
    for another comparison of the run: these seeds may show a change. Each look tests all comparisons, at its part of
    the error rate; the probability of any false claim over all looks is at most the sum of the parts.

    Args:
        candidates_at: Function that returns all comparisons at a look, from 1, for the runs that need more seeds; None
            for all runs.
        looks: Greatest number of looks.
        error_rate: The error rate of all looks.
        on_look: Callback before each look, with its number and the number of open comparisons.
    """
    latest: dict[Subject, Comparison] = {}
    look = 0
    while look < looks:
        look += 1
        undecided = [one.subject for one in latest.values() if not one.outcome.is_final]
        if on_look is not None:
            on_look(look, len(undecided))
        candidates = candidates_at(look, None if look == 1 else {subject.run for subject in undecided})
        for comparison in judge(candidates, level=level_of_look(look, looks, error_rate), look=look):
            known = latest.get(comparison.subject)
            if known is None or not known.outcome.is_final or _has_more_seeds(known, comparison):
                latest[comparison.subject] = comparison
        if all(one.outcome.is_final for one in latest.values()):
            break
    return Settled(comparisons=latest, looks=look)


def _has_more_seeds(known: Comparison, now: Comparison) -> bool:
    """True if a metric was found the same by fewer seeds than there are now."""
    return known.outcome is Outcome.SAME and now.seeds > known.seeds
