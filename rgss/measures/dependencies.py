"""Dependency graph of the measures: evaluation order, cycles, transitive use."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from graphlib import CycleError, TopologicalSorter


def evaluation_order(uses: Mapping[str, Iterable[str]]) -> tuple[tuple[str, ...], tuple[tuple[str, ...], ...]]:
    """Topological order of nodes.

    Args:
        uses: For each node, the nodes that it uses directly.

    Returns:
        The order, without the nodes on cycles; and the cycles, each with its first node repeated at the end. Of cycles
        that share a node one is reported.
    """
    left = {node: tuple(used) for node, used in uses.items()}
    cycles: list[tuple[str, ...]] = []
    while cycle := _cycle(sorter := TopologicalSorter(left)):
        cycles.append(_from_first(cycle, tuple(uses)))
        left = {
            node: tuple(other for other in used if other not in cycle)
            for node, used in left.items()
            if node not in cycle
        }
    order: list[str] = []
    while ready := sorter.get_ready():
        order += ready
        sorter.done(*ready)
    return tuple(order), tuple(cycles)


def transitive_use(uses: Mapping[str, Iterable[str]], order: Iterable[str]) -> Mapping[str, frozenset[str]]:
    """Transitive closure of the use of each node.

    Args:
        uses: For each node, the nodes and leaves that it uses directly.
        order: The nodes in topological order.
    """
    reached: dict[str, frozenset[str]] = {}
    for node in order:
        direct = frozenset(uses[node])
        reached[node] = direct.union(*(reached.get(other, frozenset()) for other in direct))
    return reached


def _cycle(sorter: TopologicalSorter[str]) -> tuple[str, ...]:
    """A cycle; empty if there is none, and the sorter is ready to give the order."""
    try:
        sorter.prepare()
    except CycleError as error:
        # graphlib's cycle goes from the used node to the using one.
        return tuple(reversed(error.args[1]))
    return ()


def _from_first(cycle: tuple[str, ...], order: tuple[str, ...]) -> tuple[str, ...]:
    """The same cycle, starting at its first node in the file."""
    ring = cycle[:-1]
    start = min(range(len(ring)), key=lambda index: order.index(ring[index]))
    return (*ring[start:], *ring[:start], ring[start])
