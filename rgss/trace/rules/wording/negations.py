"""Negations after 'shall' (R16).

The number is that of the INCOSE *Guide to Writing Requirements*, version 3.1.
"""

from __future__ import annotations

from collections.abc import Iterator

from rgss.findings import Severity
from rgss.trace.rules.rule import Flaw, SentenceRule, Worded
from rgss.trace.sentences import Sentence, TermList, bound_of, is_in_trailing_condition, listed, phrases, words_of

_NEGATIONS = phrases("""
    can't, cannot, doesn't, don't, isn't, neither, nor, not, won't
""")
# "not exceed the limit" and "not more than that" are bounds, which are verified as others are.
_BOUNDING = frozenset(words_of("exceed exceeding more less greater fewer later earlier longer lower higher smaller"))


def _negation(sentence: Sentence, terms: TermList, _: Worded) -> Iterator[Flaw]:
    if terms.is_absent(sentence):
        return
    tokens, start = sentence.tokens, sentence.response_start
    bounds = [bound for quantity in sentence.quantities if (bound := bound_of(sentence.text, quantity)) is not None]
    found = listed(
        match
        for match in terms.find(sentence, start=start)
        if (
            match.term in terms.added
            or not any(bound.start <= tokens[match.first].start < bound.end for bound in bounds)
        )
        and not is_in_trailing_condition(sentence.text, tokens[match.first].start, start)
        and not (match.after < len(tokens) and tokens[match.after].word in _BOUNDING)
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
            "The robot shall not drop cups of more than 5 N.",
        ),
        passing=(
            "The force shall not exceed 40 N.",
            "The arm shall stop not later than 2 s after the alarm.",
            "The force shall not be greater than 40 N.",
            "The voltage shall not fall below 9 V.",
            "The controller shall reset if the watchdog does not answer.",
        ),
    ),
)
