"""The trade-off as it is put: alternatives, thresholds, value functions and weights."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import Enum

from rgss.errors import TradeoffError
from rgss.tradeoff.values import ValueFunction, Weighting

EVIDENCE_PREFIX = "evidence:"
"""Begins the pseudo requirement that a weighted measure without a threshold be known at all."""


class Comparison(str, Enum):
    """Which side of its threshold a measure must be on; the threshold itself is good enough."""

    AT_LEAST = ">="
    AT_MOST = "<="

    @classmethod
    def parse(cls, text: str) -> Comparison:
        """Read ``">="`` or ``"<="``.

        Raises:
            TradeoffError: The text is neither.
        """
        for comparison in cls:
            if comparison.value == text:
                return comparison
        raise TradeoffError(f"unknown comparison {text!r}", hint="write >= or <=")


@dataclass(frozen=True, slots=True, kw_only=True)
class Threshold:
    """What a requirement demands of one measure; a requirement may have several thresholds.

    Attributes:
        requirement: Id of the requirement, such as ``SYS-012``.
        measure: The measure that is compared.
        comparison: At least or at most.
        value: The threshold, in the measure's unit.
        unit: That unit, for people.
    """

    requirement: str
    measure: str
    comparison: Comparison
    value: float
    unit: str

    @property
    def name(self) -> str:
        """The constraint as people write it, such as ``SYS-012: P_max >= 0.8 kg``."""
        return f"{self.requirement}: {self.measure} {self.comparison.value} {self.value:g} {self.unit}"

    def margin(self, quantity: float) -> float:
        """How far a quantity is on the good side; negative on the bad side, in the measure's unit."""
        difference = quantity - self.value
        return difference if self.comparison is Comparison.AT_LEAST else -difference

    def is_met_by(self, quantity: float | None) -> bool:
        """Tell whether a quantity meets the threshold; an unknown one (None) does not."""
        return quantity is not None and self.margin(quantity) >= 0.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Alternative:
    """One design that can be chosen, with its evidence.

    Attributes:
        variant: Id of the design variant.
        measures: What is known of it, in each measure's unit; None where the evidence does not
            tell, for instance because no trial succeeded.
    """

    variant: int
    measures: Mapping[str, float | None] = field(hash=False)


@dataclass(frozen=True, slots=True, kw_only=True)
class TradeProblem:
    """Choose the alternative of the highest weighted value among those that meet every threshold.

    An alternative whose evidence does not tell a measure that matters (None) is infeasible. Where
    the measure has a threshold, that requirement counts as violated; where it only has a weight,
    the pseudo requirement ``evidence:<measure>`` does. Nothing is imputed.

    Attributes:
        alternatives: What there is to choose from, in any order.
        thresholds: What the requirements demand.
        value_functions: One for every measure that has a weight, and for no other.
        weighting: The weights.

    Raises:
        TradeoffError: The problem is ill posed: it has no alternatives, names a measure that is
            not there, or has numbers that are not finite.
    """

    alternatives: tuple[Alternative, ...]
    thresholds: tuple[Threshold, ...]
    value_functions: tuple[ValueFunction, ...]
    weighting: Weighting

    def __post_init__(self) -> None:
        _check_alternatives(self)
        _check_value_functions(self)
        _check_thresholds(self)
        _check_measures_present(self)

    @property
    def evidence_measures(self) -> tuple[str, ...]:
        """The measures with a weight above 0 and no threshold: those of the pseudo requirements."""
        bounded = {threshold.measure for threshold in self.thresholds}
        return tuple(measure for measure in self.weighting.deciding_measures if measure not in bounded)

    @property
    def requirements(self) -> tuple[str, ...]:
        """Ids of all requirements, in the order of the thresholds, then the pseudo requirements."""
        ids = [threshold.requirement for threshold in self.thresholds]
        ids += [EVIDENCE_PREFIX + measure for measure in self.evidence_measures]
        return tuple(dict.fromkeys(ids))

    def value_function(self, measure: str) -> ValueFunction:
        """The value function of a weighted measure."""
        return next(function for function in self.value_functions if function.measure == measure)

    def is_feasible(self, alternative: Alternative) -> bool:
        """Tell whether an alternative meets every threshold and is known in every weighted measure."""
        return all(
            threshold.is_met_by(alternative.measures[threshold.measure]) for threshold in self.thresholds
        ) and all(alternative.measures[measure] is not None for measure in self.evidence_measures)


def _check_alternatives(problem: TradeProblem) -> None:
    if not problem.alternatives:
        raise TradeoffError("there are no alternatives to choose from", hint="run the study's variants first")
    seen: set[int] = set()
    for alternative in problem.alternatives:
        if alternative.variant in seen:
            raise TradeoffError(
                f"variant {alternative.variant} is given twice", hint="give every alternative an id of its own"
            )
        seen.add(alternative.variant)
        for measure, quantity in alternative.measures.items():
            if quantity is not None and not math.isfinite(quantity):
                raise TradeoffError(
                    f"{measure!r} of variant {alternative.variant} is {quantity:g}",
                    hint="a measure is a finite number, or None where the evidence does not tell",
                )


def _check_value_functions(problem: TradeProblem) -> None:
    valued: set[str] = set()
    for function in problem.value_functions:
        if function.measure in valued:
            raise TradeoffError(f"{function.measure!r} has two value functions", hint="keep one of them")
        valued.add(function.measure)
        if function.measure not in problem.weighting.weights:
            raise TradeoffError(
                f"{function.measure!r} has a value function but no weight",
                hint="give it a weight (0 is allowed) or take its value function out",
            )
    for measure in problem.weighting.weights:
        if measure not in valued:
            raise TradeoffError(
                f"{measure!r} has a weight but no value function", hint="say what is worst and best for it"
            )


def _check_thresholds(problem: TradeProblem) -> None:
    for threshold in problem.thresholds:
        if not math.isfinite(threshold.value):
            raise TradeoffError(
                f"the threshold of {threshold.requirement} on {threshold.measure!r} is {threshold.value:g}",
                hint="a threshold is a finite number",
            )
        if threshold.requirement.startswith(EVIDENCE_PREFIX):
            raise TradeoffError(
                f"the requirement id {threshold.requirement!r} is reserved",
                hint=f"ids that begin with {EVIDENCE_PREFIX!r} stand for missing evidence; choose another",
            )


def _check_measures_present(problem: TradeProblem) -> None:
    known = {measure for alternative in problem.alternatives for measure in alternative.measures}
    wanted = dict.fromkeys(problem.weighting.weights, "the weights name")
    for threshold in problem.thresholds:
        wanted.setdefault(threshold.measure, f"{threshold.requirement} names")
    for measure, who in wanted.items():
        if measure not in known:
            raise TradeoffError(
                f"{who} the unknown measure {measure!r}",
                hint=f"the alternatives have {', '.join(sorted(known)) or 'no measures at all'}",
            )
        for alternative in problem.alternatives:
            if measure not in alternative.measures:
                raise TradeoffError(
                    f"variant {alternative.variant} lacks the measure {measure!r}",
                    hint="measure every variant alike; an unknown value is given as None",
                )
