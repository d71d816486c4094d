"""Constraints: comparisons between numbers of a design that every variant must keep.

They are computed exactly, with each number as its decimal text has it, so that binary rounding
never decides: three fingers of 0.1 kg are not heavier than 0.3 kg.
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
"""Comparison of each sign; the longer signs come first."""

OPERATORS: Mapping[str, Callable[[Fraction, Fraction], Fraction]] = MappingProxyType(
    {"+": operator.add, "-": operator.sub, "*": operator.mul, "/": operator.truediv}
)


@dataclass(frozen=True, slots=True, kw_only=True)
class Amount:
    """A quantity written in a constraint, in SI."""

    value: Fraction

    def evaluate(self, values: Mapping[str, Fraction]) -> Fraction:  # noqa: ARG002 - every node takes the values
        """The quantity."""
        return self.value


@dataclass(frozen=True, slots=True, kw_only=True)
class Symbol:
    """A number of the design, by its name, such as ``design.finger_force``."""

    name: str

    def evaluate(self, values: Mapping[str, Fraction]) -> Fraction:
        """The number."""
        return values[self.name]


@dataclass(frozen=True, slots=True, kw_only=True)
class Operation:
    """A sum, difference, product or quotient; `sign` is one of ``+ - * /``."""

    sign: str
    left: Node
    right: Node

    def evaluate(self, values: Mapping[str, Fraction]) -> Fraction:
        """The result.

        Raises:
            ZeroDivisionError: It is a division by zero.
        """
        return OPERATORS[self.sign](self.left.evaluate(values), self.right.evaluate(values))


@dataclass(frozen=True, slots=True, kw_only=True)
class Raised:
    """A value to a whole power."""

    base: Node
    exponent: int

    def evaluate(self, values: Mapping[str, Fraction]) -> Fraction:
        """The power.

        Raises:
            ZeroDivisionError: It is a negative power of zero.
        """
        return Fraction(self.base.evaluate(values) ** self.exponent)


Node = Amount | Symbol | Operation | Raised


@dataclass(frozen=True, slots=True, kw_only=True)
class Constraint:
    """Sides of which each is compared with the next, such as ``0.2 kg <= m_f * n_f <= 1 kg``.

    Attributes:
        text: As it is written.
        sides: What is compared.
        signs: The comparison after each side but the last.
        names: The numbers of the design that it names, such as ``design.m_f``, each once.
    """

    text: str
    sides: tuple[Node, ...]
    signs: tuple[str, ...]
    names: tuple[str, ...]

    def holds(self, parameters: Mapping[str, ParameterValue], components: Mapping[str, Component]) -> bool:
        """True if it holds for a combination.

        It does where a role that it names has no component yet, and does not where it is not
        defined (a division by zero).
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
