"""Rules of what joins and negates: 'not', '/', and words that join two actions.

Numbers are those of the rules in the INCOSE *Guide to Writing Requirements*, version 3.1.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from rgss.findings import Severity
from rgss.trace.rules.rule import Flaw, SentenceRule, Worded
from rgss.trace.rules.wording.closed_word_lists import COMBINATORS, NEGATIONS
from rgss.trace.rules.wording.verbs import AMBIGUOUS_VERBS, VERBS
from rgss.trace.sentences import Match, Sentence, TermList, is_unit, words_of

# "not exceed" and "not more than" are bounds, which are verified as others are.
_BOUNDING = frozenset(words_of("exceed exceeding more less greater fewer later earlier longer lower higher smaller"))
_OBLIQUE = re.compile(r"[\w%°²³^*·.]+(?:\s?/\s?[\w%°²³^*·.]+)+")
_ABBREVIATIONS = re.compile(r"[A-Z0-9]+(?:\s?/\s?[A-Z0-9]+)+")
_DETERMINERS = frozenset(words_of("a an the each its their this that these those no at in on to from with by within"))


def _negation(sentence: Sentence, terms: TermList, _: Worded) -> Iterator[Flaw]:
    if terms.is_absent(sentence):
        return
    tokens = sentence.tokens
    found = [
        match.term
        for match in terms.find(sentence, start=sentence.response_start)
        if not (match.after < len(tokens) and tokens[match.after].word in _BOUNDING)
        and not (match.first > 0 and tokens[match.first - 1].word == "but")
    ]
    if found:
        words = ", ".join(f"'{term}'" for term in dict.fromkeys(found))
        yield Flaw(message=f"says {words} of what it shall do", hint="say what it shall do instead")


def _oblique(sentence: Sentence, _: TermList, __: Worded) -> Iterator[Flaw]:
    if "/" not in sentence.text:
        return
    found = [
        match[0].rstrip(".")
        for match in _OBLIQUE.finditer(sentence.text)
        if not _is_no_choice(match[0].rstrip("."), sentence.text[: match.start()])
    ]
    if found:
        texts = ", ".join(repr(text) for text in dict.fromkeys(found))
        yield Flaw(message=f"has {texts}: both, or either?", hint="say 'and', 'or', or make two requirements")


def _is_no_choice(text: str, before: str) -> bool:
    """Units, ratios of numbers, abbreviations such as I/O, and addresses are written with a '/'."""
    if is_unit(text.replace(" ", "")) or _ABBREVIATIONS.fullmatch(text):
        return True
    return before.endswith((":/", "/")) or all(part.strip()[:1].isdigit() for part in text.split("/"))


def _combinator(sentence: Sentence, terms: TermList, _: Worded) -> Iterator[Flaw]:
    if terms.is_absent(sentence):
        return
    found = [
        match.term
        for match in terms.find(sentence, start=sentence.response_start)
        if _joins_actions(sentence, match, always=match.term in terms.added)
    ]
    if found:
        words = ", ".join(f"'{term}'" for term in dict.fromkeys(found))
        yield Flaw(message=f"joins clauses by {words}", hint="make a requirement of each, or move a condition forward")


def _joins_actions(sentence: Sentence, match: Match, *, always: bool) -> bool:
    """'and' and 'or' join things more often than actions; only before a verb they join actions."""
    text, tokens = sentence.text, sentence.tokens
    if "/" in text[tokens[match.first].start - 1 : tokens[match.after - 1].end + 1]:
        return False
    if match.term not in ("and", "or") or always:
        return True
    index = match.after
    while index < len(tokens) and (tokens[index].word.endswith("ly") or tokens[index].word == "then"):
        index += 1
    if index >= len(tokens):
        return False
    word = tokens[index].word
    if word in VERBS:
        return True
    # "and record the end" joins actions, "and record length" does not.
    is_last = index + 1 == len(tokens)
    return word in AMBIGUOUS_VERBS and not is_last and tokens[index + 1].word in _DETERMINERS


RULES: tuple[SentenceRule, ...] = (
    SentenceRule(
        id="wording.R16",
        severity=Severity.WARNING,
        explanation=(
            "A requirement says what is done, and not what is not done: that something never happens takes for "
            "ever to show. Bounds such as 'not exceed', and conditions, are let pass."
        ),
        find=_negation,
        terms=NEGATIONS,
        meaning="negations",
    ),
    SentenceRule(
        id="wording.R17",
        severity=Severity.WARNING,
        explanation=(
            "A requirement has no '/' between words, which may mean 'and', 'or', or both. Units, numbers and "
            "abbreviations are let pass."
        ),
        find=_oblique,
    ),
    SentenceRule(
        id="wording.R19",
        severity=Severity.WARNING,
        explanation=(
            "The response joins no clauses: what joins them usually makes one requirement of two. 'and' and 'or' "
            "between things are let pass, and count only before a verb; added as terms they always count."
        ),
        find=_combinator,
        terms=COMBINATORS,
        meaning="combinators",
    ),
)
