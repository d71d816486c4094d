"""The choice under each alternative of each questioned assumption."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from rgss.assessment import VariantMeasures
from rgss.decision.assumptions.fidelities import AdmittedDesigns, MotionFailures, admitted_designs, motion_failures
from rgss.decision.assumptions.names import AS_STATED, value_in_words
from rgss.decision.assumptions.questions import FIDELITY, Question, questions_of
from rgss.decision.choosing import choose
from rgss.decision.separation import is_separated
from rgss.decision.what_if import Scenario, ScenarioEvidenceReader, suppose
from rgss.errors import RgssError
from rgss.evidence import EvidenceStore
from rgss.figures import exact_figure
from rgss.studies import Project
from rgss.tradeoff import Decision
from rgss.tradeoff.problem import EVIDENCE_PREFIX
from rgss.trials.pieces import TrialSpec


@dataclass(frozen=True, slots=True, kw_only=True)
class AssumptionOutcome:
    """The choice under one alternative of one assumption.

    Attributes:
        question: The assumption and its alternative.
        taken_as: Its value in the study.
        chosen: The variant that is then chosen; None if none is, or that is not known.
        ties: The variants that are then as good.
        feasible: Number of variants that then meet every requirement by their estimates.
        is_same: True if the study's choice is still among the best, or the evidence does not separate it from the
            other one; None if that is not known.
        is_unseparated: True if another one is chosen that the evidence does not separate from the study's choice.
        trials: Number of trials that it needs.
        missing: Number of those that would have to be run.
        read_off: Number of those that follow from stored searches.
        otherwise: Number of trials that succeed only under the alternative, and of those that succeed only in the
            study.
        otherwise_of_choice: Number of these that are trials of the study's choice.
        excluded_by: Requirements by which the study's evidence excludes the other choice.
        missed_by_choice: Requirements that the study's choice misses under the alternative.
        in_motion: For another fidelity, the trials of the study that fail in motion.
        admitted: For another fidelity, the designs that only its trials admit.
        reason: Reason for a missing answer; empty if there is one, or if trials are missing.
    """

    question: Question
    taken_as: str = ""
    chosen: int | None = None
    ties: tuple[int, ...] = ()
    feasible: int = 0
    is_same: bool | None = None
    is_unseparated: bool = False
    trials: int = 0
    missing: int = 0
    read_off: int = 0
    otherwise: tuple[int, int] = (0, 0)
    otherwise_of_choice: int = 0
    excluded_by: tuple[str, ...] = ()
    missed_by_choice: tuple[str, ...] = ()
    in_motion: MotionFailures | None = None
    admitted: AdmittedDesigns | None = None
    reason: str = ""

    @property
    def before(self) -> str:
        """The value in the study in words."""
        return value_in_words(self.taken_as)


def assumption_outcomes(
    project: Project, measured: Sequence[VariantMeasures], store: EvidenceStore
) -> tuple[AssumptionOutcome, ...]:
    """The choice under each alternative, one at a time, as far as the evidence shows; nothing is simulated.

    Args:
        project: The project with its study, without suppositions.
        measured: Every variant with its estimates and records.
        store: The evidence.

    Raises:
        EvidenceError: Trials of the study have no evidence.
        TradeoffError: The choice is ill posed, or no optimum was proved.
        DefinitionError: As for `trade_problem`.
    """
    decision = choose(project, measured, resamples=0)
    reader = ScenarioEvidenceReader(project, measured, store)
    return tuple(_outcome(project, measured, decision, reader, question) for question in questions_of(project))


def missing_trials(
    project: Project, measured: Sequence[VariantMeasures], store: EvidenceStore
) -> tuple[TrialSpec, ...]:
    """Missing trials that the questions need, each once.

    Args:
        project: The project with its study, without suppositions.
        measured: Every variant with its estimates and records.
        store: The evidence.

    Raises:
        EvidenceError: The store is damaged.
        DefinitionError: An alternative is invalid.
    """
    reader = ScenarioEvidenceReader(project, measured, store)
    scenarios = (suppose(project, [question.supposition]) for question in questions_of(project))
    return tuple(spec for scenario in scenarios for spec in reader.read(scenario).missing)


def _outcome(
    project: Project,
    measured: Sequence[VariantMeasures],
    decision: Decision,
    reader: ScenarioEvidenceReader,
    question: Question,
) -> AssumptionOutcome:
    is_fidelity = question.about == FIDELITY
    in_motion = motion_failures(measured, decision.chosen) if is_fidelity else None
    admitted = None
    try:
        scenario = suppose(project, [question.supposition])
        found = reader.read(scenario)
        if found.missing:
            return AssumptionOutcome(
                question=question,
                taken_as=_taken_as(scenario),
                trials=found.trials,
                missing=len(found.missing),
                read_off=found.read_off,
                in_motion=in_motion,
            )
        other = choose(scenario.project, found.measured, resamples=0)
        if other.unmeasured and not decision.unmeasured:
            return AssumptionOutcome(question=question, taken_as=_taken_as(scenario), reason=_lacking(other, question))
        former, chosen = decision.chosen, other.chosen
        is_among = former in other.ties if other.ties else former is None
        unseparated = (
            former is not None
            and chosen is not None
            and not is_among
            and not is_separated(scenario.project, found.measured, chosen, former)
        )
        if is_fidelity:
            admitted = admitted_designs(project, measured, scenario.project, found.measured, former)
    except RgssError as error:
        return AssumptionOutcome(question=question, reason=error.message)
    before, after = _successes(measured), _successes(found.measured)
    return AssumptionOutcome(
        question=question,
        taken_as=_taken_as(scenario),
        chosen=other.chosen,
        ties=other.ties,
        feasible=other.counts.feasible,
        is_same=is_among or unseparated,
        is_unseparated=unseparated,
        trials=found.trials,
        read_off=found.read_off,
        otherwise=(len(after - before), len(before - after)),
        otherwise_of_choice=sum(variant == decision.chosen for variant, _ in before ^ after),
        excluded_by=_missed_by(other.chosen, decision),
        missed_by_choice=_missed_by(former, other),
        in_motion=in_motion,
        admitted=admitted,
    )


def _missed_by(variant: int | None, decision: Decision) -> tuple[str, ...]:
    """The requirements by which a decision excludes a variant."""
    return next((one.requirements for one in decision.infeasible if one.variant == variant), ())


def _lacking(other: Decision, question: Question) -> str:
    """Reason for a missing answer: what the trials of the alternative do not observe."""
    names = " and ".join(one.removeprefix(EVIDENCE_PREFIX) for one in other.unmeasured)
    trials = f"{question.alternative} trials give" if question.about == FIDELITY else "the trials then give"
    return f"{trials} no value of {names}"


def _taken_as(scenario: Scenario) -> str:
    if scenario.settings:
        return scenario.settings[0].before
    if len(scenario.changes) == 1:
        (change,) = scenario.changes
        text = exact_figure(change.before)
        return text if change.unit == "1" else f"{text} {change.unit}"
    return AS_STATED


def _successes(measured: Sequence[VariantMeasures]) -> set[tuple[int, int]]:
    return {(record.variant, record.seed) for entry in measured for record in entry.records if record.success}
