"""Factors of a design space, with levels or a range."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from decimal import Decimal
from fractions import Fraction
from math import floor

from rgss.designs.parameters import ParameterValue, format_value


@dataclass(frozen=True, slots=True, kw_only=True)
class Level:
    """Level of a factor.

    Attributes:
        id: Its id within the factor; for a range the value with its unit.
        values: Values in SI, by parameter id.
    """

    id: str
    values: Mapping[str, ParameterValue]


@dataclass(frozen=True, slots=True, kw_only=True)
class Span:
    """Range of a parameter, with equally spaced values including both ends.

    Attributes:
        parameter: The id of the parameter.
        unit: Its SI unit.
        low: The least value, in SI.
        high: The greatest value, in SI.
        steps: Number of steps between them.
        counted: True if the values are integers.
    """

    parameter: str
    unit: str
    low: float | int
    high: float | int
    steps: int
    counted: bool = False

    def value(self, step: int) -> float | int:
        """Value after a number of steps from the low end, exact in decimals: 0.47, not 0.47000000000000003."""
        if self.counted:
            return int(self.low) + step * (int(self.high) - int(self.low)) // self.steps
        low, high = exact(self.low), exact(self.high)
        return float(low + (high - low) * step / self.steps)

    def at(self, share: float) -> Level:
        """Level at a position in the unit interval.

        A quantity is the value nearest to the position between low and high. Counts have equal parts of the interval,
        and so equal probability.

        Args:
            share: The position, from 0 to below 1.
        """
        step = floor(share * (self.steps + 1)) if self.counted else floor(share * self.steps + 0.5)
        value = self.value(step)
        return Level(id=format_value(value, self.unit), values={self.parameter: value})

    def has(self, value: ParameterValue) -> bool:
        """True if a value is in the range."""
        if isinstance(value, str) or not self.low <= value <= self.high:
            return False
        low, high = exact(self.low), exact(self.high)
        step = round((exact(value) - low) * self.steps / (high - low))
        return self.value(step) == value


@dataclass(frozen=True, slots=True, kw_only=True)
class Factor:
    """Factor: parameters that vary together over levels, or one that varies in a range.

    Attributes:
        id: Its id.
        name: Its name.
        levels: Its levels, all with the same parameters; empty if it has a range.
        span: The range of its parameter; None if it has levels.
    """

    id: str
    name: str
    levels: tuple[Level, ...]
    span: Span | None = None


def exact(value: float | int) -> Fraction:
    """Exact decimal value of a number's text: one tenth for the float 0.1, not its binary fraction."""
    return Fraction(Decimal(repr(value)))
