"""The terms of the mixed-integer program: each is small and compiles itself to CVXPY."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Protocol

from rgss.tradeoff.problem import EVIDENCE_PREFIX, Alternative, Threshold
from rgss.tradeoff.values import ValueFunction


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Selection:
    """The decision variables: which alternative is selected.

    Attributes:
        alternatives: The alternatives of the program, in the order of the variables.
        variable: The CVXPY variable, one boolean for each alternative.
    """

    alternatives: tuple[Alternative, ...]
    variable: Any

    def of_selected(self, coefficients: Sequence[float]) -> Any:
        """The coefficient of the selected alternative, as a CVXPY expression."""
        import cvxpy

        return cvxpy.Constant(list(coefficients)) @ self.variable


class ObjectiveTerm(Protocol):
    """A part of what is maximised."""

    def compile(self, selection: Selection) -> Any:
        """The term as a scalar CVXPY expression."""
        ...


class ConstraintTerm(Protocol):
    """A condition on what is selected."""

    @property
    def name(self) -> str:
        """The condition in words, by which results refer to it."""
        ...

    def compile(self, selection: Selection) -> Any:
        """The term as a CVXPY constraint."""
        ...


@dataclass(frozen=True, slots=True, kw_only=True)
class WeightedValue:
    """The weighted value of the selected alternative in one measure: w v(m).

    Attributes:
        function: The value function v of the measure m.
        weight: The weight w.
    """

    function: ValueFunction
    weight: float

    def compile(self, selection: Selection) -> Any:
        """The term as a scalar CVXPY expression."""
        return selection.of_selected([self._coefficient(alternative) for alternative in selection.alternatives])

    def _coefficient(self, alternative: Alternative) -> float:
        quantity = alternative.measures[self.function.measure]
        # An unknown measure has no value; the constraints forbid to select it, whatever stands here.
        return 0.0 if quantity is None else self.weight * self.function.value_at(quantity)


@dataclass(frozen=True, slots=True, kw_only=True)
class ThresholdConstraint:
    """The selected alternative meets a threshold.

    The margins are scaled by the smallest violation and cut to [-1, 1]. For a selection of exactly
    one alternative that changes nothing, and no violation is so small that it would pass under the
    solver's feasibility tolerance, whatever the measure's unit (coefficient tightening).

    Attributes:
        threshold: The threshold.
    """

    threshold: Threshold

    @property
    def name(self) -> str:
        """The constraint as people write it."""
        return self.threshold.name

    def compile(self, selection: Selection) -> Any:
        """The term as a CVXPY constraint."""
        return selection.of_selected(self._coefficients(selection.alternatives)) >= 0.0

    def _coefficients(self, alternatives: tuple[Alternative, ...]) -> list[float]:
        quantities = [alternative.measures[self.threshold.measure] for alternative in alternatives]
        margins = [-1.0 if quantity is None else self.threshold.margin(quantity) for quantity in quantities]
        smallest_violation = min((-margin for margin in margins if margin < 0.0), default=1.0)
        return [
            -1.0 if margin < 0.0 else 1.0 if margin >= smallest_violation else margin / smallest_violation
            for margin in margins
        ]


@dataclass(frozen=True, slots=True, kw_only=True)
class EvidenceConstraint:
    """The selected alternative is known in a measure.

    Attributes:
        measure: The measure.
    """

    measure: str

    @property
    def name(self) -> str:
        """The pseudo requirement."""
        return EVIDENCE_PREFIX + self.measure

    def compile(self, selection: Selection) -> Any:
        """The term as a CVXPY constraint."""
        unknown = [float(alternative.measures[self.measure] is None) for alternative in selection.alternatives]
        return selection.of_selected(unknown) <= 0.0


@dataclass(frozen=True, slots=True, kw_only=True)
class ChooseOne:
    """Exactly one alternative is selected."""

    @property
    def name(self) -> str:
        """The constraint in words."""
        return "choose exactly one"

    def compile(self, selection: Selection) -> Any:
        """The term as a CVXPY constraint."""
        return selection.of_selected([1.0] * len(selection.alternatives)) == 1.0
