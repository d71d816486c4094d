"""Sentences on equations and other terms that stand for what trials do not observe."""

from __future__ import annotations

from collections.abc import Iterator

from rgss.counted import counted
from rgss.decision.study_decision import DecidingSubstitution, EquationVerification, StudyDecision
from rgss.reports.decision.words import variants_text
from rgss.trace.views import share_in_words


def model_cautions(made: StudyDecision) -> Iterator[str]:
    """Cautions on verdicts, whether a variant is chosen or not: what an equation decides."""
    yield from (_equation_sentence(one) for one in made.equations)
    yield from (substitution_sentence(one, made.variants) for one in made.substitutions)


def substitution_sentence(one: DecidingSubstitution, variants: int) -> str:
    """Term that stands for one that trials do not observe, and what is decided by it.

    Args:
        one: The substitution.
        variants: Number of designs in the study.
    """
    missing = " or ".join(one.substitution.missing) or "value of a term"
    taken = " and ".join(one.substitution.taken) or "a number"
    which = f"all {variants} variants" if len(one.variants) == variants > 1 else variants_text(one.variants)
    have = "has" if one.trials == 1 else "have"
    by = f" {' and '.join(one.requirements)} {'is' if len(one.requirements) == 1 else 'are'} judged by that."
    return (
        f"{counted(one.trials, 'trial')} of {which} {have} no {missing}; there {one.measure} takes {taken} instead."
        f"{by if one.requirements else ''}"
    )


def _equation_sentence(one: EquationVerification) -> str:
    """Reason why an equation verifies a requirement, and whether its simulation decides otherwise."""
    why = ": it needs no trial, and so has a value at every fidelity" if one.is_of_design else ""
    text = f"{one.requirement} is verified by the equation of {one.measure}, not by its simulation{why}"
    if not one.compared:
        return f"{text}. These trials have no value of {one.simulated_as}."
    both = f"{one.simulated_as} differs by at most {share_in_words(one.greatest)} for {counted(one.compared, 'design')}"
    if not one.otherwise:
        return f"{text}. {both}, and all of them are on the same side of the threshold by both."
    are = "is" if len(one.otherwise) == 1 else "are"
    return f"{text}. {both}; {variants_text(one.otherwise)} {are} on the other side of the threshold by it."
