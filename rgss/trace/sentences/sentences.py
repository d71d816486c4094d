"""Parser of a requirement's sentence into words and the parts of EARS patterns.

The patterns are those of the Easy Approach to Requirements Syntax (Mavin, Wilkinson, Harwood and Novak, 2009): *The*
system *shall* response, with ``While`` for a state, ``When`` for an event, ``Where`` for an option, and ``If … then``
for unwanted behaviour, alone or combined.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from enum import Enum
from typing import NamedTuple

from rgss.trace.sentences.condition_words import CLAUSE_WORDS, KEYWORDS, OPENINGS, ClauseKind, ears_words, opening_of
from rgss.trace.sentences.quantities import TextQuantity, quantities_in
from rgss.trace.sentences.trailing_conditions import trailing_condition

_THEN = re.compile(r"(?P<condition>if\b.*\S)\s+(?P<rest>then\b.*)", re.IGNORECASE)
_TOKEN = re.compile(r"[^\W_]+(?:['’\-][^\W_]+)*")
# "shall: a) stop; b) open", whose verbs are in the list.
_LIST_MARK = re.compile(r"[:\s]*(?:[-•*]|\(?(?:[a-z]|[ivx]+|\d+)[).])\s+", re.IGNORECASE)
# "shall at all times report", "shall, upon loss of power, engage", where the verb follows.
_ADVERBIAL = re.compile(
    r"\s*(?:,[^,]+,|(?:at\s+(?:all\s+times|any\s+time|no\s+(?:time|point(?:\s+in\s+time)?)|a\s+minimum|least)|by\s+default|"
    r"in\s+(?:addition|(?:all|any|each|every|no)\s+(?:cases?|events?|modes?|states?)))\b,?)\s+(?=\w)",
    re.IGNORECASE,
)
_SHALL = re.compile(r"\bshall\b", re.IGNORECASE)
_QUOTED = re.compile(r"\"[^\"]*\"|“[^”]*”|`[^`]*`")
# A full stop ends a sentence if a capital follows and it belongs to no abbreviation.
_SENTENCE_END = re.compile(
    r"[.!?](?<!\be\.g\.)(?<!\bi\.e\.)(?<!\betc\.)(?<!\bNo\.)(?<!\bFig\.)(?<![A-Z]\.)\s+(?=[A-Z\"“])"
)
# "1. Name 2. Size": a number that labels an item of a list, as texts of other tools have them.
_LABEL = re.compile(r"(?<!\S)(\d{1,2})\.\s+(?=[A-Z\"“])")
_OTHER_MODALS = frozenset({"should", "must", "will", "may", "might", "can", "could", "would"})
_NO_SUBJECTS = frozenset({"a", "an", "and", "any", "each", "every", "or", "the", "then", "there"})
_NO_VERBS = re.compile(r"a|an|the|of|to|in|on|at|by|with|for|from|and|or|each|its|their")


class EarsPattern(str, Enum):
    """The shape of a requirement's sentence."""

    UBIQUITOUS = "ubiquitous"
    STATE = "state"
    EVENT = "event"
    OPTION = "option"
    UNWANTED = "unwanted"
    COMPLEX = "complex"


_PATTERN_OF = {
    ClauseKind.STATE: EarsPattern.STATE,
    ClauseKind.EVENT: EarsPattern.EVENT,
    ClauseKind.OPTION: EarsPattern.OPTION,
    ClauseKind.UNWANTED: EarsPattern.UNWANTED,
}
# Hyphens that are not the one of the keyboard, and join words as it does.
_HYPHENS = str.maketrans({"\u2010": "-", "\u2011": "-"})


class Token(NamedTuple):
    """One word.

    Attributes:
        word: The word in lower case; as it is written if all of it is in capitals (``UR10``, ``TBD``).
        start: Where it starts in the sentence.
        end: Where it ends.
    """

    word: str
    start: int
    end: int


@dataclass(frozen=True, slots=True, kw_only=True)
class Clause:
    """One condition, such as ``While a move is executed``."""

    kind: ClauseKind
    text: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Sentence:
    """A requirement's text with its parts.

    Attributes:
        text: The text on one line, with quotations blanked out.
        tokens: Its words.
        words: Its words as a set.
        quantities: Its numbers.
        shalls: End position of each ``shall``.
        sentences: Number of sentences.
        conditions: The conditions before the subject.
        subject: The subject before ``shall``; empty if there is none.
        response: The text after the first ``shall``.
        pattern: Its EARS pattern; None if it has none.
        flaw: Reason for no pattern, as a text after its id; empty if it has one.
        departure: Deviation of its conditions from the EARS keywords, as a text after its id.
    """

    text: str
    tokens: tuple[Token, ...]
    words: frozenset[str]
    quantities: tuple[TextQuantity, ...]
    shalls: tuple[int, ...]
    sentences: int
    conditions: tuple[Clause, ...]
    subject: str
    response: str
    pattern: EarsPattern | None
    flaw: str
    departure: str

    @property
    def response_start(self) -> int:
        """Start of the response; the whole text counts as one where there is no ``shall``."""
        return self.shalls[0] if self.shalls else 0


