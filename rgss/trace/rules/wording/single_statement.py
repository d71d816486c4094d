"""More than one 'shall' or sentence in a requirement (R18).

The number is that of the INCOSE *Guide to Writing Requirements*, version 3.1.
"""

from __future__ import annotations

from collections.abc import Iterator

from rgss.findings import Severity
from rgss.trace.rules.rule import Flaw, SentenceRule, Worded
from rgss.trace.sentences import Sentence, TermList


def _several(sentence: Sentence, _: TermList, __: Worded) -> Iterator[Flaw]:
    if len(sentence.shalls) > 1:
        yield Flaw(message=f"says 'shall' {len(sentence.shalls)} times", hint="make a requirement of each")
    elif sentence.sentences > 1:
        yield Flaw(
            message=f"has {sentence.sentences} sentences",
            hint="keep the one with 'shall'; reasons belong under 'rationale'",
        )


RULES: tuple[SentenceRule, ...] = (
    SentenceRule(
        id="wording.R18",
        severity=Severity.ERROR,
        explanation=(
            "A requirement is one sentence with one 'shall'; what asks for two things can be half met, and is "
            "verified twice."
        ),
        find=_several,
        breaking=(
            "The gripper shall open, while the arm shall stop.",
            "The gripper shall open, while the arm shall stay.",
            "The gripper shall open. Fingers are slow.",
        ),
        passing=(
            "If the cup slips and the force is at the bound, then the arm shall stop.",
            "The message shall have the fields 1. Name 2. Size 3. Owner.",
        ),
    ),
)
