"""Expressions of measures: a small part of Python's syntax, read into a tree that computes.

A text from a file is never run. Python's parser is used for its grammar alone; each node of
its tree is either of a kind listed here or refused.
"""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType

from rgss.measures.functions import FUNCTIONS, Value, defined

LONGEST_EXPRESSION = 500
DEEPEST_NESTING = 40
LARGEST_EXPONENT = 6


@dataclass(frozen=True, slots=True, kw_only=True)
class ExpressionProblem:
    """Something wrong in an expression.

    Attributes:
        rule: The id of the broken rule.
        offset: Its position, in characters from the start of the expression.
        message: The problem.
        hint: Advice; may be empty.
    """

    rule: str
    offset: int
    message: str
    hint: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class Number:
    """A number written in an expression; without dimension."""

    offset: int
    value: float

    def evaluate(self, values: Mapping[str, Value]) -> Value:  # noqa: ARG002 - every node takes the values
        """Its value."""
        return self.value


@dataclass(frozen=True, slots=True, kw_only=True)
class Name:
    """A symbol: a constant, an input or another measure."""

    offset: int
    id: str

    def evaluate(self, values: Mapping[str, Value]) -> Value:
        """The symbol's value."""
        return values[self.id]


@dataclass(frozen=True, slots=True, kw_only=True)
class Negative:
    """The negative of a value."""

    offset: int
    operand: Node

    def evaluate(self, values: Mapping[str, Value]) -> Value:
        """Minus the operand, entry by entry."""
        value = self.operand.evaluate(values)
        if isinstance(value, tuple):
            return tuple(None if entry is None else -entry for entry in value)
        return None if value is None else -value


@dataclass(frozen=True, slots=True, kw_only=True)
class Binary:
    """A sum, difference, product or quotient; `symbol` is one of ``+ - * /``."""

    offset: int
    symbol: str
    left: Node
    right: Node

    def evaluate(self, values: Mapping[str, Value]) -> Value:
        """The result, entry by entry; a number goes with each entry of a row."""
        compute = OPERATORS[self.symbol]
        return _combine(compute, self.left.evaluate(values), self.right.evaluate(values))


@dataclass(frozen=True, slots=True, kw_only=True)
class Power:
    """A value to a power that is written as a plain number."""

    offset: int
    base: Node
    exponent: float

    def evaluate(self, values: Mapping[str, Value]) -> Value:
        """The power, entry by entry."""
        return _combine(math.pow, self.base.evaluate(values), self.exponent)


@dataclass(frozen=True, slots=True, kw_only=True)
class Call:
    """A call of one of the listed functions."""

    offset: int
    function: str
    arguments: tuple[Node, ...]

    def evaluate(self, values: Mapping[str, Value]) -> Value:
        """The function's result."""
        return FUNCTIONS[self.function].evaluate(tuple(argument.evaluate(values) for argument in self.arguments))


Node = Number | Name | Negative | Binary | Power | Call


@dataclass(frozen=True, slots=True, kw_only=True)
class Expression:
    """An expression that was read.

    Attributes:
        text: As it is written.
        root: Its tree.
        names: The symbols in it, each once, in the order of their first use, with the offset
            of that use.
    """

    text: str
    root: Node
    names: Mapping[str, int]

    def evaluate(self, values: Mapping[str, Value]) -> Value:
        """Compute it.

        Args:
            values: The value of each of its symbols, in SI. Numbers are floats; None is unknown.

        Returns:
            The value in SI. It is None, or has None for an entry, where something that it
            needs is unknown or the arithmetic is not defined (a division by zero, the root of
            a negative number, a result that is not finite).
        """
        return self.root.evaluate(values)


OPERATORS: Mapping[str, Callable[[float, float], float]] = MappingProxyType(
    {"+": operator.add, "-": operator.sub, "*": operator.mul, "/": operator.truediv}
)


def _combine(compute: Callable[[float, float], float], left: Value, right: Value) -> Value:
    if isinstance(left, tuple) or isinstance(right, tuple):
        if left is None or right is None:
            return None
        lefts = left if isinstance(left, tuple) else (left,) * len(right if isinstance(right, tuple) else ())
        rights = right if isinstance(right, tuple) else (right,) * len(lefts)
        return tuple(_apply(compute, one, other) for one, other in zip(lefts, rights, strict=True))
    return _apply(compute, left, right)


def _apply(compute: Callable[[float, float], float], left: float | None, right: float | None) -> float | None:
    return None if left is None or right is None else defined(compute, left, right)
