"""Trade-off of a study: values, weights, program and demands, as its file states them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from rgss.findings import Finding
from rgss.studies.trade_off.anchored_programs import StatedProgram
from rgss.studies.trade_off.demands import RiskChoice
from rgss.studies.trade_off.document import PortfolioEntry
from rgss.studies.trade_off.sensitivity import SensitivityChoice
from rgss.studies.trade_off.stakeholders import Stakeholder
from rgss.tradeoff import (
    AdditiveValue,
    AnchoredValue,
    CriterionNode,
    ElicitedInterval,
    ElicitedOrder,
    WeightBounds,
    Weighting,
    weighting_of,
)
from rgss.tradeoff.elicitation import ElicitedWeights


@dataclass(frozen=True, slots=True, kw_only=True)
class TradeOff:
    """Trade-off of a study, with quantities that are still anchored on requirements.

    Attributes:
        valued: The value function of each measure, in the order of the file.
        criteria: The hierarchy of criteria with their weights.
        intervals: Elicited bounds on weights.
        orders: Elicited orders of weights.
        program: The program that decides.
        risks: Demands on the replicates.
        practical_margin: Alternatives within it of the best are near-ties.
        tolerance: Share of a threshold by which the estimate of a measure from trials may miss it; verdicts have none.
        last_of_equals: Whether the last of the design space is chosen of designs of the same value, not the first.
        choose_levels: Whether levels of factors are chosen instead of variants.
        shown_feasible: Whether a choice must be shown to meet the requirements, by the end of the
            interval that a verdict needs; by its estimates otherwise.
        portfolio: The portfolio; None if the study has none.
        elicited: The groups whose weights follow from pairwise answers.
        stakeholders: Stakeholders with weights of their own.
        accept_within: Distance from a stakeholder's best value up to which they accept a design.
        sensitivity: Ranges of the inputs of the decision.
        range_places: For each stated range of the sensitivity a finding at its place, for messages on it.
    """

    valued: tuple[AnchoredValue, ...]
    criteria: tuple[CriterionNode, ...]
    intervals: tuple[ElicitedInterval, ...] = ()
    orders: tuple[ElicitedOrder, ...] = ()
    program: StatedProgram = field(default_factory=AdditiveValue)
    risks: tuple[RiskChoice, ...] = ()
    practical_margin: float = 0.0
    tolerance: float = 0.0
    last_of_equals: bool = False
    choose_levels: bool = False
    shown_feasible: bool = False
    portfolio: PortfolioEntry | None = None
    elicited: tuple[ElicitedWeights, ...] = ()
    stakeholders: tuple[Stakeholder, ...] = ()
    accept_within: float = 0.05
    sensitivity: SensitivityChoice = field(default_factory=SensitivityChoice)
    range_places: tuple[Finding, ...] = ()

    @property
    def weighting(self) -> Weighting:
        """The weight of every measure."""
        return weighting_of(self.criteria)

    @property
    def elicited_by(self) -> Mapping[str, ElicitedWeights]:
        """The weights of stakeholders that follow from pairwise answers, by name."""
        return {one.name: one.elicited for one in self.stakeholders if one.elicited is not None}

    @property
    def weight_bounds(self) -> WeightBounds:
        """Elicited bounds on the weights."""
        return WeightBounds(intervals=self.intervals, orders=self.orders)
