"""Rules of the sentence as a whole: its pattern, its voice, and that it asks for one thing.

Numbers are those of the rules in the INCOSE *Guide to Writing Requirements*, version 3.1.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from rgss.findings import Severity
from rgss.trace.rules.rule import Flaw, SentenceRule, Worded
from rgss.trace.sentences import Sentence, TermList, words_of

_PATTERNS = "write 'The SYSTEM shall …', or one of 'While …,', 'When …,', 'Where …,', 'If …, then' before it"
# "shall be" with a participle, and an adverb before or between them.
_BE = re.compile(r"(?:not\s+)?(?:\w+ly\s+)?be\s+(?:not\s+)?(?:\w+ly\s+)?(?P<word>[a-z]+)\b", re.IGNORECASE)
_PARTICIPLES = frozenset(
    words_of(
        "begun bent bound bought broken brought built caught chosen cut dealt done drawn driven fed felt found "
        "frozen given ground held hidden hit hung kept known laid led left lent lit lost made met paid put read "
        "rewritten run said seen sent set shown shut sold spent spun stuck stood struck swept taken taught thrown "
        "told understood withdrawn withheld won worn written"
    )
)
# "be red" and "be able to" are no passive; the second has a rule of its own.
_NO_PARTICIPLES = frozenset(words_of("designed intended required allowed permitted expected supposed red rated"))


def _pattern(sentence: Sentence, _: TermList, __: Worded) -> Iterator[Flaw]:
    if sentence.flaw:
        yield Flaw(message=sentence.flaw, hint=_PATTERNS)


def _departure(sentence: Sentence, _: TermList, __: Worded) -> Iterator[Flaw]:
    if sentence.departure and not sentence.flaw:
        yield Flaw(message=sentence.departure, hint=_PATTERNS)


def _passive(sentence: Sentence, terms: TermList, _: Worded) -> Iterator[Flaw]:
    match = _BE.match(sentence.response)
    if match is None:
        return
    word = match["word"].lower()
    is_participle = word in _PARTICIPLES or (len(word) > 4 and word.endswith("ed"))
    if is_participle and word not in _NO_PARTICIPLES and word not in terms.terms:
        yield Flaw(
            message=f"says 'shall be {word}', which leaves open who does it",
            hint="make the one who acts the subject, with a verb in the active voice",
        )


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
        id="wording.R1",
        severity=Severity.ERROR,
        explanation=(
            "A requirement has a pattern of EARS: it says who shall do what, after the conditions under which "
            "that holds, each with a comma behind it. A reader then finds the same part at the same place in "
            "every requirement. Words that mean the same as a keyword of EARS, such as 'Upon', count as it."
        ),
        find=_pattern,
    ),
    SentenceRule(
        id="wording.ears-keyword",
        severity=Severity.INFO,
        explanation=(
            "Conditions begin with the keywords of EARS: While a state, When an event, Where an option, If "
            "something unwanted, then. A project that wants no other words raises this rule's severity."
        ),
        find=_departure,
    ),
    SentenceRule(
        id="wording.R2",
        severity=Severity.ERROR,
        explanation=(
            "The verb behind 'shall' is in the active voice, so that the requirement names who is responsible."
        ),
        find=_passive,
        meaning="participles that are taken for adjectives",
    ),
    SentenceRule(
        id="wording.R18",
        severity=Severity.ERROR,
        explanation=(
            "A requirement is one sentence with one 'shall'; what asks for two things can be half met, and is "
            "verified twice."
        ),
        find=_several,
    ),
)
