"""Factors: what varies in a design space, over levels or over a range."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from decimal import Decimal
from fractions import Fraction
from math import floor

from rgss.designs.parameters import ParameterValue, format_value


@dataclass(frozen=True, slots=True, kw_only=True)
class Level:
    """One setting of a factor.

    Attributes:
        id: Its id within the factor; of a value from a range the value with its unit.
        values: The values that it gives to parameters, in SI, by parameter id.
    """

    id: str
    values: Mapping[str, ParameterValue]


@dataclass(frozen=True, slots=True, kw_only=True)
class Span:
    """The values that a parameter takes in a range: equally spaced from one end to the other.

    Attributes:
        parameter: The id of the parameter.
        unit: Its SI unit.
        low: The least value, in SI.
        high: The greatest value, in SI.
        steps: Number of steps between them.
        counted: Whether the values are whole numbers.
    """

    parameter: str
    unit: str
    low: float | int
    high: float | int
    steps: int
    counted: bool = False

    def value(self, step: int) -> float | int:
        """The value after a number of steps from the low end, exact in decimals: 0.47, not 0.47000000000000003."""
        if self.counted:
            return int(self.low) + step * (int(self.high) - int(self.low)) // self.steps
        low, high = exact(self.low), exact(self.high)
        return float(low + (high - low) * step / self.steps)

    def at(self, share: float) -> Level:
        """The level at a place of the unit interval.

        A quantity is the value nearest to the place on the line from low to high. Counts have equal
        parts of the interval, so that each is as likely as any other.

        Args:
            share: The place, from 0 to below 1.
        """
        step = floor(share * (self.steps + 1)) if self.counted else floor(share * self.steps + 0.5)
        value = self.value(step)
        return Level(id=format_value(value, self.unit), values={self.parameter: value})

    def has(self, value: ParameterValue) -> bool:
        """True if a value is one of the range's."""
        if isinstance(value, str) or not self.low <= value <= self.high:
            return False
        low, high = exact(self.low), exact(self.high)
        step = round((exact(value) - low) * self.steps / (high - low))
        return self.value(step) == value


@dataclass(frozen=True, slots=True, kw_only=True)
class Factor:
    """Parameters that are chosen together, or one that is chosen from a range.

    Attributes:
        id: Its id.
        name: Its name.
        levels: Its settings, each of the same parameters; empty if it has a range.
        span: The range of its parameter; None if it has levels.
    """

    id: str
    name: str
    levels: tuple[Level, ...]
    span: Span | None = None


def exact(value: float | int) -> Fraction:
    """The number that a value is written as: of the float 0.1 a tenth, not its nearest binary fraction."""
    return Fraction(Decimal(repr(value)))
