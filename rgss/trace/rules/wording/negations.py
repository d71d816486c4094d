"""Negations after 'shall' (R16).

The number is that of the INCOSE *Guide to Writing Requirements*, version 3.1.
"""

from __future__ import annotations

from collections.abc import Iterator

from rgss.findings import Severity
from rgss.trace.rules.rule import Flaw, SentenceRule, Worded
from rgss.trace.sentences import Sentence, TermList, listed, phrases, words_of

_NEGATIONS = phrases("""
    can't, cannot, doesn't, don't, isn't, neither, nor, not, won't
""")
# "not exceed" and "not more than" are bounds, which are verified as others are.
_BOUNDING = frozenset(words_of("exceed exceeding more less greater fewer later earlier longer lower higher smaller"))


def _negation(sentence: Sentence, terms: TermList, _: Worded) -> Iterator[Flaw]:
    if terms.is_absent(sentence):
        return
    tokens = sentence.tokens
    found = listed(
        match
        for match in terms.find(sentence, start=sentence.response_start)
        if not (match.after < len(tokens) and tokens[match.after].word in _BOUNDING)
        and not (match.first > 0 and tokens[match.first - 1].word == "but")
    )
    if found:
        yield Flaw(message=f"says {found} of what it shall do", hint="say what it shall do instead")


RULES: tuple[SentenceRule, ...] = (
    SentenceRule(
        id="wording.R16",
        severity=Severity.WARNING,
        explanation=(
            "A requirement says what is done, and not what is not done: that something never happens takes for "
            "ever to show. Bounds such as 'not exceed', and conditions, are allowed."
        ),
        find=_negation,
        terms=_NEGATIONS,
        meaning="negations",
        breaking=(
            "The gripper shall not drop the cup.",
            "The arm shall touch neither table nor chair.",
            "The gripper shall hold a cup that cannot stand.",
        ),
        passing=(
            "The force shall not exceed 40 N.",
            "The arm shall stop not later than 2 s after the alarm.",
        ),
    ),
)
