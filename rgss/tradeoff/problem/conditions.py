"""Conditions on an alternative: a threshold, a chance constraint, or a bound on the tail (CVaR)."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from rgss.errors import TradeoffError
from rgss.figures import exact_figure
from rgss.requirements import Comparison

if TYPE_CHECKING:
    from rgss.tradeoff.problem.evidence_table import Alternative

EVIDENCE_PREFIX = "evidence:"
"""Begins the pseudo requirement that a measure that decides be known at all."""

CHANCE_PREFIX = "chance:"
"""Begins the id of a demand on how often a requirement is met."""

TAIL_PREFIX = "tail:"
"""Begins the id of a demand on the worst replicates of a measure."""

LIMIT_PREFIX = "limit:"
"""Begins the id of a limit that an epsilon-constraint program sets."""

PREFIXES = (EVIDENCE_PREFIX, CHANCE_PREFIX, TAIL_PREFIX, LIMIT_PREFIX)


@dataclass(frozen=True, slots=True, kw_only=True)
class BoundedMeasure(ABC):
    """Base of the conditions: a statistic of a measure's evidence on the good side of a limit.

    Attributes:
        requirement: Id of the requirement or demand, such as ``SYS-012`` or ``chance:SYS-005``.
        measure: The measure that is compared.
        comparison: At least or at most.
        value: The threshold, in the measure's unit.
        unit: That unit, for people.

    Raises:
        TradeoffError: The comparison is strict.
    """

    requirement: str
    measure: str
    comparison: Comparison
    value: float
    unit: str

    def __post_init__(self) -> None:
        """Refuse a strict comparison: the feasible set of a program is closed."""
        if self.comparison.is_strict:
            raise TradeoffError(
                f"{self.requirement}: a program cannot have the strict comparison {self.comparison.value!r}",
                hint="write >= or <=",
            )

    @property
    def name(self) -> str:
        """The constraint as people write it, such as ``SYS-012: P_max >= 0.8 kg``."""
        return f"{self.requirement}: {self.demand}"

    @property
    @abstractmethod
    def demand(self) -> str:
        """Text of the condition, such as ``P_max >= 0.8 kg``."""

    @property
    def sense(self) -> Comparison:
        """On which side of its limit the statistic must be."""
        return self.comparison

    @property
    def limit(self) -> float:
        """The number that would change if the requirement were relaxed."""
        return self.value

    @property
    def limit_unit(self) -> str:
        """The unit of `limit`."""
        return self.unit

    @abstractmethod
    def statistic(self, alternative: Alternative) -> float | None:
        """Compared statistic of an alternative; None if unknown."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Threshold(BoundedMeasure):
    """Threshold of a requirement on one measure; a requirement may have several.

    Attributes:
        required: The threshold as it is required, where the choice may miss it by a tolerance; None where it may not.
        tolerance: The share of its magnitude by which it may be missed.
    """

    required: float | None = None
    tolerance: float = 0.0

    @property
    def demand(self) -> str:
        """Text of the condition, such as ``P_max >= 0.8 kg``; with a tolerance, followed by the required limit."""
        text = f"{self.measure} {self.comparison.value} {exact_figure(self.value)}{unit_text(self.unit)}"
        return text if self.required is None else f"{text} (required: {exact_figure(self.required)})"

    def statistic(self, alternative: Alternative) -> float | None:
        """Compared statistic: the quantity itself."""
        return alternative.measures[self.measure]

    def margin(self, quantity: float) -> float:
        """Margin of a quantity to the limit, in the measure's unit; negative where it is violated."""
        return self.comparison.margin(quantity, self.value)

    def is_met_by(self, quantity: float | None) -> bool:
        """True if a quantity meets the threshold; an unknown one (None) does not."""
        return self.comparison.holds(quantity, self.value)

    def tolerated(self, share: float) -> Threshold:
        """The threshold that may be missed by a share of its magnitude."""
        better = math.copysign(share * abs(self.value), self.comparison.margin(1.0, 0.0))
        if share == 0.0:
            return self
        return replace(self, value=self.value - better, required=self.value, tolerance=share)

    def required_for(self, quantity: float) -> float:
        """The required threshold that a quantity just meets, with the tolerance."""
        # The tolerance is of the magnitude, so that it takes a negative threshold the other way.
        better = self.comparison.margin(1.0, 0.0) * math.copysign(1.0, quantity)
        return quantity / (1.0 - better * self.tolerance)


