"""Substitutions: terms of an expression that are unknown in a trial, and those that ``first_known`` takes for them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from rgss.measures.definitions import MeasureSet
from rgss.measures.expressions import Binary, Call, Expression, Name, Negative, Node, Power
from rgss.measures.functions import FIRST_KNOWN, Value


@dataclass(frozen=True, slots=True, kw_only=True)
class Substitution:
    """A term that another one stands for.

    Attributes:
        measure: Id of the measure whose expression has both.
        missing: Unknown symbols of the terms that were preferred; empty if their arithmetic is undefined.
        taken: Symbols of the term that is taken; empty for a number.
    """

    measure: str
    missing: tuple[str, ...]
    taken: tuple[str, ...]


def substitutions_in(measures: MeasureSet, measure: str, values: Mapping[str, Value]) -> tuple[Substitution, ...]:
    """Substitutions in one trial, in a measure and in those on which it depends.

    Args:
        measures: The measures.
        measure: Id of the measure.
        values: Value of every symbol in the trial.

    Raises:
        DefinitionError: The measure is unknown.
    """
    names = (*measures.dependencies(measure), measure)
    found = (
        _substitution(name, call, values) for name in names for call in _choices(measures.measure(name).expression.root)
    )
    return tuple(dict.fromkeys(one for one in found if one is not None))


def may_substitute(measures: MeasureSet, measure: str) -> bool:
    """True if a measure, or one on which it depends, has a term that another one may stand for.

    Raises:
        DefinitionError: The measure is unknown.
    """
    names = (*measures.dependencies(measure), measure)
    return any(True for name in names for _ in _choices(measures.measure(name).expression.root))


def replaceable_symbols(expression: Expression) -> frozenset[str]:
    """Symbols of an expression that may be unknown, since another term then stands for theirs."""
    calls = _choices(expression.root)
    return frozenset(name for call in calls for argument in call.arguments[:-1] for name in _names(argument))


def _substitution(measure: str, call: Call, values: Mapping[str, Value]) -> Substitution | None:
    known = [isinstance(argument.evaluate(values), float) for argument in call.arguments]
    taken = known.index(True) if True in known else 0
    if taken == 0:
        return None
    before = (name for argument in call.arguments[:taken] for name in _names(argument))
    return Substitution(
        measure=measure,
        missing=tuple(dict.fromkeys(name for name in before if not isinstance(values[name], float))),
        taken=tuple(dict.fromkeys(_names(call.arguments[taken]))),
    )


def _choices(node: Node) -> Iterator[Call]:
    if isinstance(node, Call) and node.function == FIRST_KNOWN:
        yield node
    for part in _parts(node):
        yield from _choices(part)


def _names(node: Node) -> Iterator[str]:
    if isinstance(node, Name):
        yield node.id
    for part in _parts(node):
        yield from _names(part)


def _parts(node: Node) -> tuple[Node, ...]:
    if isinstance(node, Negative):
        return (node.operand,)
    if isinstance(node, Binary):
        return (node.left, node.right)
    if isinstance(node, Power):
        return (node.base,)
    return node.arguments if isinstance(node, Call) else ()
