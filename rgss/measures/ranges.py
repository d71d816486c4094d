"""Ranges of possible values, and interval arithmetic with them (Moore 1966)."""

from __future__ import annotations

import math
from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class Range:
    """Range of possible values of a number, or of each entry of a row.

    Attributes:
        low: Least possible value; minus infinity if unknown.
        high: Greatest possible value; infinity if unknown.
        length: The number of entries of a row; None for a single number.
    """

    low: float = -math.inf
    high: float = math.inf
    length: int | None = None

    @staticmethod
    def of_number(value: float) -> Range:
        """Range of a known number."""
        return Range(low=value, high=value)

    def negated(self) -> Range:
        """Range of the negated values."""
        return Range(low=-self.high, high=-self.low, length=self.length)

    def plus(self, other: Range) -> Range:
        """Range of the sums with values of another range."""
        return Range(low=self.low + other.low, high=self.high + other.high, length=_common_length(self, other))

    def times(self, other: Range) -> Range:
        """Range of the products with values of another range."""
        ends = [_product(one, two) for one in (self.low, self.high) for two in (other.low, other.high)]
        return Range(low=min(ends), high=max(ends), length=_common_length(self, other))

    def inverse(self) -> Range:
        """Range of the reciprocals that are defined."""
        if self.low < 0.0 < self.high:
            return Range(length=self.length)
        low = -math.inf if self.high == 0.0 else 1.0 / self.high
        return Range(low=low, high=math.inf if self.low == 0.0 else 1.0 / self.low, length=self.length)

    def power(self, exponent: float) -> Range:
        """Range of the powers that are defined, with a whole or half number as exponent."""
        if exponent < 0.0:
            return self.power(-exponent).inverse()
        if self.low >= 0.0 or exponent % 2.0 == 1.0:
            return Range(low=_power(self.low, exponent), high=_power(self.high, exponent), length=self.length)
        if exponent % 2.0 == 0.0:
            near, far = max(0.0, -self.high), max(-self.low, self.high)
            return Range(low=_power(near, exponent), high=_power(far, exponent), length=self.length)
        return Range(low=0.0, high=_power(max(0.0, self.high), exponent), length=self.length)

    def root(self) -> Range:
        """Range of the square roots that are defined."""
        return self.power(0.5)

    def absolute(self) -> Range:
        """Range of the absolute values."""
        return Range(low=max(0.0, self.low, -self.high), high=max(-self.low, self.high), length=self.length)

    def entry(self) -> Range:
        """Range of one entry, of the mean and of the extremes of a row."""
        return Range(low=self.low, high=self.high)

    def count(self) -> Range:
        """Range of the number of known entries of a row."""
        return Range(low=0.0, high=math.inf if self.length is None else float(self.length))

    def total(self) -> Range:
        """Range of the sum of a row."""
        if self.length is None:
            return Range(low=0.0 if self.low >= 0.0 else -math.inf, high=0.0 if self.high <= 0.0 else math.inf)
        return Range(low=_product(self.length, self.low), high=_product(self.length, self.high))

    def norm(self) -> Range:
        """Range of the Euclidean norm of a row."""
        return self.power(2.0).total().root()


def _common_length(one: Range, other: Range) -> int | None:
    return other.length if one.length is None else one.length


def _product(one: float, other: float) -> float:
    """Product of two ends of ranges; zero times infinity is zero, since no value is infinite."""
    return 0.0 if 0.0 in (one, other) else one * other


def _power(base: float, exponent: float) -> float:
    try:
        return float(base**exponent)
    except OverflowError:
        return math.copysign(math.inf, base)
