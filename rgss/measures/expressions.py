"""Expressions of measures: a small subset of Python's syntax, parsed to an evaluable tree.

A text from a file is never executed. Python's parser is used only for its grammar; each node of its tree is of a kind
listed here, or rejected.
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
    """Problem in an expression.

    Attributes:
        rule: The id of the violated rule.
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
    """Dimensionless number in an expression."""

    offset: int
    value: float

    def evaluate(self, values: Mapping[str, Value]) -> Value:  # noqa: ARG002 - every node takes the values
        """Value of the number."""
        return self.value


@dataclass(frozen=True, slots=True, kw_only=True)
class Name:
    """Symbol: a constant, an input or another measure."""

    offset: int
    id: str

    def evaluate(self, values: Mapping[str, Value]) -> Value:
        """Value of the symbol."""
        return values[self.id]


@dataclass(frozen=True, slots=True, kw_only=True)
class Negative:
    """Negation of a value."""

    offset: int
    operand: Node

    def evaluate(self, values: Mapping[str, Value]) -> Value:
        """Negated operand, element-wise."""
        value = self.operand.evaluate(values)
        if isinstance(value, tuple):
            return tuple(None if entry is None else -entry for entry in value)
        return None if value is None else -value


@dataclass(frozen=True, slots=True, kw_only=True)
class Binary:
    """Sum, difference, product or quotient; `symbol` is one of ``+ - * /``."""

    offset: int
    symbol: str
    left: Node
    right: Node

    def evaluate(self, values: Mapping[str, Value]) -> Value:
        """Element-wise result; numbers are broadcast over rows."""
        compute = OPERATORS[self.symbol]
        return _combine(compute, self.left.evaluate(values), self.right.evaluate(values))


@dataclass(frozen=True, slots=True, kw_only=True)
class Power:
    """Power with a plain number as exponent."""

    offset: int
    base: Node
    exponent: float

    def evaluate(self, values: Mapping[str, Value]) -> Value:
        """Element-wise power."""
        return _combine(math.pow, self.base.evaluate(values), self.exponent)


@dataclass(frozen=True, slots=True, kw_only=True)
class Call:
    """Call of one of the listed functions."""

    offset: int
    function: str
    arguments: tuple[Node, ...]

    def evaluate(self, values: Mapping[str, Value]) -> Value:
        """Result of the function."""
        return FUNCTIONS[self.function].evaluate(tuple(argument.evaluate(values) for argument in self.arguments))


Node = Number | Name | Negative | Binary | Power | Call


@dataclass(frozen=True, slots=True, kw_only=True)
class Expression:
    """Parsed expression.

    Attributes:
        text: Its text.
        root: Its tree.
        names: The symbols in it, each once, in the order of their first use, with the offset
            of that use.
    """

    text: str
    root: Node
    names: Mapping[str, int]

    def evaluate(self, values: Mapping[str, Value]) -> Value:
        """Evaluate the expression.

        Args:
            values: The value of each of its symbols, in SI. Numbers are floats; None is unknown.

        Returns:
            The value in SI. It is None, or has None entries, where an operand is unknown or the arithmetic is undefined
            (division by zero, root of a negative number, non-finite result).
        """
        return self.root.evaluate(values)


OPERATORS: Mapping[str, Callable[[float, float], float]] = MappingProxyType(
    {"+": operator.add, "-": operator.sub, "*": operator.mul, "/": operator.truediv}
)


def _combine(compute: Callable[[float, float], float], left: Value, right: Value) -> Value:
    if isinstance(left, float) and isinstance(right, float):
        return defined(compute, left, right)
    if isinstance(left, tuple) or isinstance(right, tuple):
        if left is None or right is None:
            return None
        lefts = left if isinstance(left, tuple) else (left,) * len(right if isinstance(right, tuple) else ())
        rights = right if isinstance(right, tuple) else (right,) * len(lefts)
        return tuple(_apply(compute, one, other) for one, other in zip(lefts, rights, strict=True))
    return _apply(compute, left, right)


def _apply(compute: Callable[[float, float], float], left: float | None, right: float | None) -> float | None:
    return None if left is None or right is None else defined(compute, left, right)
