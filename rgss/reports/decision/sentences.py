"""Sentences on a decision that its renderers share: reasons, cautions, certificate, portfolio, noise."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from rgss.decision.study_decision import ClosestLimit, StudyDecision
from rgss.measures import ModelGap
from rgss.reports.decision.flat_sentences import flat_sentences
from rgss.reports.decision.model_sentences import model_cautions
from rgss.reports.decision.words import amount, basis_text, ids_text, share_text, variants_text
from rgss.trace.views import share_in_words, value_in_words
from rgss.tradeoff import (
    Agreement,
    Check,
    CheckKind,
    Conflicts,
    ConflictSurvival,
    Decision,
)
from rgss.tradeoff.programs import Certificate

_WITHOUT_WEIGHTS = frozenset({"lexicographic", "epsilon_constraint"})

_NO_GAINS = "less than rounding shows"


@dataclass(frozen=True, slots=True, kw_only=True)
class Reason:
    """A reason for a choice.

    Attributes:
        text: The reason, in a sentence.
        details: Its parts; may be empty.
    """

    text: str
    details: tuple[str, ...] = ()


def reasons(made: StudyDecision) -> Iterator[Reason]:
    """Reasons for the choice of a variant.

    Args:
        made: The decision, by which a variant is chosen.
    """
    decision = made.decision
    is_additive = decision.program == "additive"
    best = "has the highest value" if is_additive else f"is the choice of the {decision.program} program"
    feasible = decision.counts.feasible
    if made.is_alone:
        among = "is the only one compared, and meets"
    else:
        among = f"{best} of the {feasible} variants that meet" if feasible > 1 else "is the one variant that meets"
    limits = " and every limit of the program" if decision.program == "epsilon_constraint" else ""
    within = ""
    if made.tolerance:
        within = f", within the tolerance of {share_text(made.tolerance)} on what varies from trial to trial"
    basis = basis_text(shown_feasible=made.shown_feasible)
    yield Reason(text=f"Variant {decision.chosen} {among} every requirement{limits} by the {basis}{within}.")
    yield from _equals(made)
    if made.gains and decision.runner_up in decision.ties:
        # Its contributions may differ and cancel.
        apart = f", with other contributions: {_gains(made)}" if _gains(made) != _NO_GAINS else ""
        yield Reason(text=f"The runner-up {decision.runner_up} has the same value{apart}.")
    elif made.gains:
        yield Reason(text=f"It leads the runner-up {decision.runner_up} by: {_gains(made)}.")
    if decision.excluded_better:
        count = decision.counts.excluded_better
        ids = ids_text(one.variant for one in decision.excluded_better)
        would = "would be worth more" if is_additive else "would be preferred by the program"
        variants, violate = ("variant", "violates") if count == 1 else ("variants", "violate")
        yield Reason(
            text=f"{count} {variants} {would} but {violate} a requirement: {ids}",
            details=tuple(
                f"{each.requirement} ({decision.demands[each.requirement]}) excludes {each.excluded} of them"
                for each in decision.deciding_requirements
            ),
        )
    elif not made.is_alone:
        preferred = "of higher value" if is_additive else "that the program would prefer"
        yield Reason(text=f"No requirement excludes a variant {preferred}.")
    close = [
        f"{limit.requirement} ({limit.demand}) at {amount(limit.statistic, limit.unit)}, "
        f"{share_in_words(abs(limit.margin))} {_side(limit)}"
        for limit in made.closest_limits
    ]
    if close:
        yield Reason(text=f"Closest limits: {'; '.join(close)}.")


def _equals(made: StudyDecision) -> Iterator[Reason]:
    """Reasons for the choice among variants of its value, and those within the margin."""
    decision = made.decision
    others = [variant for variant in decision.ties if variant != decision.chosen]
    if decision.surpassed:
        names = variants_text(decision.surpassed).capitalize()
        have = "has" if len(decision.surpassed) == 1 else "have"
        yield Reason(
            text=f"{names} {have} the same value, but another of this value is better in a quantity beyond the end of "
            "its value function, and no worse in any."
        )
        others = [variant for variant in others if variant not in decision.surpassed]
    if others:
        names = ", ".join(map(str, others))
        end = "largest" if made.last_of_equals else "smallest"
        have = f"Variant {names} has" if len(others) == 1 else f"Variants {names} have"
        yield Reason(text=f"{have} the same value; the {end} id is chosen.")
    if decision.near_ties:
        near = variants_text(decision.near_ties)
        margin = made.practical_margin
        how = f"Within the practical margin of {margin:g} of it" if margin else "As good within the program's tolerance"
        yield Reason(text=f"{how}: {near}.")


def _side(limit: ClosestLimit) -> str:
    """Side of a limit on which the choice is."""
    if limit.margin < 0.0:
        return "outside of what is required, within the tolerance"
    return "inside what is required" if limit.is_tolerant else "inside"


def cautions(made: StudyDecision) -> Iterator[str]:
    """Cautions on a choice: double counting, weights without effect, equations that the simulation contradicts."""
    for overlap in made.double_counted:
        instead = f" {overlap.instead} could be valued instead of {overlap.whole}." if overlap.instead else ""
        yield f"{overlap.whole} contains {overlap.part}, so {overlap.part} counts twice.{instead}"
    for shared in made.shared_parts:
        yield f"{shared.first} and {shared.second} both depend on {', '.join(shared.parts)}."
    yield from unvalued_sentences(made.decision.conflicts)
    if made.sensitivity is not None:
        yield from flat_sentences(made.sensitivity.flat, decides=made.decision.program not in _WITHOUT_WEIGHTS)
    else:
        for flat in made.decision.flat_measures:
            among = "feasible variants" if flat.among_feasible else "variants"
            yield f"{flat.measure} is worth the same for all {among}, so its weight of {flat.weight:.3g} has no effect."
    for gap in made.gaps:
        yield f"{gap_sentence(gap)}."
    yield from model_cautions(made)


def unvalued_sentences(conflicts: Conflicts | None) -> Iterator[str]:
    """Sentence on the weighted measures without a value in any variant.

    Args:
        conflicts: Explanation of infeasibility; None if a variant is feasible.
    """
    for measure in () if conflicts is None else conflicts.unvalued:
        yield f"No variant has a value of {measure}, so that none has a weighted value: no trial that ran gives one."


def gap_sentence(gap: ModelGap) -> str:
    """Both values of a measure that an equation gives and the simulation shows, without a full stop."""
    values = f"{amount(gap.by_equation, gap.unit)} by the equation, {amount(gap.simulated, gap.unit)} simulated"
    return f"{gap.measure} is {values} ({gap.simulated_as}, {100.0 * gap.relative:+.0f} %)"


def reading_lines(made: StudyDecision) -> Iterator[str]:
    """The choice under each reading of the source, one line each."""
    for outcome in made.readings:
        reading = outcome.reading
        if outcome.reason:
            leads = f"no answer: {outcome.reason}"
        elif outcome.chosen is None:
            leads = "no variant is feasible"
        else:
            same = "the same choice" if outcome.chosen == made.decision.chosen else f"variant {outcome.chosen}"
            leads = f"{same}, {outcome.feasible} feasible"
        yield f"{reading.supposition}: {leads}"


def certificate_sentence(certificate: Certificate) -> str:
    """Status, solver, gap, and agreement with enumeration.

    Args:
        certificate: The certificate of a decision.
    """
    gap = "" if certificate.gap is None else f", gap {value_in_words(certificate.gap)}"
    return f"Certificate: {certificate.status.value} by {certificate.solver}{gap}; {enumeration_clause(certificate)}."


def enumeration_clause(certificate: Certificate) -> str:
    """Clause on the agreement of a certificate with enumeration.

    Args:
        certificate: The certificate of a decision.
    """
    count = certificate.alternatives
    enumerated = {1: "the one variant", 2: "both variants"}.get(count, f"all {count} variants")
    enumeration = f"enumeration of {enumerated}"
    return {
        Agreement.AGREED: f"{enumeration} agrees",
        Agreement.DISAGREED: f"{enumeration} DISAGREES",
        Agreement.NOT_COMPARED: f"{enumeration} decides, the solver gave no answer in its time",
        Agreement.NOT_ENUMERATED: "not enumerated",
    }[certificate.enumeration_agrees]


def notable_checks(checks: tuple[Check, ...]) -> list[str]:
    """The checks that disagree, and those by another solver, in a sentence each."""
    return [
        f"Check: {check.text}." for check in checks if not check.agrees or check.kind is CheckKind.INDEPENDENT_SOLVER
    ]


def unmeasured_sentence(names: Sequence[str]) -> str:
    """Sentence on requirements without a value in any variant; empty if there are none."""
    if not names:
        return ""
    verdict = "Its verdicts are" if len(names) == 1 else "Their verdicts are"
    return (
        f"No trial that ran gives a value that {' or '.join(names)} limits. {verdict} inconclusive, and the choice "
        "leaves out variants without an estimate."
    )


def nearest_sentence(decision: Decision, conflicts: Conflicts) -> str:
    """Sentence on the variant that violates least; of a single variant that it does.

    Args:
        decision: A decision without a choice.
        conflicts: Its conflicts.
    """
    variant, what = conflicts.nearest.variant, violated_text(conflicts)
    return (
        f"Variant {variant} {what}."
        if decision.counts.alternatives == 1
        else f"Nearest: variant {variant}, which {what}."
    )


def violated_text(conflicts: Conflicts) -> str:
    """Requirements that the nearest variant violates, and those for which it has no value."""
    nearest = conflicts.nearest.requirements
    without = [one for one in nearest if one in conflicts.unmeasured]
    violated = [one for one in nearest if one not in conflicts.unmeasured]
    parts = [f"violates {_listed(violated)}"] if violated else []
    return " and ".join([*parts, *([f"has no value for {_listed(without)}"] if without else [])])


def noise_sentence(survival: ConflictSurvival | None) -> str:
    """Method by which the survival of conflicts under noise was computed.

    Args:
        survival: The survival; None if no measure has two replicates.
    """
    if survival is None:
        return (
            "Whether a conflict survives noise: no measure of the requirements has two replicates; measures that "
            "follow from the design alone have no noise."
        )
    draws = f"all {survival.resamples}" if survival.exact else f"{survival.resamples:,}"
    return (
        f"Survives noise: the share of {draws} resamples of the replicates in which the conflict remains; "
        f"nothing is feasible in {share_in_words(survival.nothing_feasible)} of them."
    )


def _listed(names: Sequence[str]) -> str:
    return names[0] if len(names) == 1 else f"{', '.join(names[:-1])} and {names[-1]}"


def _gains(made: StudyDecision) -> str:
    shown = sorted(made.gains, key=lambda gain: -abs(gain.amount))
    parts = [f"{gain.measure} {gain.amount:+.4f}" for gain in shown if abs(gain.amount) > 5e-5]
    return ", ".join(parts) or _NO_GAINS
