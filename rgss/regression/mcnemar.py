"""McNemar's exact test of paired successes, with the seed as what is drawn."""

from __future__ import annotations

from collections.abc import Sequence
from math import comb, fsum

from rgss.errors import DefinitionError


def discordance_p_value(net: Sequence[int]) -> float:
    """The probability of at least so many more worsenings than improvements if neither were likelier.

    Of one design each seed is worse (1), better (-1) or neither (0), and this is McNemar's exact
    one-sided test: with b worsenings and c improvements, P(X >= b) of X ~ Bin(b + c, 1/2) (McNemar,
    "Note on the sampling error of the difference between correlated proportions", 1947). Several
    designs with the same seed share their plans and are not independent of each other, so a
    seed's worsenings less its improvements are taken together: if old and new were exchangeable,
    each seed's sum would have either sign with the same probability, whatever the designs have in
    common. The distribution of the total is enumerated, not approximated.

    Args:
        net: For each seed, on how many designs it is worse less on how many it is better.

    Returns:
        The one-sided p-value; 1 if no seed differs.
    """
    sizes = [abs(each) for each in net if each]
    observed = sum(net)
    ways = {0: 1}
    for size in sizes:
        step: dict[int, int] = {}
        for total, count in ways.items():
            for reached in (total - size, total + size):
                step[reached] = step.get(reached, 0) + count
        ways = step
    reached_it = sum(count for total, count in ways.items() if total >= observed)
    return float(reached_it / 2 ** len(sizes))


def worsening_below(worse: int, seeds: int, margin: float) -> float:
    """The p-value against success having fallen by the margin or more.

    What success falls by is at most the probability that a seed is worse on any design, so
    that P(X <= worse) of X ~ Bin(seeds, margin) bounds the probability of so few worsenings.

    Args:
        worse: How many seeds are worse on some design.
        seeds: How many seeds there are.
        margin: The share that success may fall by, between 0 and 1.

    Raises:
        DefinitionError: The margin is no share between 0 and 1.
    """
    if not 0.0 < margin < 1.0:
        raise DefinitionError(
            f"the margin of a success is {margin:g}", hint="give a share between 0 and 1, such as 20 %"
        )
    terms = (comb(seeds, count) * margin**count * (1.0 - margin) ** (seeds - count) for count in range(worse + 1))
    return min(1.0, fsum(terms))
