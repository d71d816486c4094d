"""Decision of a study: choice, reasons, certificate, robustness, suppositions and cautions, built once."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from rgss.assessment import (
    CaseSuccess,
    DriversOfFailures,
    SeedGroup,
    VariantMeasures,
    drivers_of_failures,
    judged_measures,
    sequential_seeds,
    success_by_case,
)
from rgss.decision.assumptions import AssumptionOutcome
from rgss.decision.choosing import choose, double_counting, shared_measures, trade_problem, unweighted_measures
from rgss.decision.robustness import Robustness, analyse_robustness
from rgss.decision.screening_result import ScreeningResult
from rgss.decision.sensitivity import Sensitivity, analyse_sensitivity
from rgss.decision.separation import is_separated
from rgss.decision.study_decision.comparison import SideBySide, side_by_side
from rgss.decision.study_decision.conclusion import Conclusion, conclusion_of
from rgss.decision.study_decision.equations import EquationVerification, equation_verifications
from rgss.decision.study_decision.findings import RobustnessFindings, robustness_findings
from rgss.decision.study_decision.readings import ReadingOutcome, reading_outcomes, readings_among
from rgss.decision.study_decision.reasons import ClosestLimit, Gain, closest_limits, gains_over_runner_up
from rgss.decision.study_decision.substitutions import DecidingSubstitution, deciding_substitutions
from rgss.decision.study_decision.suppositions import WhatIf, decision_side
from rgss.decision.what_if import Scenario, measured_in
from rgss.measures import ModelGap, model_gaps
from rgss.studies import Project
from rgss.trace.evidence import FailedVerifications
from rgss.tradeoff import Decision, DecisionStatus, Overlap, PortfolioDecision, SharedPart, SolverRun, TradeProblem
from rgss.tradeoff.elicitation import ElicitedWeights

_NONE_FAILED = FailedVerifications()


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


def decide_study(
    project: Project,
    measured: Sequence[VariantMeasures],
    *,
    evidence: str,
    analysed: bool = True,
    independent: tuple[SolverRun, ...] = (),
    portfolio: PortfolioDecision | None = None,
    screened: ScreeningResult | None = None,
    scenario: Scenario | None = None,
    supposed: Sequence[VariantMeasures] | None = None,
    reopened: tuple[int, ...] = (),
    assumptions: tuple[AssumptionOutcome, ...] = (),
    time_limit: float | None = None,
    failed: FailedVerifications = _NONE_FAILED,
) -> StudyDecision:
    """Decide a study, and analyse the decision; nothing is simulated.

    Args:
        project: The project with its study, without suppositions.
        measured: Every variant with its estimates and records, by ascending id.
        evidence: Name of the evidence in messages.
        analysed: True to analyse the robustness too, which takes some seconds.
        independent: Runs of other solvers, as further checks.
        portfolio: The portfolio of the study; None if it has none.
        screened: The outcome of screening; None without.
        scenario: Suppositions that the decision is made under; None for the study as it is.
        supposed: Every variant under the suppositions; by default estimated again from the trials of the study.
        reopened: Designs that screening would promote under the suppositions.
        assumptions: The choice under each alternative of each assumption, which needs the evidence store.
        time_limit: Seconds for the runs of a solver over levels, for each decision that is made.
        failed: Requirements that tests or verification records show are not met.

    Raises:
        EvidenceError: Trials of the study have no evidence.
        TradeoffError: The choice is ill posed, or no optimum was proved.
        DefinitionError: As for `trade_problem`.
    """
    problem = trade_problem(project, measured)
    decision = choose(project, measured, problem=problem, independent=independent, time_limit=time_limit)
    what_if = None
    if scenario is not None:
        before = decision_side(project, measured, decision)
        units = {measure: project.measures.measure(measure).unit for measure in before.estimates}
        project, measured = scenario.project, measured_in(scenario, measured) if supposed is None else supposed
        problem = trade_problem(project, measured)
        decision = choose(project, measured, problem=problem, independent=independent, time_limit=time_limit)
        after = decision_side(project, measured, decision)
        what_if = WhatIf(
            scenario=scenario,
            units=units,
            before=before,
            after=after,
            reopened=reopened,
            separated=_separated(project, measured, before.decision.chosen, decision.chosen),
        )
    return study_decision(
        project,
        measured,
        decision,
        analyse_robustness(project, measured, decision, problem=problem) if analysed else None,
        problem=problem,
        evidence=evidence,
        portfolio=portfolio,
        screened=screened,
        what_if=what_if,
        readings=_readings(project, measured, assumptions) if analysed else (),
        assumptions=assumptions,
        failed=failed,
    )


def _separated(
    project: Project, measured: Sequence[VariantMeasures], former: int | None, chosen: int | None
) -> bool | None:
    if former is None or chosen is None or former == chosen:
        return None
    return is_separated(project, measured, chosen, former)


def study_decision(
    project: Project,
    measured: Sequence[VariantMeasures],
    decision: Decision,
    found: Robustness | None,
    *,
    problem: TradeProblem,
    evidence: str,
    portfolio: PortfolioDecision | None = None,
    screened: ScreeningResult | None = None,
    what_if: WhatIf | None = None,
    readings: tuple[ReadingOutcome, ...] = (),
    assumptions: tuple[AssumptionOutcome, ...] = (),
    failed: FailedVerifications = _NONE_FAILED,
) -> StudyDecision:
    """The decision of a study from a choice and its analysis; the arguments are those of `decide_study`.

    Args:
        project: The project, under the suppositions if there are any.
        measured: Every variant with its estimates.
        decision: The choice between them.
        found: Its robustness; None if not analysed.
        problem: The trade-off that was decided.
        evidence: Name of the evidence.
        portfolio: The portfolio.
        screened: The outcome of screening.
        what_if: The effect of suppositions.
        readings: Decision under each reading of the source.
        assumptions: The choice under each alternative of each assumption.
        failed: Requirements that tests or verification records show are not met.
    """
    return StudyDecision(
        study=project.study.id,
        trade_command=project.command("trade"),
        evidence=evidence,
        variants=len(measured),
        trials=sum(len(entry.records) for entry in measured),
        decision=decision,
        conclusion=conclusion_of(project, measured, decision.chosen, failed),
        comparison=side_by_side(project, measured, decision),
        gains=gains_over_runner_up(decision),
        closest_limits=closest_limits(problem, decision.chosen),
        practical_margin=project.study.trade_off.practical_margin,
        tolerance=project.study.trade_off.tolerance,
        last_of_equals=project.study.trade_off.last_of_equals,
        unweighted=unweighted_measures(project),
        shown_feasible=project.study.trade_off.shown_feasible,
        double_counted=double_counting(project),
        shared_parts=shared_measures(project),
        robustness=None if found is None else robustness_findings(project, found, chosen=decision.chosen),
        sensitivity=None
        if found is None
        else analyse_sensitivity(project, measured, decision, found, problem=problem, is_supposed=what_if is not None),
        elicited=project.study.trade_off.elicited,
        elicited_by=project.study.trade_off.elicited_by,
        portfolio=portfolio,
        screened=screened,
        what_if=what_if,
        gaps=_gaps(project, measured, decision),
        equations=equation_verifications(project, measured),
        substitutions=deciding_substitutions(project, measured),
        readings=readings,
        assumptions=assumptions,
        drivers=None if found is None else _drivers(project, measured),
        cases=success_by_case(project, measured),
        seeds=sequential_seeds(project, measured),
    )


def _readings(
    project: Project, measured: Sequence[VariantMeasures], assumptions: Sequence[AssumptionOutcome]
) -> tuple[ReadingOutcome, ...]:
    # Each reading is one of the assumptions, and decided already if those are analysed.
    return readings_among(project, assumptions) if assumptions else reading_outcomes(project, measured)


def _drivers(project: Project, measured: Sequence[VariantMeasures]) -> DriversOfFailures:
    records = [record for entry in measured for record in entry.records]
    return drivers_of_failures(records, carried=project.study.task.carried)


def _gaps(project: Project, measured: Sequence[VariantMeasures], decision: Decision) -> tuple[ModelGap, ...]:
    """Notable differences between equation and simulation in the measures by which the choice is judged."""
    shown = judged_measures(project)
    chosen = next((entry for entry in measured if entry.variant.id == decision.chosen), None)
    found = () if chosen is None else model_gaps(project.measures, chosen.estimates)
    return tuple(gap for gap in found if gap.measure in shown and gap.is_notable)
