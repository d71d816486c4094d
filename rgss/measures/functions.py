"""Functions available in expressions."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from enum import Enum
from types import MappingProxyType

from rgss.measures.ranges import Range

Value = float | None | tuple[float | None, ...]
"""A number or a row of numbers in SI; None for an unknown value or entry."""


FIRST_KNOWN = "first_known"


class Shape(Enum):
    """Shape of a function's argument and result."""

    ENTRY_BY_ENTRY = "entry by entry"
    REDUCTION = "reduction"
    EXTREME = "extreme"
    CHOICE = "choice"


@dataclass(frozen=True, slots=True, kw_only=True)
class Function:
    """A function of expressions.

    Attributes:
        name: Its name in an expression.
        shape: Its arguments: one value, element-wise; one row, reduced to a number; several numbers or one row,
        reduced to the extreme; or several numbers, of which one is the result.
        dimension_power: The result's dimension as a power of the argument's.
        compute: The function of a number (element-wise) or of a row of known numbers.
        range: The range of the result from that of the argument, of each entry of the row, or of all arguments.
        skips_unknown: True if a reduction skips unknown entries.
    """

    name: str
    shape: Shape
    dimension_power: float
    compute: Callable[..., float]
    range: Callable[[Range], Range]
    skips_unknown: bool = False

    def evaluate(self, arguments: tuple[Value, ...]) -> Value:
        """Apply the function; an unknown argument or undefined result gives None."""
        if self.shape is Shape.ENTRY_BY_ENTRY:
            (argument,) = arguments
            if isinstance(argument, tuple):
                return tuple(self._call(entry) for entry in argument)
            return self._call(argument)
        row = arguments[0] if len(arguments) == 1 else arguments
        if not isinstance(row, tuple):
            return None
        known = [entry for entry in row if isinstance(entry, float)]
        return self._call(known) if self.skips_unknown or len(known) == len(row) else None

    def _call(self, argument: float | list[float] | None) -> float | None:
        return None if argument is None else defined(self.compute, argument)


def defined(compute: Callable[..., float], *arguments: float | list[float]) -> float | None:
    """Result of a computation; None if undefined or not finite."""
    try:
        result = compute(*arguments)
    except (ZeroDivisionError, OverflowError, ValueError):
        return None
    return result if math.isfinite(result) else None


def _mean(values: list[float]) -> float:
    return math.fsum(values) / len(values)


def _norm(values: list[float]) -> float:
    return math.hypot(*values)


def _first(values: list[float]) -> float:
    # Nothing is known, and the result is not either.
    if not values:
        raise ValueError
    return values[0]


def _count(values: list[float]) -> float:
    return float(len(values))


FUNCTIONS: Mapping[str, Function] = MappingProxyType(
    {
        function.name: function
        for function in (
            Function(name="abs", shape=Shape.ENTRY_BY_ENTRY, dimension_power=1.0, compute=abs, range=Range.absolute),
            Function(
                name="count",
                shape=Shape.REDUCTION,
                dimension_power=0.0,
                compute=_count,
                range=Range.count,
                skips_unknown=True,
            ),
            Function(
                name=FIRST_KNOWN,
                shape=Shape.CHOICE,
                dimension_power=1.0,
                compute=_first,
                range=Range.entry,
                skips_unknown=True,
            ),
            Function(name="max", shape=Shape.EXTREME, dimension_power=1.0, compute=max, range=Range.entry),
            Function(name="mean", shape=Shape.REDUCTION, dimension_power=1.0, compute=_mean, range=Range.entry),
            Function(name="min", shape=Shape.EXTREME, dimension_power=1.0, compute=min, range=Range.entry),
            Function(name="norm", shape=Shape.REDUCTION, dimension_power=1.0, compute=_norm, range=Range.norm),
            Function(name="sqrt", shape=Shape.ENTRY_BY_ENTRY, dimension_power=0.5, compute=math.sqrt, range=Range.root),
            Function(name="sum", shape=Shape.REDUCTION, dimension_power=1.0, compute=math.fsum, range=Range.total),
        )
    }
)
"""The functions by name. ``count`` is the number of known entries of a row, ``first_known`` the first of its arguments
that is known and defined."""
