"""Sentence about limits on which value functions are anchored."""

from __future__ import annotations

from collections.abc import Sequence

from rgss.decision.study_decision import LimitMoves


def anchored_limits_sentence(limits: Sequence[LimitMoves]) -> str:
    """What moves of such limits leave out, with the command that includes it; empty without such limits."""
    anchored = [one for one in limits if one.anchored]
    if not anchored:
        return ""
    named = "; ".join(f"{one.requirement}: {', '.join(one.anchored)}" for one in anchored)
    example = anchored[0].requirement
    return (
        "Each limit moves as a demand alone. Values that are anchored on one stay as they are here, though moving it "
        f"moves them too ({named}): rgss trade --what-if {example}.threshold=… answers for both."
    )
