"""Sentences about moved limits: anchored value functions, and the tolerance of the choice."""

from __future__ import annotations

from collections.abc import Sequence

from rgss.decision.study_decision import LimitMoves


def limit_sentences(limits: Sequence[LimitMoves], *, tolerance: float) -> tuple[str, ...]:
    """Omissions of a table of moved limits, with what a supposition of the same limit takes; empty if nothing.

    Args:
        limits: The moves of each limit.
        tolerance: Share of a threshold on what varies from trial to trial by which the choice may miss it.
    """
    sentences = [anchored_limits_sentence(limits)]
    tolerated = [one for one in limits if one.is_tolerated]
    if tolerated:
        named = ", ".join(one.requirement for one in tolerated)
        of_least = {one.at_least for one in tolerated}
        factors = [f"{1.0 + tolerance:g} times an upper one"] * (False in of_least)
        factors += [f"{1.0 - tolerance:g} times a lower one"] * (True in of_least)
        sentences.append(
            f"The limits of {named} are with the tolerance, {' and '.join(factors)} of the requirement, which is what "
            "--what-if takes."
        )
    return tuple(one for one in sentences if one)


def anchored_limits_sentence(limits: Sequence[LimitMoves]) -> str:
    """Omissions of moves of such limits, with the command that includes it; empty without such limits."""
    anchored = [one for one in limits if one.anchored]
    if not anchored:
        return ""
    named = "; ".join(f"{one.requirement}: {', '.join(one.anchored)}" for one in anchored)
    example = anchored[0].requirement
    return (
        "Each limit moves as a demand alone. Values that are anchored on one stay as they are here, though moving it "
        f"moves them too ({named}): rgss trade --what-if {example}.threshold=… answers for both."
    )
