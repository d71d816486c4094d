"""Exact reduction: leave out what provably cannot be chosen, before a large program is built."""

from __future__ import annotations

from rgss.tradeoff.problem import Alternative, TradeProblem

LARGEST_UNREDUCED = 2_000
"""Up to so many alternatives the program takes them all, and the solver itself finds the infeasible."""


def reduced_alternatives(problem: TradeProblem) -> tuple[Alternative, ...]:
    """The alternatives that the program has to consider, by ascending id.

    Above `LARGEST_UNREDUCED` alternatives those that miss a threshold or lack evidence are left
    out by direct comparison: no feasible selection can contain them, so the optimum stays. If
    none would be left, all are kept and the solver itself has to prove that nothing is feasible.

    Args:
        problem: The trade-off.

    Returns:
        All alternatives, or the feasible ones.
    """
    everything = tuple(sorted(problem.alternatives, key=lambda alternative: alternative.variant))
    if len(everything) <= LARGEST_UNREDUCED:
        return everything
    return tuple(alternative for alternative in everything if problem.is_feasible(alternative)) or everything