@dataclass(frozen=True, slots=True, kw_only=True)
class ChanceBound(BoundedMeasure):
    """Chance constraint: the share of replicates that must meet a threshold, as in ``P[t_e <= 25 s] >= 0.9``.

    The probability is the share of all replicates that were run. A replicate without the
    measure, such as the time of a task that failed, does not meet the threshold.

    Attributes:
        comparison: On which side of the threshold a replicate must be.
        probability: The share, between 0 and 1.

    Raises:
        TradeoffError: The probability is not between 0 and 1, or the comparison is strict.
    """

    probability: float

    def __post_init__(self) -> None:
        BoundedMeasure.__post_init__(self)
        if not 0.0 < self.probability < 1.0:
            raise TradeoffError(
                f"{self.requirement}: the probability must be between 0 and 1, got {self.probability:g}",
                hint="give a number between 0 and 1, such as 0.9",
            )

    @property
    def demand(self) -> str:
        """Text of the condition, such as ``P[t_e <= 25 s] >= 0.9``."""
        limit = f"{self.comparison.value} {exact_figure(self.value)}{unit_text(self.unit)}"
        return f"P[{self.measure} {limit}] >= {self.probability:g}"

    @property
    def sense(self) -> Comparison:
        """On which side of its limit the statistic must be."""
        return Comparison.AT_LEAST

    @property
    def limit(self) -> float:
        """The number that would change if the requirement were relaxed."""
        return self.probability

    @property
    def limit_unit(self) -> str:
        """The unit of `limit`."""
        return "1"

    @property
    def replicates_needed(self) -> int:
        """So many replicates are needed for one to be allowed to fail."""
        return _one_in(1.0 - self.probability)

    def statistic(self, alternative: Alternative) -> float | None:
        """Compared statistic: the share of replicates that meet the threshold."""
        return self.of_replicates(replicates_of(alternative, self.measure))

    def of_replicates(self, row: Sequence[float | None]) -> float:
        """The share of replicates that meet the threshold."""
        return sum(self.comparison.holds(quantity, self.value) for quantity in row) / len(row)


@dataclass(frozen=True, slots=True, kw_only=True)
class TailBound(BoundedMeasure):
    """A threshold for the mean of the worst replicates: the conditional value at risk.

    With n replicates and a share α, the mean is over the worst α n of them, the last one counting
    with the fraction that is left: the CVaR of Rockafellar and Uryasev ("Optimization of
    conditional value-at-risk", 2000) of the empirical distribution. An alternative with a
    replicate that lacks the measure does not meet it: the worst is then unknown.

    Attributes:
        comparison: At most bounds the largest replicates, at least the smallest.
        share: The share α of replicates that are the tail, above 0 and below 1.

    Raises:
        TradeoffError: The share is not between 0 and 1, or the comparison is strict.
    """

    share: float

    def __post_init__(self) -> None:
        BoundedMeasure.__post_init__(self)
        if not 0.0 < self.share < 1.0:
            raise TradeoffError(
                f"{self.requirement}: the share of the worst replicates must be between 0 and 1, got {self.share:g}",
                hint="give a share between 0 and 1, such as 0.1",
            )

    @property
    def demand(self) -> str:
        """Text of the condition, such as ``mean of the worst 10 % of t_e <= 30 s``."""
        limit = f"{self.comparison.value} {exact_figure(self.value)}{unit_text(self.unit)}"
        return f"mean of the worst {100.0 * self.share:g} % of {self.measure} {limit}"

    @property
    def replicates_needed(self) -> int:
        """So many replicates are needed for the tail to hold a whole one."""
        return _one_in(self.share)

    def statistic(self, alternative: Alternative) -> float | None:
        """Compared statistic: the empirical CVaR; None if a replicate is unknown."""
        return self.of_replicates(replicates_of(alternative, self.measure))

    def of_replicates(self, row: Sequence[float | None]) -> float | None:
        """The mean of the worst replicates; None if one is unknown."""
        known = [quantity for quantity in row if quantity is not None]
        if len(known) < len(row):
            return None
        worst_first = sorted(known, reverse=self.comparison is Comparison.AT_MOST)
        tail = self.share * len(known)
        parts = [min(1.0, max(0.0, tail - place)) for place in range(len(known))]
        # Summed exactly, for gains and losses may cancel to something far smaller than either.
        return math.fsum(part * quantity for part, quantity in zip(parts, worst_first, strict=True)) / tail


Risk = ChanceBound | TailBound
"""A demand on replicates."""

Condition = Threshold | ChanceBound | TailBound
"""Anything that an alternative must meet: a statistic of its evidence on the good side of a limit."""


def replicates_of(alternative: Alternative, measure: str) -> Sequence[float | None]:
    """Quantity of each replicate of a measure; of one that follows from the design, its quantity once."""
    row = alternative.replicates(measure)
    return (alternative.measures[measure],) if row is None else row


def unit_text(unit: str) -> str:
    """A unit behind a number; nothing for a pure number."""
    return "" if unit == "1" else f" {unit}"


def _one_in(share: float) -> int:
    # 1 / 0.05 is 20 and 1 / (1 - 0.95) should be too.
    return math.ceil(round(1.0 / share, 9))
