"""Demands of a study on its choice: bounds, chances and tails, by a quantity or by a requirement."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass, replace
from typing import Any, ClassVar

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


class RiskChoice(ABC):
    """Base of the demands on replicates.

    Attributes:
        share_key: The key of its share in a study.
        id: Its id, such as ``chance:SYS-005``.
        bound: What is bounded.
    """

    __slots__ = ()

    share_key: ClassVar[str]

    id: str
    bound: BoundChoice | RequirementBound

    @classmethod
    @abstractmethod
    def of(cls, id_: str, bound: BoundChoice | RequirementBound, share: float) -> RiskChoice:
        """A demand with a share."""

    @property
    @abstractmethod
    def share(self) -> float:
        """The share of the replicates."""

    def changed(self, **fields: Any) -> RiskChoice:
        """The same demand with other values of some fields."""
        return replace(self, **fields)  # type: ignore[type-var]

    @abstractmethod
    def risk(self, threshold: Threshold) -> Risk:
        """The demand, on the threshold that its bound gives.

        Raises:
            TradeoffError: The share is not between 0 and 1.
        """


@dataclass(frozen=True, slots=True, kw_only=True)
class ChanceChoice(RiskChoice):
    """A share of the replicates that must meet a bound.

    Attributes:
        id: Its id, such as ``chance:SYS-005``.
        bound: What is bounded.
        probability: The share of replicates that must meet it.
    """

    share_key: ClassVar[str] = "probability"

    id: str
    bound: BoundChoice | RequirementBound
    probability: float

    @classmethod
    def of(cls, id_: str, bound: BoundChoice | RequirementBound, share: float) -> ChanceChoice:
        """A demand with a probability."""
        return cls(id=id_, bound=bound, probability=share)

    @property
    def share(self) -> float:
        """The probability."""
        return self.probability

    def risk(self, threshold: Threshold) -> ChanceBound:
        """The chance constraint; see `RiskChoice.risk`."""
        return ChanceBound(
            requirement=self.id,
            measure=threshold.measure,
            comparison=threshold.comparison,
            value=threshold.value,
            unit=threshold.unit,
            probability=self.probability,
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class TailChoice(RiskChoice):
    """A bound on the mean of the worst replicates.

    Attributes:
        id: Its id, such as ``tail:SYS-005``.
        bound: What is bounded.
        worst_share: The share of replicates whose mean must meet it.
    """

    share_key: ClassVar[str] = "worst_share"

    id: str
    bound: BoundChoice | RequirementBound
    worst_share: float

    @classmethod
    def of(cls, id_: str, bound: BoundChoice | RequirementBound, share: float) -> TailChoice:
        """A demand with a share of the worst."""
        return cls(id=id_, bound=bound, worst_share=share)

    @property
    def share(self) -> float:
        """The share of the worst."""
        return self.worst_share

    def risk(self, threshold: Threshold) -> TailBound:
        """The bound on the tail; see `RiskChoice.risk`."""
        return TailBound(
            requirement=self.id,
            measure=threshold.measure,
            comparison=threshold.comparison,
            value=threshold.value,
            unit=threshold.unit,
            share=self.worst_share,
        )
