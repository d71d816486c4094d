"""Dependency graph of the measures: evaluation order, cycles, transitive use."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from graphlib import CycleError, TopologicalSorter


def evaluation_order(uses: Mapping[str, Iterable[str]]) -> tuple[tuple[str, ...], tuple[tuple[str, ...], ...]]:
    """Sort nodes so that each comes after those that it uses.

    Args:
        uses: For each node, the nodes that it uses directly.

    Returns:
        The order, without the nodes on cycles; and the cycles, each as a round that ends where
        it begins. Cycles that share a node are found one after the other.
    """
    left = {node: tuple(used) for node, used in uses.items()}
    cycles: list[tuple[str, ...]] = []
    while cycle := _cycle(left):
        cycles.append(_from_first(cycle, tuple(uses)))
        left = {
            node: tuple(other for other in used if other not in cycle)
            for node, used in left.items()
            if node not in cycle
        }
    order = TopologicalSorter(left).static_order()
    return tuple(order), tuple(cycles)


def transitive_use(uses: Mapping[str, Iterable[str]], order: Iterable[str]) -> Mapping[str, frozenset[str]]:
    """Everything that each node uses, directly or not.

    Args:
        uses: For each node, what it uses directly; what is not itself a node is a leaf.
        order: The nodes, each after those that it uses.
    """
    reached: dict[str, frozenset[str]] = {}
    for node in order:
        direct = frozenset(uses[node])
        reached[node] = direct.union(*(reached.get(other, frozenset()) for other in direct))
    return reached


def _cycle(uses: Mapping[str, tuple[str, ...]]) -> tuple[str, ...]:
    try:
        TopologicalSorter(uses).prepare()
    except CycleError as error:
        # graphlib's round goes from what is used to what uses it.
        return tuple(reversed(error.args[1]))
    return ()


def _from_first(cycle: tuple[str, ...], order: tuple[str, ...]) -> tuple[str, ...]:
    """The same round, begun at its node that comes first in the file."""
    ring = cycle[:-1]
    start = min(range(len(ring)), key=lambda index: order.index(ring[index]))
    return (*ring[start:], *ring[:start], ring[start])