def read_sentence(text: str) -> Sentence:
    """Take a requirement's text apart."""
    flat = _without_quotations(" ".join(text.split()).translate(_HYPHENS))
    tokens = _tokens(flat)
    # Also without their capitals, as terms are found that are no abbreviations.
    words = frozenset([token.word for token in tokens]) | frozenset([token.word.lower() for token in tokens])
    if "-" in flat:
        # A phrase with hyphens for its spaces is found by its first word.
        words |= {word.partition("-")[0] for word in words}
    shalls = tuple([match.end() for match in _SHALL.finditer(flat)])
    before = flat[: shalls[0] - len("shall")] if shalls else ""
    response = flat[shalls[0] :].strip() if shalls else ""
    conditions, subject, flaw, departure = _parts(before)
    if not shalls:
        flaw = _without_shall(tokens)
    elif not flaw:
        flaw = _flaw_of_response(response)
    return Sentence(
        text=flat,
        tokens=tokens,
        words=words,
        quantities=tuple(quantities_in(flat)),
        shalls=shalls,
        sentences=1 + len(_SENTENCE_END.findall(flat)) - _labels(flat),
        conditions=conditions,
        subject=subject,
        response=response,
        pattern=None if flaw else _pattern(conditions),
        flaw=flaw,
        departure=departure or _late_condition(tokens, shalls),
    )


def _labels(text: str) -> int:
    """Number of items of a list that is numbered from 1; 0 where the numbers before full stops are no labels."""
    found = [int(number) for number in _LABEL.findall(text)]
    return len(found) if len(found) > 1 and found == list(range(1, len(found) + 1)) else 0


def words_of(text: str) -> tuple[str, ...]:
    """The words of a text, as the tokens of a sentence have them."""
    return tuple([token.word for token in _tokens(text)])


def _tokens(flat: str) -> tuple[Token, ...]:
    # Capitals are kept, so that an abbreviation such as IT is never taken for a word. Most of the time of
    # a check is spent here, hence no generator and no call of Token.
    make = Token._make
    return tuple(
        [
            make((word if (word := match[0]).isupper() and len(word) > 1 else word.lower(), *match.span()))
            for match in _TOKEN.finditer(flat)
        ]
    )


def _without_quotations(flat: str) -> str:
    if not any(mark in flat for mark in '"“`'):
        return flat
    return _QUOTED.sub(lambda match: "“" + "·" * (len(match[0]) - 2) + "”", flat)


def response_start(text: str) -> int:
    """Start of the response of a requirement in its text; 0 if it has no ``shall``."""
    match = _SHALL.search(text)
    return match.end() if match else 0


def _parts(before: str) -> tuple[tuple[Clause, ...], str, str, str]:
    """Conditions and subject before ``shall``, their flaw, and their departure from EARS."""
    *lead, last = [part.strip() for part in before.split(",")]
    divided = _THEN.fullmatch(last) if not lead else None
    if divided is not None:
        # As unambiguous as a comma.
        lead, last = [divided["condition"]], divided["rest"]
    if not lead:
        opening = _first_word(last)
        if opening in KEYWORDS:
            return (), "", f"begins with {opening.capitalize()!r}, but has no comma between condition and subject", ""
        return (), last, "" if _is_subject(last) else "has no subject before 'shall'", ""
    if not _opening(lead[0]):
        return (), before.strip(), "", ""
    clauses: list[list[str]] = []
    for part in lead:
        if _first_word(part) in CLAUSE_WORDS or not clauses:
            clauses.append([part])
        else:
            clauses[-1].append(part)
    conditions = tuple(Clause(kind=OPENINGS[_opening(each[0])], text=", ".join(each)) for each in clauses)
    subject, has_then = (last[4:].strip(), True) if _first_word(last) == "then" else (last, False)
    if _first_word(subject) in CLAUSE_WORDS:
        return conditions, "", "has no comma between its last condition and its subject", ""
    if not _is_subject(subject):
        return conditions, "", "has no subject before 'shall'", ""
    return conditions, subject, "", _departure([_opening(each[0]) for each in clauses], has_then=has_then)


def _opening(part: str) -> tuple[str, ...]:
    """The phrase with which a condition opens, in lower case."""
    return opening_of(tuple(match[0].lower() for match in _TOKEN.finditer(part)))


def _departure(openings: list[tuple[str, ...]], *, has_then: bool) -> str:
    foreign = next((opening for opening in openings if opening[0] not in KEYWORDS), None)
    if foreign is not None:
        return f"begins a condition with {' '.join(foreign).capitalize()!r}, for which EARS has {ears_words(foreign)!r}"
    return "says 'if' without 'then'" if ("if",) in openings and not has_then else ""


def _pattern(conditions: tuple[Clause, ...]) -> EarsPattern:
    if not conditions:
        return EarsPattern.UBIQUITOUS
    return _PATTERN_OF[conditions[0].kind] if len(conditions) == 1 else EarsPattern.COMPLEX


def _without_shall(tokens: tuple[Token, ...]) -> str:
    said = next((token.word for token in tokens if token.word in _OTHER_MODALS), None)
    return "has no 'shall'" + (f", but {said!r}" if said else "")


def _flaw_of_response(response: str) -> str:
    adverbial = _ADVERBIAL.match(response)
    response = response[adverbial.end() :] if adverbial is not None else response
    first = _first_word(_LIST_MARK.sub("", response, count=1) if _LIST_MARK.match(response) else response)
    if not first:
        return "says nothing after 'shall'"
    return f"has no verb after 'shall', but {first!r}" if _NO_VERBS.fullmatch(first) else ""


def _late_condition(tokens: tuple[Token, ...], shalls: tuple[int, ...]) -> str:
    # A second 'shall' makes two statements of the sentence, of which another rule says so.
    words = [token.word for token in tokens if token.start >= shalls[0]] if len(shalls) == 1 else []
    opening = trailing_condition(words)
    return f"has a condition behind its response, with {opening!r}; EARS has it before the subject" if opening else ""


def _is_subject(text: str) -> bool:
    """True if a text names something; an article alone does not."""
    return any(match[0].lower() not in _NO_SUBJECTS for match in _TOKEN.finditer(text))


def _first_word(text: str) -> str:
    match = _TOKEN.search(text)
    return match[0].lower() if match else ""
