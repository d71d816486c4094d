"""Deciding a study: the choice, its analysis, and the decision that every renderer reads, built once."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from rgss.assessment import (
    DriversOfFailures,
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
from rgss.decision.sensitivity import analyse_sensitivity
from rgss.decision.separation import is_separated
from rgss.decision.study_decision.comparison import side_by_side
from rgss.decision.study_decision.conclusion import conclusion_of
from rgss.decision.study_decision.equations import equation_verifications
from rgss.decision.study_decision.findings import robustness_findings
from rgss.decision.study_decision.readings import ReadingOutcome, reading_outcomes, readings_among
from rgss.decision.study_decision.reasons import closest_limits, gains_over_runner_up
from rgss.decision.study_decision.study_decision import StudyDecision
from rgss.decision.study_decision.substitutions import deciding_substitutions
from rgss.decision.study_decision.suppositions import WhatIf, decision_side
from rgss.decision.what_if import Scenario, measured_in
from rgss.measures import ModelGap, model_gaps
from rgss.studies import Project
from rgss.trace.evidence import FailedVerifications
from rgss.tradeoff import Decision, PortfolioDecision, SolverRun, TradeProblem

_NONE_FAILED = FailedVerifications()


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
    choice = _choice(project, measured, independent=independent, time_limit=time_limit)
    what_if = None
    if scenario is not None:
        former, measured = choice, measured_in(scenario, measured) if supposed is None else supposed
        choice = _choice(scenario.project, measured, independent=independent, time_limit=time_limit)
        what_if = _what_if(scenario, former, choice, reopened=reopened)
    found = None
    if analysed:
        found = analyse_robustness(choice.project, measured, choice.decision, problem=choice.problem)
    return replace(
        study_decision(choice, found, evidence=evidence, what_if=what_if, failed=failed),
        portfolio=portfolio,
        screened=screened,
        readings=_readings(choice, assumptions) if analysed else (),
        assumptions=assumptions,
    )


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Choice:
    """A choice, with what it was made from.

    Attributes:
        project: The project, under the suppositions if there are any.
        measured: Every variant with its estimates.
        problem: The trade-off.
        decision: The decision.
    """

    project: Project
    measured: Sequence[VariantMeasures]
    problem: TradeProblem
    decision: Decision


def _choice(
    project: Project,
    measured: Sequence[VariantMeasures],
    *,
    independent: tuple[SolverRun, ...],
    time_limit: float | None,
) -> Choice:
    problem = trade_problem(project, measured)
    decision = choose(project, measured, problem=problem, independent=independent, time_limit=time_limit)
    return Choice(project=project, measured=measured, problem=problem, decision=decision)


def _what_if(scenario: Scenario, former: Choice, choice: Choice, *, reopened: tuple[int, ...]) -> WhatIf:
    before = decision_side(former.project, former.measured, former.decision)
    return WhatIf(
        scenario=scenario,
        units={measure: former.project.measures.measure(measure).unit for measure in before.estimates},
        before=before,
        after=decision_side(choice.project, choice.measured, choice.decision),
        reopened=reopened,
        separated=_separated(choice, former.decision.chosen),
    )


def _separated(choice: Choice, former: int | None) -> bool | None:
    chosen = choice.decision.chosen
    if former is None or chosen is None or former == chosen:
        return None
    return is_separated(choice.project, choice.measured, chosen, former)


def study_decision(
    choice: Choice,
    found: Robustness | None,
    *,
    evidence: str,
    what_if: WhatIf | None = None,
    failed: FailedVerifications = _NONE_FAILED,
) -> StudyDecision:
    """The decision of a study as it follows from a choice: without a portfolio, screening, readings and assumptions.

    Args:
        choice: The choice.
        found: Its robustness; None if not analysed.
        evidence: Name of the evidence.
        what_if: The effect of suppositions.
        failed: Requirements that tests or verification records show are not met.
    """
    project, measured, decision = choice.project, choice.measured, choice.decision
    trade_off = project.study.trade_off
    sensitivity = None
    if found is not None:
        sensitivity = analyse_sensitivity(
            project, measured, decision, found, problem=choice.problem, is_supposed=what_if is not None
        )
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
        closest_limits=closest_limits(choice.problem, decision.chosen),
        practical_margin=trade_off.practical_margin,
        tolerance=trade_off.tolerance,
        last_of_equals=trade_off.last_of_equals,
        unweighted=unweighted_measures(project),
        shown_feasible=trade_off.shown_feasible,
        double_counted=double_counting(project),
        shared_parts=shared_measures(project),
        robustness=None if found is None else robustness_findings(project, found, chosen=decision.chosen),
        sensitivity=sensitivity,
        elicited=trade_off.elicited,
        elicited_by=trade_off.elicited_by,
        what_if=what_if,
        gaps=_gaps(project, measured, decision),
        equations=equation_verifications(project, measured),
        substitutions=deciding_substitutions(project, measured),
        drivers=None if found is None else _drivers(project, measured),
        cases=success_by_case(project, measured),
        seeds=sequential_seeds(project, measured),
    )


def _readings(choice: Choice, assumptions: Sequence[AssumptionOutcome]) -> tuple[ReadingOutcome, ...]:
    # Each reading is one of the assumptions, and decided already if those are analysed.
    if assumptions:
        return readings_among(choice.project, assumptions)
    return reading_outcomes(choice.project, choice.measured)


def _drivers(project: Project, measured: Sequence[VariantMeasures]) -> DriversOfFailures:
    records = [record for entry in measured for record in entry.records]
    return drivers_of_failures(records, carried=project.study.task.carried)


def _gaps(project: Project, measured: Sequence[VariantMeasures], decision: Decision) -> tuple[ModelGap, ...]:
    """Notable differences between equation and simulation in the measures by which the choice is judged."""
    shown = judged_measures(project)
    chosen = next((entry for entry in measured if entry.variant.id == decision.chosen), None)
    found = () if chosen is None else model_gaps(project.measures, chosen.estimates)
    return tuple(gap for gap in found if gap.measure in shown and gap.is_notable)
