"""Rules of single words and phrases that leave a requirement open to reading.

Numbers are those of the rules in the INCOSE *Guide to Writing Requirements*, version 3.1. The
lists are our own, kept short of words that more often than not are harmless; a project adds
those of its field.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from rgss.findings import Severity
from rgss.trace.rules.rule import Flaw, SentenceRule, Worded
from rgss.trace.rules.wording.closed_word_lists import (
    ABSOLUTES,
    DEMONSTRATIVES,
    INDEFINITE_TIMES,
    PRONOUNS,
    SEQUENCE_WORDS,
    UNIVERSALS,
    UNRESOLVED,
)
from rgss.trace.rules.wording.word_lists import (
    CLEAR_BEFORE,
    ESCAPES,
    OPEN_ENDS,
    SUPERFLUOUS,
    VAGUE,
    VAGUE_BEFORE_NUMBERS,
)
from rgss.trace.sentences import Match, Sentence, TermList

_NUMBER_NEXT = re.compile(r"\s*[~±]?\d")
# What a demonstrative stands before when it stands for a thing by itself.
_VERBS_NEXT = re.compile(
    r"\s+(?:is|are|was|were|has|have|had|shall|will|can|may|must|should|does|do|of)\b|\s*[.,;:]|\s*$"
)
_END_NEXT = re.compile(r"\s+of\b|\s*[.,;:]|\s*$")
_END_OR_PURPOSE = re.compile(r"\s+(?:for|to)\b|\s*[.,;:]|\s*$")
_HUNDRED = re.compile(r"(?<![\w.])100\s?(?:%|percent\b|per\s?cent\b)")
_BOUND_BEFORE = re.compile(r"(?:at most|up to|to|than|below|under|within|and|-|–|≤|<)\s*$", re.IGNORECASE)
_TIME_GIVEN = re.compile(r"\d\s?(?:ns|us|µs|ms|s|sec|seconds?|min|minutes?|h|hours?|d|days?)\b")


def _words(matches: Iterator[Match]) -> str:
    """The found terms as a message lists them, each once."""
    return ", ".join(f"'{term}'" for term in dict.fromkeys(match.term for match in matches))


def _vague(sentence: Sentence, terms: TermList, _: Worded) -> Iterator[Flaw]:
    if terms.is_absent(sentence):
        return
    found = _words(match for match in terms.find(sentence) if _is_vague(sentence, match))
    if found:
        yield Flaw(message=f"says {found}, which is vague", hint="say how much, how many, or which")


def _is_vague(sentence: Sentence, match: Match) -> bool:
    """Some words are vague only as an adverb of a number: 'about 3 s', but not 'about an axis'."""
    after = sentence.tokens[match.after].word if match.after < len(sentence.tokens) else ""
    if after in CLEAR_BEFORE.get(match.term, ()):
        return False
    if match.term not in VAGUE_BEFORE_NUMBERS:
        return True
    return _NUMBER_NEXT.match(sentence.text, sentence.tokens[match.after - 1].end) is not None


def _escape(sentence: Sentence, terms: TermList, _: Worded) -> Iterator[Flaw]:
    if terms.is_absent(sentence):
        return
    # "as required by the standard" names the one who requires.
    tokens = sentence.tokens
    found = _words(
        match
        for match in terms.find(sentence)
        if not (match.after < len(tokens) and tokens[match.after].word in ("by", "for", "in"))
        and match.term not in INDEFINITE_TIMES
    )
    if found:
        yield Flaw(
            message=f"says {found}, which lets it be escaped",
            hint="say under which condition it holds, or leave the clause out",
        )


def _open_ended(sentence: Sentence, terms: TermList, _: Worded) -> Iterator[Flaw]:
    if terms.is_absent(sentence):
        return
    found = _words(terms.find(sentence))
    if found:
        yield Flaw(message=f"says {found}, which has no end", hint="name each of them, or make requirements of them")


def _superfluous(sentence: Sentence, terms: TermList, _: Worded) -> Iterator[Flaw]:
    if terms.is_absent(sentence):
        return
    found = _words(terms.find(sentence, start=sentence.response_start))
    if found:
        yield Flaw(message=f"says {found}, which asks for an ability and not for its use", hint="say what it shall do")


def _pronoun(sentence: Sentence, terms: TermList, _: Worded) -> Iterator[Flaw]:
    if terms.is_absent(sentence):
        return
    found = _words(match for match in terms.find(sentence) if _is_pronoun(sentence, match))
    if found:
        yield Flaw(message=f"says {found}, which points outside of it", hint="repeat the noun")


def _is_pronoun(sentence: Sentence, match: Match) -> bool:
    if match.term not in DEMONSTRATIVES:
        return True
    # "the cup that is held" has 'that' for its noun's sake.
    nexts = _END_NEXT if match.term == "that" else _VERBS_NEXT
    return nexts.match(sentence.text, sentence.tokens[match.after - 1].end) is not None


def _absolute(sentence: Sentence, terms: TermList, _: Worded) -> Iterator[Flaw]:
    said = [match.term for match in terms.find(sentence) if not _is_period(sentence, match)]
    said += [match[0] for match in _HUNDRED.finditer(sentence.text) if not _is_bounded(sentence, match.start())]
    if said:
        found = ", ".join(f"'{term}'" for term in dict.fromkeys(said))
        yield Flaw(
            message=f"says {found}, which nothing attains", hint="give the share, rate or limit that is good enough"
        )


def _is_period(sentence: Sentence, match: Match) -> bool:
    """'every 10 ms' is a period, no absolute."""
    end = sentence.tokens[match.after - 1].end
    return match.term == "every" and _NUMBER_NEXT.match(sentence.text, end) is not None


def _is_bounded(sentence: Sentence, start: int) -> bool:
    return _BOUND_BEFORE.search(sentence.text[:start]) is not None


def _universal(sentence: Sentence, terms: TermList, _: Worded) -> Iterator[Flaw]:
    if terms.is_absent(sentence):
        return
    found = _words(terms.find(sentence))
    if found:
        yield Flaw(message=f"says {found}: of each, or of them together?", hint="say 'each', or name them")


def _indefinite_time(sentence: Sentence, terms: TermList, _: Worded) -> Iterator[Flaw]:
    if terms.is_absent(sentence):
        return
    is_timed = _TIME_GIVEN.search(sentence.response) is not None
    found = _words(
        match
        for match in terms.find(sentence, start=sentence.response_start)
        if not (is_timed and match.term in SEQUENCE_WORDS) and not _is_rate_or_name(sentence, match)
    )
    if found:
        yield Flaw(message=f"says {found}, which sets no time", hint="say within which time of which event")


def _is_rate_or_name(sentence: Sentence, match: Match) -> bool:
    """'once per day' is a rate, and 'a point in time' and 'in time services' are things."""
    tokens = sentence.tokens
    if match.term == "once":
        return match.after < len(tokens) and tokens[match.after].word in ("a", "again", "daily", "each", "every", "per")
    end = tokens[match.after - 1].end
    is_point = match.first > 0 and tokens[match.first - 1].word in ("point", "points")
    return match.term == "in time" and (is_point or _END_OR_PURPOSE.match(sentence.text, end) is None)


def _unresolved(sentence: Sentence, terms: TermList, _: Worded) -> Iterator[Flaw]:
    if terms.is_absent(sentence):
        return
    found = _words(terms.find(sentence))
    if found:
        yield Flaw(message=f"says {found}", hint="decide it, or keep the requirement out until it is decided")


RULES: tuple[SentenceRule, ...] = (
    SentenceRule(
        id="wording.R7",
        severity=Severity.ERROR,
        explanation="A requirement has no vague word, which each reader would measure by another scale.",
        find=_vague,
        terms=VAGUE,
        meaning="vague words",
    ),
    SentenceRule(
        id="wording.R8",
        severity=Severity.ERROR,
        explanation=(
            "A requirement has no clause to escape by, such as one that leaves it to somebody's judgement whether "
            "it holds."
        ),
        find=_escape,
        terms=ESCAPES,
        meaning="clauses to escape by",
    ),
    SentenceRule(
        id="wording.R9",
        severity=Severity.ERROR,
        explanation="A requirement has no open end; what is not named cannot be verified.",
        find=_open_ended,
        terms=OPEN_ENDS,
        meaning="open ends",
    ),
    SentenceRule(
        id="wording.R10",
        severity=Severity.ERROR,
        explanation=(
            "A requirement asks for what is done, and not that somebody is able or designed to do it: an ability "
            "that is never used would meet it."
        ),
        find=_superfluous,
        terms=SUPERFLUOUS,
        meaning="superfluous infinitives",
    ),
    SentenceRule(
        id="wording.R24",
        severity=Severity.ERROR,
        explanation=(
            "A requirement has no pronoun: it is read, allocated and verified alone, where nothing stands that a "
            "pronoun could point at."
        ),
        find=_pronoun,
        terms=PRONOUNS,
        meaning="pronouns",
    ),
    SentenceRule(
        id="wording.R26",
        severity=Severity.ERROR,
        explanation="A requirement asks for no absolute, which nothing attains and no number of trials can show.",
        find=_absolute,
        terms=ABSOLUTES,
        meaning="absolutes, beside 100 %",
    ),
    SentenceRule(
        id="wording.R32",
        severity=Severity.ERROR,
        explanation="A requirement says 'each' where 'all', 'any' or 'both' leave open whether singly or together.",
        find=_universal,
        terms=UNIVERSALS,
        meaning="quantifiers that leave this open",
    ),
    SentenceRule(
        id="wording.R35",
        severity=Severity.WARNING,
        explanation=(
            "A requirement sets its times by numbers. Words of sequence, such as 'after', are let pass where the "
            "response states a time."
        ),
        find=_indefinite_time,
        terms=INDEFINITE_TIMES,
        meaning="words of indefinite time",
    ),
    SentenceRule(
        id="wording.TBD",
        severity=Severity.ERROR,
        explanation="A requirement has nothing that is still to be determined, resolved or confirmed.",
        find=_unresolved,
        terms=UNRESOLVED,
        meaning="signs of what is unresolved",
    ),
)
