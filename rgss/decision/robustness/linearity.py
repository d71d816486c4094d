"""Linearity of a measure in the numbers that it depends on, from its expression."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from functools import singledispatch

from rgss.measures import Binary, Call, Estimator, MeasureSet, Name, Negative, Node, Number, Power, Summary

CONSTANT, AFFINE, OTHER = range(3)
"""Degrees: independent of the symbols; affine in them; anything else."""

_LINEAR_FUNCTIONS = ("sum", "mean")


def is_affine(measures: MeasureSet, measure: str, symbols: Collection[str]) -> bool:
    """True if a measure is an affine function of some symbols together, with the others held.

    The result is conservative: an expression that only simplifies to an affine function may be missed.

    Args:
        measures: The measures.
        measure: The measure's id.
        symbols: Symbols of inputs and constants.
    """
    degrees = dict.fromkeys(symbols, AFFINE)
    for one in measures.evaluation_order:
        degrees[one.id] = _degree(one.expression.root, degrees)
    defined = measures.measure(measure)
    is_mean = defined.estimate is None or defined.estimate.statistic is Estimator.MEAN
    if degrees[measure] != CONSTANT and (not is_mean or defined.summary is Summary.MAX):
        return False
    return degrees[measure] != OTHER


@singledispatch
def _degree(node: Node, degrees: Mapping[str, int]) -> int:  # noqa: ARG001 - read by the nodes' own
    """The degree of a node in the symbols."""
    return OTHER


@_degree.register
def _(node: Number, degrees: Mapping[str, int]) -> int:  # noqa: ARG001
    return CONSTANT


@_degree.register
def _(node: Name, degrees: Mapping[str, int]) -> int:
    return degrees.get(node.id, CONSTANT)


@_degree.register
def _(node: Negative, degrees: Mapping[str, int]) -> int:
    return _degree(node.operand, degrees)


@_degree.register
def _(node: Binary, degrees: Mapping[str, int]) -> int:
    left, right = _degree(node.left, degrees), _degree(node.right, degrees)
    if node.symbol in "+-":
        return max(left, right)
    if node.symbol == "*":
        return OTHER if left and right else max(left, right)
    return OTHER if right else left


@_degree.register
def _(node: Power, degrees: Mapping[str, int]) -> int:
    base = _degree(node.base, degrees)
    return base if node.exponent == 1.0 or base == CONSTANT else OTHER


@_degree.register
def _(node: Call, degrees: Mapping[str, int]) -> int:
    worst = max((_degree(argument, degrees) for argument in node.arguments), default=CONSTANT)
    return worst if worst == CONSTANT or node.function in _LINEAR_FUNCTIONS else OTHER
