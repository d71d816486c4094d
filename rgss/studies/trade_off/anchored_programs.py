"""Decision programs with quantities that are still anchored on requirements."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass

from rgss.studies.trade_off.demands import BoundChoice
from rgss.tradeoff import Aim, Anchor, EpsilonConstraint, Program, Tchebycheff, Threshold, ValueFunction


class AnchoredProgram(ABC):
    """Base of the programs that need the requirements' thresholds."""

    __slots__ = ()

    @property
    @abstractmethod
    def name(self) -> str:
        """Its name."""

    @abstractmethod
    def resolved(
        self,
        threshold_of: Callable[[BoundChoice], Threshold],
        quantity_of: Callable[[Anchor, str], float],
        function_of: Callable[[str], ValueFunction],
    ) -> Program:
        """The program with numbers for anchors.

        Args:
            threshold_of: Threshold of a limit.
            quantity_of: Quantity of an anchor, in the unit of a measure.
            function_of: Value function of a measure.

        Raises:
            TradeoffError: The program contradicts itself.
        """


@dataclass(frozen=True, slots=True, kw_only=True)
class AnchoredEpsilonConstraint(AnchoredProgram):
    """The best of one measure under limits on others."""

    aim: Aim
    limits: tuple[BoundChoice, ...]

    @property
    def name(self) -> str:
        """Its name."""
        return "epsilon_constraint"

    def resolved(
        self,
        threshold_of: Callable[[BoundChoice], Threshold],
        quantity_of: Callable[[Anchor, str], float],  # noqa: ARG002
        function_of: Callable[[str], ValueFunction],  # noqa: ARG002
    ) -> EpsilonConstraint:
        """The program with numbers for limits; see `AnchoredProgram.resolved`."""
        return EpsilonConstraint(aim=self.aim, bounds=tuple(threshold_of(limit) for limit in self.limits))


@dataclass(frozen=True, slots=True, kw_only=True)
class AnchoredTchebycheff(AnchoredProgram):
    """The least weighted Tchebycheff distance from a reference point.

    Attributes:
        reference: The quantities aspired to, by measure.
        augmentation: Weight of the sum of the distances.
    """

    reference: tuple[tuple[str, Anchor], ...]
    augmentation: float

    @property
    def name(self) -> str:
        """Its name."""
        return "tchebycheff"

    def resolved(
        self,
        threshold_of: Callable[[BoundChoice], Threshold],  # noqa: ARG002
        quantity_of: Callable[[Anchor, str], float],
        function_of: Callable[[str], ValueFunction],
    ) -> Tchebycheff:
        """The program with the values of the reference point; see `AnchoredProgram.resolved`."""
        return Tchebycheff(
            reference={
                measure: function_of(measure).value_at(quantity_of(anchor, measure))
                for measure, anchor in self.reference
            },
            augmentation=self.augmentation,
        )


StatedProgram = AnchoredProgram | Program
"""A program as a study states it; only those with anchors must be resolved."""
