"""Dimensional analysis of expressions."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from rgss.currencies import CODES, currency_dimension
from rgss.measures.expressions import (
    Binary,
    Call,
    Expression,
    ExpressionProblem,
    Name,
    Negative,
    Node,
    Number,
    Power,
)
from rgss.measures.functions import FUNCTIONS, Shape

Dimension = tuple[tuple[str, float], ...]
"""Base dimensions with their exponents, sorted, none of them 0; empty for a pure number."""

PURE: Dimension = ()

_BASE_UNITS: tuple[tuple[str, str], ...] = (
    ("mass", "kg"),
    ("length", "m"),
    *((currency_dimension(code), code) for code in CODES),
    ("current", "A"),
    ("temperature", "K"),
    ("substance", "mol"),
    ("luminosity", "cd"),
    ("time", "s"),
)


@dataclass(frozen=True, slots=True, kw_only=True)
class Kind:
    """Kind of a value: dimension and length.

    Attributes:
        dimension: Its dimension.
        length: The number of its entries; None for a single number.
    """

    dimension: Dimension
    length: int | None = None


def si_unit(dimension: Dimension) -> str:
    """Coherent SI unit of a dimension (money in its currency), such as ``kg·m·s^-2``."""
    exponents = dict(dimension)
    parts = [
        unit if exponents[base] == 1 else f"{unit}^{exponents[base]:g}"
        for base, unit in _BASE_UNITS
        if base in exponents
    ]
    return "·".join(parts) or "1"


def kind_of(
    expression: Expression, kinds: Mapping[str, Kind | None]
) -> tuple[Kind | None, tuple[ExpressionProblem, ...]]:
    """Kind of an expression's value, from the kinds of its symbols.

    Args:
        expression: The expression.
        kinds: Kind of each of its symbols; None if unknown.

    Returns:
        Its kind, or None if unknown; and every inconsistency in it.
    """
    analysis = _Analysis(kinds)
    kind = analysis.kind(expression.root)
    return kind, tuple(analysis.problems)


class _Analysis:
    def __init__(self, kinds: Mapping[str, Kind | None]) -> None:
        self._kinds = kinds
        self.problems: list[ExpressionProblem] = []

    def kind(self, node: Node) -> Kind | None:
        if isinstance(node, Number):
            return Kind(dimension=PURE)
        if isinstance(node, Name):
            return self._kinds.get(node.id)
        if isinstance(node, Negative):
            return self.kind(node.operand)
        if isinstance(node, Power):
            base = self.kind(node.base)
            return None if base is None else _raised(base, node.exponent)
        if isinstance(node, Binary):
            return self._binary(node)
        return self._call(node)

    def _binary(self, node: Binary) -> Kind | None:
        left, right = self.kind(node.left), self.kind(node.right)
        if left is None or right is None:
            return None
        if left.length is not None and right.length is not None and left.length != right.length:
            self._refuse(node, "measures.shape", f"a row of {left.length} does not go with a row of {right.length}")
            return None
        length = left.length if left.length is not None else right.length
        if node.symbol in "*/":
            sign = 1.0 if node.symbol == "*" else -1.0
            return Kind(dimension=_product(left.dimension, right.dimension, sign), length=length)
        if left.dimension != right.dimension:
            verb = "add" if node.symbol == "+" else "subtract"
            one, other = si_unit(left.dimension), si_unit(right.dimension)
            self._refuse(node, "measures.unit", f"cannot {verb} values in {one} and {other}")
            return None
        return Kind(dimension=left.dimension, length=length)

    def _call(self, node: Call) -> Kind | None:
        function = FUNCTIONS[node.function]
        arguments = [self.kind(argument) for argument in node.arguments]
        known = [argument for argument in arguments if argument is not None]
        if len(known) < len(arguments):
            return None
        first = known[0]
        if function.shape is Shape.ENTRY_BY_ENTRY:
            return _raised(first, function.dimension_power)
        if function.shape is Shape.CHOICE and any(argument.length is not None for argument in known):
            self._refuse(node, "measures.shape", f"{function.name}() takes several numbers, and no row")
            return None
        if len(known) == 1:
            if first.length is None:
                self._refuse(node, "measures.shape", f"{function.name}() of a single number; it needs a row")
                return None
        elif any(argument.length is not None for argument in known):
            self._refuse(node, "measures.shape", f"{function.name}() takes one row or several numbers, not a mixture")
            return None
        units = list(dict.fromkeys(si_unit(argument.dimension) for argument in known))
        if len(units) > 1:
            self._refuse(node, "measures.unit", f"{function.name}() of values in different units: {', '.join(units)}")
            return None
        return Kind(dimension=_raised(first, function.dimension_power).dimension)

    def _refuse(self, node: Node, rule: str, message: str) -> None:
        self.problems.append(ExpressionProblem(rule=rule, offset=node.offset, message=message))


def _product(left: Dimension, right: Dimension, sign: float) -> Dimension:
    exponents = dict(left)
    for base, exponent in right:
        exponents[base] = exponents.get(base, 0.0) + sign * exponent
    return tuple(sorted((base, exponent) for base, exponent in exponents.items() if exponent != 0.0))


def _raised(kind: Kind, exponent: float) -> Kind:
    powers = ((base, power * exponent) for base, power in kind.dimension)
    return Kind(dimension=tuple((base, power) for base, power in powers if power != 0.0), length=kind.length)
