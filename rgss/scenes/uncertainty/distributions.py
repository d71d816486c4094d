"""Probability distributions with their inverse cumulative distribution functions (quantile functions).

They use SciPy's special functions instead of `scipy.stats`, whose argument checks take fifty times as long as the
evaluation of a single number.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import accumulate


@dataclass(frozen=True, slots=True, kw_only=True)
class Normal:
    """A normal distribution.

    Attributes:
        mean: Its mean.
        sd: Its standard deviation.
    """

    mean: float
    sd: float

    def quantile(self, share: float) -> float:
        """Quantile function: the value below which a share of the draws lies."""
        from scipy.special import ndtri

        return float(ndtri(share) * self.sd + self.mean)

    @property
    def support(self) -> tuple[float, float]:
        """Least and greatest value."""
        return -math.inf, math.inf


@dataclass(frozen=True, slots=True, kw_only=True)
class TruncatedNormal:
    """A normal distribution truncated to an interval.

    Attributes:
        mean: Mean of the normal distribution before truncation.
        sd: Standard deviation of the normal distribution before truncation.
        low: Least value.
        high: Greatest value.
    """

    mean: float
    sd: float
    low: float
    high: float

    def quantile(self, share: float) -> float:
        """Quantile function: the value below which a share of the draws lies."""
        low, high = (self.low - self.mean) / self.sd, (self.high - self.mean) / self.sd
        # The upper tail is evaluated as the mirrored lower one, where probabilities near 0 keep their precision.
        value = _between(share, low, high) if low < 0.0 else -_between(1.0 - share, -high, -low)
        return min(self.high, max(self.low, value * self.sd + self.mean))

    @property
    def support(self) -> tuple[float, float]:
        """Least and greatest value."""
        return self.low, self.high


@dataclass(frozen=True, slots=True, kw_only=True)
class Uniform:
    """A uniform distribution.

    Attributes:
        low: Least value.
        high: Greatest value.
    """

    low: float
    high: float

    def quantile(self, share: float) -> float:
        """Quantile function: the value below which a share of the draws lies."""
        return share * (self.high - self.low) + self.low

    @property
    def support(self) -> tuple[float, float]:
        """Least and greatest value."""
        return self.low, self.high


@dataclass(frozen=True, slots=True, kw_only=True)
class LogNormal:
    """A log-normal distribution: its logarithm is normal.

    Attributes:
        median: The median.
        geometric_sd: Geometric standard deviation, exp of that of the logarithm; greater than 1.
    """

    median: float
    geometric_sd: float

    def quantile(self, share: float) -> float:
        """Quantile function: the value below which a share of the draws lies."""
        from scipy.special import ndtri

        return float(math.exp(math.log(self.geometric_sd) * ndtri(share)) * self.median)

    @property
    def support(self) -> tuple[float, float]:
        """Infimum and greatest value; the infimum is not attained."""
        return math.nextafter(0.0, 1.0), math.inf


@dataclass(frozen=True, slots=True, kw_only=True)
class Discrete:
    """A distribution over a few values.

    Attributes:
        values: The values, in ascending order.
        weights: Relative frequency of each value, not normalised.
    """

    values: tuple[float, ...]
    weights: tuple[float, ...]

    def quantile(self, share: float) -> float:
        """Quantile function: the least value up to which at least a share of the draws lies."""
        whole = math.fsum(self.weights)
        reached = accumulate(weight / whole for weight in self.weights)
        # By rounding the last cumulative sum may be below 1.
        return next((value for value, most in zip(self.values, reached, strict=True) if most >= share), self.values[-1])

    @property
    def support(self) -> tuple[float, float]:
        """Least and greatest value."""
        return self.values[0], self.values[-1]


@dataclass(frozen=True, slots=True, kw_only=True)
class Constant:
    """A known value in place of that of the files."""

    value: float

    def quantile(self, share: float) -> float:  # noqa: ARG002 - all shares are this value
        """The value."""
        return self.value

    @property
    def support(self) -> tuple[float, float]:
        """The value, twice."""
        return self.value, self.value


Distribution = Normal | TruncatedNormal | Uniform | LogNormal | Discrete | Constant


def _between(share: float, low: float, high: float) -> float:
    """Quantile function of the standard normal distribution truncated to an interval; the lower end is negative.

    Computed with logarithms, for precision with ends far out in a tail: ``Φ⁻¹(Φ(low) + share (Φ(high) - Φ(low)))``.
    """
    from scipy.special import log_ndtr, ndtri_exp

    below, above = float(log_ndtr(low)), float(log_ndtr(high))
    if share <= 0.0 or below >= above:
        return low
    mass = above + math.log1p(-math.exp(below - above))
    part = math.log(share) + mass
    greater, less = max(below, part), min(below, part)
    return float(ndtri_exp(min(above, greater + math.log1p(math.exp(less - greater)))))
