"""Demands of a study on its choice: bounds, chances and tails, by a quantity or by a requirement."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import ClassVar

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


@dataclass(frozen=True, slots=True, kw_only=True)
class RiskChoice(ABC):
    """Base of the demands on replicates.

    Attributes:
        share_key: The key of its share in a study.
        id: Its id, such as ``chance:SYS-005``.
        bound: The bound.
        share: The share of the replicates.
    """

    share_key: ClassVar[str]

    id: str
    bound: BoundChoice | RequirementBound
    share: float

    @abstractmethod
    def risk(self, threshold: Threshold) -> Risk:
        """The demand, on the threshold that its bound gives.

        Raises:
            TradeoffError: The share is not between 0 and 1.
        """


class ChanceChoice(RiskChoice):
    """A bound that a share of the replicates must meet."""

    __slots__ = ()

    share_key = "probability"

    def risk(self, threshold: Threshold) -> ChanceBound:
        """The chance constraint; see `RiskChoice.risk`."""
        return ChanceBound(
            requirement=self.id,
            measure=threshold.measure,
            comparison=threshold.comparison,
            value=threshold.value,
            unit=threshold.unit,
            probability=self.share,
        )


class TailChoice(RiskChoice):
    """A bound on the mean of the share of the replicates that is worst."""

    __slots__ = ()

    share_key = "worst_share"

    def risk(self, threshold: Threshold) -> TailBound:
        """The bound on the tail; see `RiskChoice.risk`."""
        return TailBound(
            requirement=self.id,
            measure=threshold.measure,
            comparison=threshold.comparison,
            value=threshold.value,
            unit=threshold.unit,
            share=self.share,
        )
