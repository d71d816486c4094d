"""Trade-off problem: alternatives with their evidence, and the preferences of the choice."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from rgss.errors import TradeoffError
from rgss.tradeoff.problem import (
    Alternative,
    EvidenceTable,
    LevelStructure,
    Risk,
    Threshold,
    ValueFunction,
    WeightBounds,
    Weighting,
    check_evidence,
)
from rgss.tradeoff.programs.additive import AdditiveValue
from rgss.tradeoff.programs.preferences import Preferences, Program, check_preferences


@dataclass(frozen=True, slots=True, kw_only=True)
class TradeProblem(Preferences):
    """Choose one of several alternatives that meets every demand.

    Attributes:
        alternatives: The alternatives, in any order.
        thresholds: Thresholds of the requirements.
        value_functions: One for every measure that has a weight, and for no other.
        weighting: The weights.
        risks: Demands on the replicates.
        program: Decision program; the highest weighted value by default.
        weight_bounds: Bounds and orders of the weights.
        levels: The levels of factors that make each alternative, where levels are to be chosen
            instead of alternatives.

    Raises:
        TradeoffError: The problem is ill posed: it has no alternatives, names a measure that is
            not there, has numbers that are not finite or too few replicates, or contradicts itself.
    """

    alternatives: Sequence[Alternative]
    thresholds: tuple[Threshold, ...]
    value_functions: tuple[ValueFunction, ...]
    weighting: Weighting
    risks: tuple[Risk, ...] = ()
    program: Program = field(default_factory=AdditiveValue)
    weight_bounds: WeightBounds = field(default_factory=WeightBounds)
    levels: LevelStructure | None = None

    def __post_init__(self) -> None:
        check_evidence(self.alternatives)
        check_preferences(self)
        _check_measures_present(self)
        _check_replicates(self)
        if self.levels is not None:
            self.levels.check(self.alternatives)

    def is_feasible(self, alternative: Alternative) -> bool:
        """True if an alternative meets every condition and is known in every measure that decides."""
        return all(
            condition.sense.holds(condition.statistic(alternative), condition.limit) for condition in self.conditions
        ) and all(
            alternative.measures[measure] is not None
            and not (every_replicate and None in (alternative.replicates(measure) or ()))
            for measure, every_replicate in self.evidence_needs.items()
        )

    def feasible_alternatives(self, *, at_most: int) -> Sequence[Alternative]:  # noqa: ARG002 (listed in any case)
        """The alternatives that meet every condition; they are listed already, however many."""
        return [alternative for alternative in self.alternatives if self.is_feasible(alternative)]

    def replicate_count(self, measures: Sequence[str]) -> int:
        """The number of replicates that all alternatives have; see `Preferences.replicate_count`."""
        counts: dict[int, int] = {}
        for alternative in self.alternatives:
            for measure in measures:
                row = alternative.replicates(measure)
                if row is not None:
                    counts.setdefault(len(row), alternative.variant)
        if len(counts) > 1:
            (few, one), *_, (many, other) = sorted(counts.items())
            raise TradeoffError(
                f"variant {one} has {few} replicate{'' if few == 1 else 's'} and variant {other} has {many}, "
                "so there is no common scenario",
                hint="run as many replicates of every variant, or take the regret over weights",
            )
        if not counts:
            raise TradeoffError(
                "regret over replicates needs a measure that is observed in trials",
                hint="value one, or take the regret over weights",
            )
        return next(iter(counts))


def _check_measures_present(problem: TradeProblem) -> None:
    alternatives = problem.alternatives
    if isinstance(alternatives, EvidenceTable):
        known = set(alternatives.measures)
    else:
        known = {measure for alternative in alternatives for measure in alternative.measures}
    for measure, who in problem.measures_named.items():
        if measure not in known:
            raise TradeoffError(
                f"{who} the unknown measure {measure!r}",
                hint=f"the alternatives have {', '.join(sorted(known)) or 'no measures at all'}",
            )
        if isinstance(alternatives, EvidenceTable):
            continue
        for alternative in alternatives:
            if measure not in alternative.measures:
                raise TradeoffError(
                    f"variant {alternative.variant} lacks the measure {measure!r}",
                    hint="measure every variant alike; an unknown value is given as None",
                )


def _check_replicates(problem: TradeProblem) -> None:
    for risk in problem.risks:
        for alternative in problem.alternatives:
            row = alternative.replicates(risk.measure)
            if row is not None and len(row) < risk.replicates_needed:
                raise TradeoffError(
                    f"{risk.requirement} needs {risk.replicates_needed} replicates, variant {alternative.variant} "
                    f"has {len(row)}",
                    hint=f"run at least {risk.replicates_needed} replicates, or ask for less: {risk.demand}",
                )
