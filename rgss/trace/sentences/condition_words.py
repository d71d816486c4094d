"""Opening words of conditions: the keywords of EARS, and the words that mean the same."""

from __future__ import annotations

from collections.abc import Mapping
from enum import Enum
from types import MappingProxyType


class ClauseKind(str, Enum):
    """Subject of a condition, by the keyword of EARS for it."""

    STATE = "while"
    EVENT = "when"
    OPTION = "where"
    UNWANTED = "if"


KEYWORDS: Mapping[str, ClauseKind] = MappingProxyType({kind.value: kind for kind in ClauseKind})
"""The keywords of EARS."""

_SYNONYMS: Mapping[ClauseKind, tuple[str, ...]] = MappingProxyType(
    {
        ClauseKind.STATE: (
            "as long as",
            "during",
            "for as long as",
            "in",
            "so long as",
            "throughout",
            "until",
            "whilst",
            "with",
            "without",
        ),
        ClauseKind.EVENT: (
            "after",
            "as soon as",
            "at",
            "before",
            "by",
            "each time",
            "every time",
            "following",
            "from",
            "immediately after",
            "immediately before",
            "immediately upon",
            "on",
            "once",
            "prior to",
            "subsequent to",
            "upon",
            "whenever",
            "within",
        ),
        ClauseKind.OPTION: (
            "according to",
            "as",
            "assuming",
            "based on",
            "depending on",
            "except",
            "for",
            "given",
            "in accordance with",
            "in the case of",
            "provided",
            "provided that",
            "using",
            "wherever",
        ),
        ClauseKind.UNWANTED: (
            "in case",
            "in case of",
            "in the event",
            "in the event of",
            "in the event that",
            "should",
            "unless",
        ),
    }
)
OPENINGS: Mapping[tuple[str, ...], ClauseKind] = MappingProxyType(
    {(word,): kind for word, kind in KEYWORDS.items()}
    | {tuple(phrase.split()): kind for kind, phrases in _SYNONYMS.items() for phrase in phrases}
)
"""Every phrase that opens a condition, by its words."""

_NEGATED: Mapping[str, ClauseKind] = MappingProxyType(
    {
        "before": ClauseKind.STATE,
        "except": ClauseKind.OPTION,
        "immediately before": ClauseKind.STATE,
        "prior to": ClauseKind.STATE,
        "unless": ClauseKind.UNWANTED,
        "until": ClauseKind.STATE,
        "without": ClauseKind.STATE,
    }
)
"""Phrases that hold as long as what follows does not, with the keyword of EARS for its negation."""

CLAUSE_WORDS = frozenset(KEYWORDS) | {
    "after",
    "before",
    "during",
    "once",
    "unless",
    "until",
    "upon",
    "whenever",
    "wherever",
    "whilst",
}
"""Words that open a further condition behind a comma; the others may stand in the midst of one."""


def ears_words(opening: tuple[str, ...]) -> str:
    """Words of EARS with the meaning of an opening phrase, such as ``When``, or ``If … not`` for ``unless``."""
    negated = _NEGATED.get(" ".join(opening))
    return OPENINGS[opening].value.capitalize() if negated is None else f"{negated.value.capitalize()} … not"


def opening_of(words: tuple[str, ...]) -> tuple[str, ...]:
    """Longest opening phrase of a condition at the start of some words; empty if there is none."""
    longest = max(len(phrase) for phrase in OPENINGS)
    for length in range(min(longest, len(words)), 0, -1):
        if words[:length] in OPENINGS:
            return words[:length]
    return ()
