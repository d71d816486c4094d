"""Preferences and decision programs: demands, values, weights, and the program that they are handed to.

The two classes refer to each other, so they share a file.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, ClassVar

from rgss.errors import TradeoffError
from rgss.tradeoff.milp import Constraint, EvidenceConstraint, StageSolution, StageSolver
from rgss.tradeoff.problem import (
    EVIDENCE_PREFIX,
    PREFIXES,
    Condition,
    Risk,
    Threshold,
    ValueFunction,
    WeightBounds,
    Weighting,
)

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from rgss.tradeoff.problem import Alternative


class Program(ABC):
    """Decision program: the objectives that choose a feasible alternative, stage by stage.

    Base of the frozen dataclasses; its defaults for limits and needs are those of a program by weighted values.
    """

    __slots__ = ()

    name: ClassVar[str]

    @property
    def limits(self) -> tuple[Threshold, ...]:
        """Thresholds in addition to those of the requirements."""
        return ()

    @property
    def aimed_measures(self) -> tuple[str, ...]:
        """Measures that it optimises by their quantities."""
        return ()

    def needs(self, preferences: Preferences) -> Mapping[str, bool]:
        """The measures that must be known, and whether in every replicate, too."""
        return dict.fromkeys(preferences.weighting.deciding_measures, False)

    def check(self, preferences: Preferences) -> None:  # noqa: B027 - most can decide any trade-off
        """Check that the program can decide a trade-off.

        Raises:
            TradeoffError: It cannot.
        """

    @abstractmethod
    def solve(self, preferences: Preferences, solver: StageSolver) -> tuple[StageSolution, ...]:
        """Solve its stages, each given the answers of those before; ends where one is infeasible."""


class Preferences(ABC):
    """Base of the frozen trade-off problems: demands, values, weights, program.

    A measure that decides and is unknown makes an alternative infeasible. Where a threshold bounds
    the measure, that requirement counts as violated; elsewhere the pseudo requirement
    ``evidence:<measure>`` does. Nothing is imputed.

    Attributes:
        thresholds: Thresholds of the requirements.
        value_functions: One for every measure that has a weight, and for no other.
        weighting: The weights.
        risks: Demands on the replicates.
        program: The decision program.
        weight_bounds: Bounds and orders of the weights.
    """

    __slots__ = ()

    thresholds: tuple[Threshold, ...]
    value_functions: tuple[ValueFunction, ...]
    weighting: Weighting
    risks: tuple[Risk, ...]
    program: Program
    weight_bounds: WeightBounds

    @abstractmethod
    def feasible_alternatives(self, *, at_most: int) -> Sequence[Alternative] | None:
        """The alternatives that meet every condition; None where more than so many combinations had to be listed."""

    @property
    def conditions(self) -> tuple[Condition, ...]:
        """Demands that a choice must meet: thresholds, the program's limits, and risks."""
        return (*self.thresholds, *self.program.limits, *self.risks)

    @property
    def evidence_needs(self) -> Mapping[str, bool]:
        """The measures of the pseudo requirements, and whether every replicate must have them."""
        bounded = {threshold.measure for threshold in (*self.thresholds, *self.program.limits)}
        return {
            measure: every_replicate
            for measure, every_replicate in self.program.needs(self).items()
            if every_replicate or measure not in bounded
        }

    @property
    def requirements(self) -> tuple[str, ...]:
        """Ids of all demands, in the order of the conditions, then the pseudo requirements."""
        ids = [condition.requirement for condition in self.conditions]
        ids += [EVIDENCE_PREFIX + measure for measure in self.evidence_needs]
        return tuple(dict.fromkeys(ids))

    @property
    def demands(self) -> Mapping[str, str]:
        """Text of each of the `requirements`."""
        found: dict[str, list[str]] = {}
        for condition in self.conditions:
            found.setdefault(condition.requirement, []).append(condition.demand)
        for measure, every_replicate in self.evidence_needs.items():
            every = " in every replicate" if every_replicate else ""
            found[EVIDENCE_PREFIX + measure] = [f"{measure} is known{every}"]
        return {requirement: " and ".join(demands) for requirement, demands in found.items()}

    @property
    def constraints(self) -> tuple[Constraint, ...]:
        """The demands as terms of a program."""
        return (
            *self.conditions,
            *(
                EvidenceConstraint(measure=measure, every_replicate=every_replicate)
                for measure, every_replicate in self.evidence_needs.items()
            ),
        )

    @property
    def measures_named(self) -> Mapping[str, str]:
        """All required measures, with the origin of each reference."""
        named = dict.fromkeys(self.weighting.weights, "the weights name")
        for condition in self.conditions:
            named.setdefault(condition.measure, f"{condition.requirement} names")
        for measure in self.program.needs(self):
            named.setdefault(measure, f"the {self.program.name} program names")
        return named

    def value_function(self, measure: str) -> ValueFunction:
        """The value function of a weighted measure."""
        return next(function for function in self.value_functions if function.measure == measure)

    @property
    def deciding_functions(self) -> tuple[ValueFunction, ...]:
        """The value functions of the measures with a weight above 0, in the order of the weights."""
        return tuple(self.value_function(measure) for measure in self.weighting.deciding_measures)

    def weight_corners(self) -> NDArray[np.float64]:
        """The corners of the set of weights that agree with the bounds, shape (c, m), in the weights' order.

        Raises:
            TradeoffError: There are too many bounds to enumerate every corner.
        """
        from rgss.tradeoff.programs.weight_vertices import weight_vertices

        return weight_vertices(*self.weight_system())

    def weight_system(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """The bounds on the weights as inequalities ``A w <= b``, fixed weights as two each: A and b."""
        return self.weight_bounds.system(tuple(self.weighting.weights))

    @abstractmethod
    def replicate_count(self, measures: Sequence[str]) -> int:
        """Common number of replicates of the alternatives.

        Args:
            measures: The used measures; those that depend only on the design have no replicates.

        Raises:
            TradeoffError: There are no replicates, or their numbers differ.
        """


def check_preferences(preferences: Preferences) -> None:
    """Check that the preferences are well posed by themselves.

    Raises:
        TradeoffError: It is not.
    """
    _check_value_functions(preferences)
    _check_conditions(preferences)
    preferences.weight_bounds.check(preferences.weighting.weights)
    preferences.program.check(preferences)


def _check_value_functions(preferences: Preferences) -> None:
    valued: set[str] = set()
    for function in preferences.value_functions:
        if function.measure in valued:
            raise TradeoffError(f"{function.measure!r} has two value functions", hint="keep one of them")
        valued.add(function.measure)
        if function.measure not in preferences.weighting.weights:
            raise TradeoffError(
                f"{function.measure!r} has a value function but no weight",
                hint="give it a weight (0 is allowed) or take its value function out",
            )
    for measure in preferences.weighting.weights:
        if measure not in valued:
            raise TradeoffError(
                f"{measure!r} has a weight but no value function", hint="say what is worst and best for it"
            )


def _check_conditions(preferences: Preferences) -> None:
    for condition in (*preferences.thresholds, *preferences.program.limits, *preferences.risks):
        if not math.isfinite(condition.value):
            subject = f"threshold of {condition.requirement} on {condition.measure!r}"
            raise TradeoffError(
                f"{subject} must be finite, got {condition.value:g}",
                hint="give a number",
            )
    for threshold in preferences.thresholds:
        if threshold.requirement.startswith(PREFIXES):
            reserved = threshold.requirement.partition(":")[0] + ":"
            raise TradeoffError(
                f"the requirement id {threshold.requirement!r} is reserved",
                hint=f"ids that begin with {reserved!r} are reserved for demands of other kinds; choose another",
            )
    seen: set[str] = set()
    for risk in preferences.risks:
        if risk.requirement in seen:
            raise TradeoffError(f"{risk.requirement} is demanded twice", hint="keep one of them")
        seen.add(risk.requirement)
