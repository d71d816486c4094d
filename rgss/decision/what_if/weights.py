"""Other weights for some criteria, the rest scaled so that all sum to 1."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

from rgss.errors import DefinitionError
from rgss.studies.trade_off import TradeOff
from rgss.tradeoff import CriterionNode


def with_weights(trade_off: TradeOff, wanted: Mapping[str, float]) -> TradeOff:
    """A trade-off with other weights of some criteria in the whole.

    The measures of a group keep their proportions, and so do all others.

    Raises:
        DefinitionError: The weights leave nothing, or too little, for the others, or a group and
            one of its members are both named.
        TradeoffError: The weights contradict what was elicited.
    """
    weights = dict(trade_off.weighting.weights)
    groups = {node.name: node.measures for node in _nodes(trade_off.criteria)}
    taken: dict[str, str] = {}
    for name in wanted:
        for measure in groups[name]:
            if measure in taken:
                raise DefinitionError(
                    f"--what-if: weight.{name} and weight.{taken[measure]} both are of {measure}", hint="name one"
                )
            taken[measure] = name
    given, rest = math.fsum(wanted.values()), [measure for measure in weights if measure not in taken]
    left = 1.0 - given
    if left < -1e-9 or (not rest and abs(left) > 1e-9):
        raise DefinitionError(
            f"--what-if: the weights that are given sum to {given:g}",
            hint="give weights that sum to at most 1; the others share the rest"
            if rest
            else "give weights that sum to 1, or omit one",
        )
    for name, weight in wanted.items():
        _scale(weights, groups[name], weight, f"weight.{name}")
    if rest:
        _scale(weights, rest, max(0.0, left), "the other weights")
    changed = replace(
        trade_off, criteria=tuple(CriterionNode(name=name, weight=weight) for name, weight in weights.items())
    )
    changed.weight_bounds.check(weights)
    return changed


def _scale(weights: dict[str, float], measures: Sequence[str], total: float, what: str) -> None:
    """Scale the weights of some measures to another total, in their proportions."""
    before = math.fsum(weights[measure] for measure in measures)
    if before > 0.0:
        for measure in measures:
            weights[measure] *= total / before
    elif len(measures) == 1:
        weights[measures[0]] = total
    elif total > 0.0:
        raise DefinitionError(
            f"--what-if: {what} are 0 in all, so {total:g} cannot be shared in proportion",
            hint="give each of them a weight",
        )


def _nodes(nodes: Sequence[CriterionNode]) -> Iterator[CriterionNode]:
    for node in nodes:
        yield node
        yield from _nodes(node.members)
