"""Constraints: comparisons between numbers of a design that every variant must satisfy.

They are evaluated exactly in decimals, so that binary rounding never decides: three fingers of 0.1 kg are not heavier
than 0.3 kg.
"""

from __future__ import annotations

import operator
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from fractions import Fraction
from types import MappingProxyType

from rgss.designs.components import Component
from rgss.designs.design_values import numbers
from rgss.designs.factors import exact
from rgss.designs.parameters import ParameterValue

COMPARISONS: Mapping[str, Callable[[Fraction, Fraction], bool]] = MappingProxyType(
    {
        "<=": operator.le,
        ">=": operator.ge,
        "==": operator.eq,
        "!=": operator.ne,
        "<": operator.lt,
        ">": operator.gt,
    }
)
"""Comparison by operator; longer operators come first."""

OPERATORS: Mapping[str, Callable[[Fraction, Fraction], Fraction]] = MappingProxyType(
    {"+": operator.add, "-": operator.sub, "*": operator.mul, "/": operator.truediv}
)


@dataclass(frozen=True, slots=True, kw_only=True)
class Amount:
    """Quantity in a constraint, in SI."""

    value: Fraction

    def evaluate(self, values: Mapping[str, Fraction]) -> Fraction:  # noqa: ARG002 - every node takes the values
        """Value of the quantity."""
        return self.value


@dataclass(frozen=True, slots=True, kw_only=True)
class Symbol:
    """Number of the design by name, such as ``design.finger_force``."""

    name: str

    def evaluate(self, values: Mapping[str, Fraction]) -> Fraction:
        """Value of the number."""
        return values[self.name]


@dataclass(frozen=True, slots=True, kw_only=True)
class Operation:
    """Sum, difference, product or quotient; `sign` is one of ``+ - * /``."""

    sign: str
    left: Node
    right: Node

    def evaluate(self, values: Mapping[str, Fraction]) -> Fraction:
        """Value of the operation.

        Raises:
            ZeroDivisionError: The divisor is zero.
        """
        return OPERATORS[self.sign](self.left.evaluate(values), self.right.evaluate(values))


@dataclass(frozen=True, slots=True, kw_only=True)
class Raised:
    """Power with an integer exponent."""

    base: Node
    exponent: int

    def evaluate(self, values: Mapping[str, Fraction]) -> Fraction:
        """Value of the power.

        Raises:
            ZeroDivisionError: The power is a negative one of zero.
        """
        return Fraction(self.base.evaluate(values) ** self.exponent)


Node = Amount | Symbol | Operation | Raised


@dataclass(frozen=True, slots=True, kw_only=True)
class Constraint:
    """Chain of comparisons, such as ``0.2 kg <= m_f * n_f <= 1 kg``.

    Attributes:
        text: Its text.
        sides: The compared expressions.
        signs: The comparison operators between the sides.
        names: Names of its numbers of the design, such as ``design.m_f``, each once.
    """

    text: str
    sides: tuple[Node, ...]
    signs: tuple[str, ...]
    names: tuple[str, ...]

    def holds(self, parameters: Mapping[str, ParameterValue], components: Mapping[str, Component]) -> bool:
        """True if it is satisfied by a combination.

        True if one of its roles has no component yet, False if it is undefined (a division by zero).
        """
        known = numbers(parameters, components)
        if not set(self.names) <= known.keys():
            return True
        values = {name: exact(known[name]) for name in self.names}
        try:
            sides = [side.evaluate(values) for side in self.sides]
        except ZeroDivisionError:
            return False
        return all(
            COMPARISONS[sign](left, right) for sign, left, right in zip(self.signs, sides[:-1], sides[1:], strict=True)
        )
