"""Demands of a study on its choice: bounds, chances and tails, by a quantity or by a requirement."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum
from functools import partial

from rgss.tradeoff import Anchor, ChanceBound, Comparison, Risk, TailBound, Threshold


@dataclass(frozen=True, slots=True, kw_only=True)
class BoundChoice:
    """A bound on a measure.

    Attributes:
        measure: The measure.
        comparison: At least or at most.
        value: The bound.
    """

    measure: str
    comparison: Comparison
    value: Anchor


@dataclass(frozen=True, slots=True, kw_only=True)
class RequirementBound:
    """The bound of a requirement's criterion.

    Attributes:
        requirement: The requirement's id.
    """

    requirement: str


class RiskKind(str, Enum):
    """Kind of a demand on replicates.

    Attributes:
        CHANCE: A bound that a share of the replicates must meet.
        TAIL: A bound on the mean of the share of the replicates that is worst.
    """

    CHANCE = "chance"
    TAIL = "tail"

    @property
    def share_key(self) -> str:
        """The key of the share in a study."""
        return "probability" if self is RiskKind.CHANCE else "worst_share"


@dataclass(frozen=True, slots=True, kw_only=True)
class RiskChoice:
    """A demand on replicates.

    Attributes:
        kind: Its kind.
        id: Its id, such as ``chance:SYS-005``.
        bound: The bound.
        share: The share of the replicates.
    """

    kind: RiskKind
    id: str
    bound: BoundChoice | RequirementBound
    share: float

    def risk(self, threshold: Threshold) -> Risk:
        """The demand, on the threshold that its bound gives.

        Raises:
            TradeoffError: The share is not between 0 and 1.
        """
        made: Callable[..., Risk] = (
            partial(ChanceBound, probability=self.share)
            if self.kind is RiskKind.CHANCE
            else partial(TailBound, share=self.share)
        )
        return made(
            requirement=self.id,
            measure=threshold.measure,
            comparison=threshold.comparison,
            value=threshold.value,
            unit=threshold.unit,
        )
