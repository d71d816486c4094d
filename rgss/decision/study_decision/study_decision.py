"""Decision of a study: choice, reasons, certificate, robustness, suppositions and cautions."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from rgss.assessment import (
    CaseSuccess,
    DriversOfFailures,
    SeedGroup,
)
from rgss.decision.assumptions import AssumptionOutcome
from rgss.decision.screening_result import ScreeningResult
from rgss.decision.sensitivity import Sensitivity
from rgss.decision.study_decision.comparison import SideBySide
from rgss.decision.study_decision.conclusion import Conclusion
from rgss.decision.study_decision.equations import EquationVerification
from rgss.decision.study_decision.findings import RobustnessFindings
from rgss.decision.study_decision.readings import ReadingOutcome
from rgss.decision.study_decision.reasons import ClosestLimit, Gain
from rgss.decision.study_decision.substitutions import DecidingSubstitution
from rgss.decision.study_decision.suppositions import WhatIf
from rgss.measures import ModelGap
from rgss.tradeoff import Decision, DecisionStatus, Overlap, PortfolioDecision, SharedPart
from rgss.tradeoff.elicitation import ElicitedWeights


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class StudyDecision:
    """Decision of a study.

    Attributes:
        study: The study's id.
        trade_command: The command that decides it.
        evidence: Name of the evidence in messages.
        variants: Number of compared variants.
        trials: Number of their trials.
        decision: Choice, ranking, conflicts and certificate.
        conclusion: Conclusion from the verdicts on every design.
        comparison: The choice beside the runner-up; None if nothing is chosen.
        gains: The gains of the choice over the runner-up, in the order of the weights.
        closest_limits: The limits closest to the choice.
        practical_margin: Differences in value below this are of no practical meaning.
        tolerance: Share of a threshold on what varies from trial to trial by which the choice may miss it.
        last_of_equals: True if the largest id of equals is chosen; otherwise the smallest.
        unweighted: Valued measures with weight 0, which no rule of the choice reads.
        shown_feasible: True if verdicts decide whether a variant meets a requirement; otherwise estimates.
        double_counted: Valued measures of which one contains the other.
        shared_parts: Valued measures that depend on measures in common.
        robustness: Near alternatives, and changes that would change the decision; None if not analysed.
        portfolio: The portfolio of designs; None if the study has none.
        screened: The outcome of screening; None without screening.
        what_if: The suppositions that the decision is made under; None without.
        sensitivity: Sensitivity of the decision to its inputs; None if not analysed.
        elicited: Groups whose weights follow from pairwise answers.
        elicited_by: The same of stakeholders, by name.
        gaps: Measures of effectiveness of the choice whose equation and simulation differ by more than 10 %.
        readings: Decision under each reading of the source; empty if not analysed.
        assumptions: The choice under each alternative of each assumption; empty if not requested.
        drivers: Drivers of failures; None if not analysed.
        cases: The success of each case of the workload; empty without a workload.
        equations: Requirements that an equation verifies although its measure has a simulation.
        substitutions: Terms that stand for those that the trials of a deciding measure do not observe.
        seeds: The seeds that were read, if variants may have different numbers; empty otherwise.
    """

    study: str
    trade_command: str
    evidence: str
    variants: int
    trials: int
    decision: Decision
    conclusion: Conclusion
    comparison: SideBySide | None
    gains: tuple[Gain, ...]
    closest_limits: tuple[ClosestLimit, ...]
    practical_margin: float
    double_counted: tuple[Overlap, ...]
    shared_parts: tuple[SharedPart, ...]
    robustness: RobustnessFindings | None
    portfolio: PortfolioDecision | None = None
    screened: ScreeningResult | None = None
    what_if: WhatIf | None = None
    sensitivity: Sensitivity | None = None
    elicited: tuple[ElicitedWeights, ...] = ()
    elicited_by: Mapping[str, ElicitedWeights] = field(default_factory=dict)
    gaps: tuple[ModelGap, ...] = ()
    equations: tuple[EquationVerification, ...] = ()
    substitutions: tuple[DecidingSubstitution, ...] = ()
    readings: tuple[ReadingOutcome, ...] = ()
    assumptions: tuple[AssumptionOutcome, ...] = ()
    drivers: DriversOfFailures | None = None
    cases: tuple[CaseSuccess, ...] = ()
    seeds: tuple[SeedGroup, ...] = ()
    tolerance: float = 0.0
    last_of_equals: bool = False
    unweighted: tuple[str, ...] = ()
    shown_feasible: bool = False

    @property
    def is_alone(self) -> bool:
        """True if a single variant is compared, so that it has no rivals."""
        return self.variants == 1

    @property
    def is_final(self) -> bool:
        """True if the choice and the portfolio are proven best, and no part of the analysis is missing."""
        is_whole = self.robustness is None or not self.robustness.analysis.not_computed
        is_whole &= self.sensitivity is None or not self.sensitivity.not_computed
        return is_settled(self.decision, self.portfolio) and is_whole


def is_settled(decision: Decision, portfolio: PortfolioDecision | None) -> bool:
    """True if a variant, and a portfolio if there is one, is chosen and proven best."""
    return decision.status is DecisionStatus.OPTIMAL and (
        portfolio is None or portfolio.status is DecisionStatus.OPTIMAL
    )
