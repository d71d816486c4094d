"""The sentence of a requirement, taken apart: its words, and the parts that the EARS patterns name.

The patterns are those of the Easy Approach to Requirements Syntax (Mavin, Wilkinson, Harwood and
Novak, 2009): *The* system *shall* response, with ``While`` for a state, ``When`` for an event,
``Where`` for an option, and ``If … then`` for what is unwanted, alone or together.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from enum import Enum
from typing import NamedTuple

from rgss.trace.text_quantities import TextQuantity, quantities_in

_TOKEN = re.compile(r"[^\W_]+(?:['’\-][^\W_]+)*")
_SHALL = re.compile(r"\bshall\b", re.IGNORECASE)
_QUOTED = re.compile(r"\"[^\"]*\"|“[^”]*”|`[^`]*`")
# A full stop ends a sentence if a capital follows and it belongs to no abbreviation.
_SENTENCE_END = re.compile(
    r"[.!?](?<!\be\.g\.)(?<!\bi\.e\.)(?<!\betc\.)(?<!\bNo\.)(?<!\bFig\.)(?<![A-Z]\.)\s+(?=[A-Z\"“])"
)
_OTHER_MODALS = frozenset({"should", "must", "will", "may", "might", "can", "could", "would"})
# Words that open a clause which EARS would open with one of its own.
_FOREIGN_OPENINGS = re.compile(
    r"after|as|at|before|by|during|following|for|given|in|on|once|provided|throughout|unless|until|upon|whenever|"
    r"wherever|whilst|with|within|without"
)
_NO_VERBS = re.compile(r"a|an|the|of|to|in|on|at|by|with|for|from|and|or|each|its|their")


class EarsPattern(str, Enum):
    """The shape of a requirement's sentence."""

    UBIQUITOUS = "ubiquitous"
    STATE = "state"
    EVENT = "event"
    OPTION = "option"
    UNWANTED = "unwanted"
    COMPLEX = "complex"


class ClauseKind(str, Enum):
    """What a condition of a requirement is about, by the word that opens it."""

    STATE = "while"
    EVENT = "when"
    OPTION = "where"
    UNWANTED = "if"


_PATTERN_OF = {
    ClauseKind.STATE: EarsPattern.STATE,
    ClauseKind.EVENT: EarsPattern.EVENT,
    ClauseKind.OPTION: EarsPattern.OPTION,
    ClauseKind.UNWANTED: EarsPattern.UNWANTED,
}
_KEYWORDS = {kind.value: kind for kind in ClauseKind}


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
        text: The text on one line; what it quotes is blanked out, for a quotation is no wording.
        tokens: Its words.
        words: Its words as a set.
        quantities: Its numbers.
        shalls: Where each ``shall`` ends.
        sentences: How many sentences it has.
        conditions: What stands before the subject.
        subject: Who shall; empty if nobody is named.
        response: What follows the first ``shall``.
        pattern: The pattern of EARS that it has; None if it has none.
        flaw: Why it has none, in words that follow its id; empty if it has one.
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

    @property
    def response_start(self) -> int:
        """Where the response starts; the whole text counts as one where nothing is asked for."""
        return self.shalls[0] if self.shalls else 0


def read_sentence(text: str) -> Sentence:
    """Take a requirement's text apart."""
    flat = _without_quotations(" ".join(text.split()))
    tokens = _tokens(flat)
    words = frozenset([token.word for token in tokens])
    shalls = tuple([match.end() for match in _SHALL.finditer(flat)])
    before = flat[: shalls[0] - len("shall")] if shalls else ""
    response = flat[shalls[0] :].strip() if shalls else ""
    conditions, subject, flaw = _parts(before)
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
        sentences=1 + len(_SENTENCE_END.findall(flat)),
        conditions=conditions,
        subject=subject,
        response=response,
        pattern=None if flaw else _pattern(conditions),
        flaw=flaw,
    )


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


def _parts(before: str) -> tuple[tuple[Clause, ...], str, str]:
    """Conditions and subject of what stands before ``shall``, and what is wrong with them."""
    *lead, last = [part.strip() for part in before.split(",")]
    opening = _first_word(lead[0] if lead else last)
    if not lead:
        if opening in _KEYWORDS:
            return (), "", f"begins with {opening.capitalize()!r}, but has no comma between condition and subject"
        return (), last, "" if last and last.lower() != "there" else "names nobody that shall"
    if opening not in _KEYWORDS:
        if _FOREIGN_OPENINGS.fullmatch(opening):
            return (), last, f"begins with {opening.capitalize()!r}, which opens no condition of EARS"
        return (), before.strip(), ""
    clauses: list[list[str]] = []
    for part in lead:
        if _first_word(part) in _KEYWORDS or not clauses:
            clauses.append([part])
        else:
            clauses[-1].append(part)
    conditions = tuple(Clause(kind=_KEYWORDS[_first_word(each[0])], text=", ".join(each)) for each in clauses)
    subject, has_then = (last[4:].strip(), True) if _first_word(last) == "then" else (last, False)
    if _first_word(subject) in _KEYWORDS:
        return conditions, "", "has no comma between its last condition and its subject"
    if not subject:
        return conditions, "", "names nobody that shall"
    unwanted = any(condition.kind is ClauseKind.UNWANTED for condition in conditions)
    flaw = "says 'if' without 'then'" if unwanted and not has_then else ""
    return conditions, subject, flaw


def _pattern(conditions: tuple[Clause, ...]) -> EarsPattern:
    if not conditions:
        return EarsPattern.UBIQUITOUS
    return _PATTERN_OF[conditions[0].kind] if len(conditions) == 1 else EarsPattern.COMPLEX


def _without_shall(tokens: tuple[Token, ...]) -> str:
    said = next((token.word for token in tokens if token.word in _OTHER_MODALS), None)
    return "has no 'shall'" + (f", but {said!r}" if said else "")


def _flaw_of_response(response: str) -> str:
    first = _first_word(response)
    if not first:
        return "says nothing behind 'shall'"
    return f"has no verb behind 'shall', but {first!r}" if _NO_VERBS.fullmatch(first) else ""


def _first_word(text: str) -> str:
    match = _TOKEN.search(text)
    return match[0].lower() if match else ""
