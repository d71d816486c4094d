"""Bounds in the sentences of requirements: which numbers are limits, and to which side."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass

from rgss.trace.sentences.comparison_phrases import (
    BETWEEN,
    CLAUSE_OPENINGS,
    GERUNDS,
    HOLDING,
    LOWER_BEFORE,
    LOWER_BEHIND,
    NEGATORS,
    SIGNS,
    UPPER_BEFORE,
    UPPER_BEHIND,
)
from rgss.trace.sentences.quantities import TextQuantity


@dataclass(frozen=True, slots=True, kw_only=True)
class BoundedQuantity:
    """Bound on a quantity in a sentence.

    Attributes:
        text: The quantity with the words of its bound, as written.
        is_lower: True for a lower bound.
    """

    text: str
    is_lower: bool


def _alternatives(phrases: Iterable[str]) -> str:
    """A pattern of phrases, the longest first, with any blanks or hyphens between their words."""
    ordered = sorted(phrases, key=lambda phrase: (-len(phrase), phrase))
    return "|".join(r"[\s-]+".join(map(re.escape, phrase.split())) for phrase in ordered)


_NEGATOR = rf"(?:{_alternatives(NEGATORS)}|\w+n['’]t)"
_SIGNS = "|".join(re.escape(sign) for sign in sorted(SIGNS, key=len, reverse=True))
_BEFORE = re.compile(
    rf"""(?:\b(?P<negated>
               (?:{_NEGATOR}|from(?=\s+(?:{_alternatives(GERUNDS)})))[\s,]+(?:(?:{_alternatives(BETWEEN)})[\s,]+){{0,6}}
              |{_NEGATOR}\s+(?:{_alternatives(HOLDING)})\s+(?:[\w-]+\s+){{1,4}})?
             \b(?:(?P<lower>{_alternatives(LOWER_BEFORE)})|(?P<upper>{_alternatives(UPPER_BEFORE)}))\b
             \.?(?:\s+(?:a|an|any|its|the)\b)?(?:(?:\s+[a-z-]+){{0,3}}\s+of)?\s+
           |(?P<sign>{_SIGNS})\s*)$""",
    re.IGNORECASE | re.VERBOSE,
)
_BEHIND = re.compile(
    rf"""\s*(?:,\s*)?(?:(?P<lower>{_alternatives(LOWER_BEHIND)})|(?P<upper>{_alternatives(UPPER_BEHIND)}))\b
         (?!\s+(?:of\s+)?[~±]?\d)
        |\s*(?P<sign>{_SIGNS})""",
    re.IGNORECASE | re.VERBOSE,
)
_NEGATED_SUBJECT = re.compile(r"(?:^|[.,;]\s*)(?:no|none|neither|nothing)\b[^.,;]*\bshall\s*(?:be\s+)?$", re.IGNORECASE)
_SAME_CLAUSE = re.compile(
    rf"\b{_NEGATOR}\b(?:(?![.,;:]|\b(?:{_alternatives(CLAUSE_OPENINGS)}|shall)\b).)*$", re.IGNORECASE | re.DOTALL
)
_CONDITION = re.compile(
    r"\b(?:as\s+long\s+as|as\s+soon\s+as|if|in\s+case|once|unless|until|when|whenever|while|whilst)\b[^,;]*$",
    re.IGNORECASE,
)
_FROM = re.compile(r"\bbetween\s+$", re.IGNORECASE)
_TO = re.compile(r"(?P<not>\bnot\s+(?:be\s+|lie\s+)?)?\bbetween\s+[^,;]*\d[^,;]*\s+and\s+$", re.IGNORECASE)


def is_in_trailing_condition(sentence: str, quantity: TextQuantity, response_start: int) -> bool:
    """True for a quantity of a condition behind the response: ``shall stop when the force exceeds 10 N``.

    Args:
        sentence: The sentence.
        quantity: One of its quantities.
        response_start: Where the response starts.
    """
    return _CONDITION.search(sentence[response_start : quantity.start]) is not None


def bound_of(sentence: str, quantity: TextQuantity) -> BoundedQuantity | None:
    """The bound that a sentence makes of one of its quantities, by the words or signs around it.

    Args:
        sentence: The sentence.
        quantity: One of its quantities.
    """
    start = sentence[: quantity.start]
    before = _BEFORE.search(start)
    if before is not None:
        is_lower = _side(before, sentence)
        if is_lower is None:
            return None
        return BoundedQuantity(text=_flat(sentence[before.start() : quantity.end]), is_lower=is_lower)
    ends = _TO.search(start)
    if _FROM.search(start) or (ends is not None and not ends["not"]):
        opening = start.lower().rindex("between")
        return BoundedQuantity(text=_flat(sentence[opening : quantity.end]), is_lower=ends is None)
    behind = _BEHIND.match(sentence, quantity.end)
    if behind is None:
        return None
    is_lower = not SIGNS[behind["sign"]] if behind["sign"] else behind["lower"] is not None
    return BoundedQuantity(text=_flat(sentence[quantity.start : behind.end()]), is_lower=is_lower)


def _side(before: re.Match[str], sentence: str) -> bool | None:
    """True for a lower bound by the phrase before a number; None where a distant negator leaves it open."""
    if before["sign"]:
        return SIGNS[before["sign"]]
    is_lower = before["lower"] is not None
    if before["negated"] is not None:
        return not is_lower
    start = sentence[: before.start()].rstrip()
    if _NEGATED_SUBJECT.search(start):
        return not is_lower
    # "not drop cups of more than 5 N": of which cups is this said?
    return None if _SAME_CLAUSE.search(start) else is_lower


def _flat(text: str) -> str:
    return " ".join(text.split())
