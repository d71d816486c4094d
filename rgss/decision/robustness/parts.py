"""Parts of the robustness analysis, each computed by itself: a failure does not affect the others."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from enum import Enum
from types import MappingProxyType
from typing import TypeVar

from rgss.errors import RgssError

Result = TypeVar("Result")


class Part(str, Enum):
    """Part of the analysis, by its place in the document of ``rgss trade --json``."""

    PARETO = "pareto"
    REGIONS = "weight_changes.regions"
    NEAREST = "weight_changes.nearest"
    RANGES = "weight_changes.ranges"
    ACCEPTABILITY = "weight_changes.acceptability"
    UNCERTAINTY = "uncertainty"
    ASSUMPTIONS = "assumptions"
    COSTS = "costs"
    PRICES = "prices"
    REVERSALS = "rank_reversals.of_the_program"
    STRETCHED = "rank_reversals.if_values_were_stretched_over_the_sample"
    EFFECTS = "effects"
    TORNADO = "sensitivity.tornado"
    KEPT = "sensitivity.worth_keeping"
    STAKEHOLDERS = "sensitivity.stakeholders"
    EXCHANGE_RATES = "sensitivity.exchange_rates"

    @property
    def words(self) -> str:
        """Name of the part on pages."""
        return _TITLES[self]


_TITLES = MappingProxyType(
    {
        Part.PARETO: "Pareto front",
        Part.REGIONS: "regions of weights",
        Part.NEAREST: "nearest weights that change the choice",
        Part.RANGES: "range of each weight",
        Part.ACCEPTABILITY: "acceptability and confidence",
        Part.UNCERTAINTY: "probability of the choice, ties and value of more replicates",
        Part.ASSUMPTIONS: "assumptions",
        Part.COSTS: "all costs together",
        Part.PRICES: "price of each requirement",
        Part.REVERSALS: "rank reversal",
        Part.STRETCHED: "rank reversal of values stretched over the sample",
        Part.EFFECTS: "effects of the factors",
        Part.TORNADO: "tornado",
        Part.KEPT: "designs worth keeping",
        Part.STAKEHOLDERS: "stakeholders",
        Part.EXCHANGE_RATES: "exchange rates",
    }
)


@dataclass(frozen=True, slots=True, kw_only=True)
class NotComputed:
    """Reason that a part could not be computed.

    Attributes:
        reason: The obstacle.
        remedy: Remedy; empty if none is known.
    """

    reason: str
    remedy: str

    def __str__(self) -> str:
        return f"{self.reason} ({self.remedy})" if self.remedy else self.reason


@dataclass(frozen=True, slots=True, kw_only=True)
class PartComputer:
    """Computation of parts, with a record of those that fail.

    Attributes:
        missing: Reason for each part that was not computed.
    """

    missing: dict[Part, NotComputed] = field(default_factory=dict)

    def compute(self, part: Part, function: Callable[[], Result], otherwise: Result) -> Result:
        """A part, or its substitute if it cannot be computed.

        Only errors with a reason for the user, a lack of memory, and numbers too large are recorded. All others are
        bugs and propagate.

        Args:
            part: The part.
            function: Function that computes it.
            otherwise: Its empty value.
        """
        try:
            return function()
        except RgssError as error:
            self.missing[part] = NotComputed(reason=error.message, remedy=error.hint)
        except MemoryError:
            self.missing[part] = NotComputed(
                reason="it needs more memory than there is",
                remedy="decide between fewer variants, or give the process more memory",
            )
        except OverflowError:
            self.missing[part] = NotComputed(
                reason="the quantities of a measure are too large to compute with",
                remedy="give the measure a greater unit",
            )
        return otherwise


def not_computed_lines(missing: Mapping[Part, NotComputed]) -> tuple[str, ...]:
    """A sentence for each reason, which names the parts that it prevented."""
    parts: dict[NotComputed, list[str]] = {}
    for part, why in missing.items():
        parts.setdefault(why, []).append(part.words)
    return tuple(
        f"Not computed: {', '.join(titles)}: {why.reason}." + (f" Remedy: {why.remedy}." if why.remedy else "")
        for why, titles in parts.items()
    )
