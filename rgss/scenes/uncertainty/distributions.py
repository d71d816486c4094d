"""Probability distributions by their inverse cumulative distribution functions, computed by SciPy."""

from __future__ import annotations

import math
from dataclasses import dataclass


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
        """The value that a share of the draws lies below."""
        from scipy.stats import norm

        return float(norm.ppf(share, loc=self.mean, scale=self.sd))

    @property
    def support(self) -> tuple[float, float]:
        """Least and greatest value."""
        return -math.inf, math.inf


@dataclass(frozen=True, slots=True, kw_only=True)
class TruncatedNormal:
    """A normal distribution without what lies beyond two ends.

    Attributes:
        mean: Mean of the normal distribution, not of what is left of it.
        sd: Standard deviation of the normal distribution.
        low: Least value.
        high: Greatest value.
    """

    mean: float
    sd: float
    low: float
    high: float

    def quantile(self, share: float) -> float:
        """The value that a share of the draws lies below."""
        from scipy.stats import truncnorm

        low, high = (self.low - self.mean) / self.sd, (self.high - self.mean) / self.sd
        value = float(truncnorm.ppf(share, low, high, loc=self.mean, scale=self.sd))
        return min(self.high, max(self.low, value))

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
        """The value that a share of the draws lies below."""
        from scipy.stats import uniform

        return float(uniform.ppf(share, loc=self.low, scale=self.high - self.low))

    @property
    def support(self) -> tuple[float, float]:
        """Least and greatest value."""
        return self.low, self.high


@dataclass(frozen=True, slots=True, kw_only=True)
class LogNormal:
    """A log-normal distribution: its logarithm is normal.

    Attributes:
        median: Half of the draws lie below it.
        geometric_sd: Factor by which a standard deviation of the logarithm multiplies; greater than 1.
    """

    median: float
    geometric_sd: float

    def quantile(self, share: float) -> float:
        """The value that a share of the draws lies below."""
        from scipy.stats import lognorm

        return float(lognorm.ppf(share, math.log(self.geometric_sd), scale=self.median))

    @property
    def support(self) -> tuple[float, float]:
        """Least and greatest value; draws near the least are above it by as little as one wants."""
        return math.nextafter(0.0, 1.0), math.inf


@dataclass(frozen=True, slots=True, kw_only=True)
class Discrete:
    """A distribution over a few values.

    Attributes:
        values: The values, in ascending order.
        weights: How often each is drawn, in any unit.
    """

    values: tuple[float, ...]
    weights: tuple[float, ...]

    def quantile(self, share: float) -> float:
        """The least value up to which at least a share of the draws lies."""
        from scipy.stats import rv_discrete

        whole = math.fsum(self.weights)
        places = rv_discrete(values=(range(len(self.values)), [weight / whole for weight in self.weights]))
        return self.values[int(places.ppf(share))]

    @property
    def support(self) -> tuple[float, float]:
        """Least and greatest value."""
        return self.values[0], self.values[-1]


@dataclass(frozen=True, slots=True, kw_only=True)
class Constant:
    """A value that is known, and differs from the one of the files.

    Attributes:
        value: The value.
    """

    value: float

    def quantile(self, share: float) -> float:  # noqa: ARG002 - all shares are this value
        """The value."""
        return self.value

    @property
    def support(self) -> tuple[float, float]:
        """The value, twice."""
        return self.value, self.value


Distribution = Normal | TruncatedNormal | Uniform | LogNormal | Discrete | Constant
