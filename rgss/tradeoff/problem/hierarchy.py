"""Hierarchies of criteria: weights by group, and the resulting weight of each measure."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from rgss.errors import TradeoffError
from rgss.tradeoff.problem.weighting import Weighting


@dataclass(frozen=True, slots=True, kw_only=True)
class CriterionNode:
    """Node of a hierarchy: a measure or a group of criteria, with its weight among its siblings.

    Attributes:
        name: The measure; for a group, the criterion.
        weight: Its share of its group.
        members: Members of a group; empty for a measure.
    """

    name: str
    weight: float
    members: tuple[CriterionNode, ...] = ()

    @property
    def measures(self) -> tuple[str, ...]:
        """The measures below it, itself if it is one."""
        if not self.members:
            return (self.name,)
        return tuple(measure for member in self.members for measure in member.measures)


def weighting_of(nodes: Sequence[CriterionNode]) -> Weighting:
    """The weight of every measure: the product of the shares on the way down to it.

    Args:
        nodes: The criteria at the top.

    Returns:
        The weights of the measures, in the order of the hierarchy; they sum to 1 because the
        shares of every group do.

    Raises:
        TradeoffError: The shares of a group do not sum to 1, or a name occurs twice.
    """
    seen: set[str] = set()
    for node in _all_nodes(nodes):
        if node.name in seen:
            raise TradeoffError(f"{node.name!r} occurs twice among the criteria", hint="keep one of them")
        seen.add(node.name)
    weights: dict[str, float] = {}
    _descend(nodes, 1.0, "", weights)
    return Weighting(weights=weights)


def weights_of_criteria(nodes: Sequence[CriterionNode]) -> Mapping[str, float]:
    """The weight of every group in the whole, from the top down; empty where nothing is grouped."""
    found: dict[str, float] = {}

    def visit(members: Sequence[CriterionNode], share: float) -> None:
        for node in members:
            if node.members:
                found[node.name] = share * node.weight
                visit(node.members, share * node.weight)

    visit(nodes, 1.0)
    return found


def _descend(nodes: Sequence[CriterionNode], share: float, group: str, weights: dict[str, float]) -> None:
    try:
        Weighting(weights={node.name: node.weight for node in nodes})
    except TradeoffError as error:
        where = f"in {group!r}: " if group else ""
        raise TradeoffError(f"{where}{error.message}", hint=error.hint) from error
    for node in nodes:
        if node.members:
            _descend(node.members, share * node.weight, node.name, weights)
        else:
            weights[node.name] = share * node.weight


def _all_nodes(nodes: Sequence[CriterionNode]) -> Iterator[CriterionNode]:
    for node in nodes:
        yield node
        yield from _all_nodes(node.members)
