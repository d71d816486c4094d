"""Sentences on the variants that are tied with a choice."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from rgss.decision.study_decision import RobustnessFindings
from rgss.reports.decision.words import share_text, variants_text
from rgss.trace.views import share_in_words
from rgss.tradeoff.robustness import TIE_PROBABILITY, ChoiceUncertainty, Rival

MOST_TIES = 4
"""Most groups of tied variants that are named."""


def tie_sentences(found: RobustnessFindings, one: ChoiceUncertainty) -> Iterator[str]:
    """Sentences on the variants that are tied with the choice, and on what breaks each tie.

    Args:
        found: The robustness of the choice.
        one: Its uncertainty.
    """
    groups: dict[tuple[object, ...], list[Rival]] = {}
    for rival in one.rivals:
        key = (round(rival.probability, 3), replace(rival, row=0, probability=0.0))
        groups.setdefault(key, []).append(rival)
    if not groups:
        yield "No other variant is tied with it."
        return
    for members in list(groups.values())[:MOST_TIES]:
        yield _tie(found, members)
    rest = [rival.row for members in list(groups.values())[MOST_TIES:] for rival in members]
    if rest:
        yield f"Tied with less probability: {variants_text(found.variants(tuple(rest)))}."


def _tie(found: RobustnessFindings, members: list[Rival]) -> str:
    rival = members[0]
    names = variants_text(found.variants(tuple(one.row for one in members)))
    why = "within the practical margin, " if rival.within_margin else ""
    tied = f"Tied: {names} ({why}as good with a probability of {share_in_words(rival.probability)})"
    if not any(found.analysis.feasible[one.row] for one in members):
        return f"{tied}; not feasible by the estimates, which more replicates could change."
    if rival.by_feasibility:
        pronoun = "it" if len(members) == 1 else "they"
        return (
            f"{tied}; by value alone {pronoun} would not be tied, being as good with the choice feasible in less than "
            f"{share_text(TIE_PROBABILITY)}: replicates that settle the open verdicts break the tie."
        )
    if rival.measure is None:
        if rival.clipped:
            return (
                f"{tied}; their estimates differ in {', '.join(rival.clipped)}, but beyond an end of the value "
                "function, where no difference is worth anything; another worst or best breaks the tie."
            )
        return f"{tied}; no estimate differs, so that only a measure in which they differ breaks the tie."
    if rival.separated and rival.fixed:
        return (
            f"{tied}; they are separated, most by {rival.measure}, which no replicate changes: a smaller margin breaks "
            "the tie."
        )
    if rival.separated:
        return (
            f"{tied}; the replicates separate them, most by {rival.measure}: no more of them, but a smaller margin, "
            "breaks the tie."
        )
    if rival.replicates is None:
        return f"{tied}; they differ most in {rival.measure}, and no affordable number of replicates separates them."
    if rival.fixed:
        return (
            f"{tied}; they differ most in {rival.measure}, which no replicate changes; about {rival.replicates} "
            "replicates would show whether what varies from trial to trial outweighs it."
        )
    return f"{tied}; they differ most in {rival.measure}; about {rival.replicates} replicates would separate them."
