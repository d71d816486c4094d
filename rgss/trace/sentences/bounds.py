"""Bounds in the sentences of requirements: which numbers are limits, and to which side."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass

from rgss.quantities import same_dimension
from rgss.trace.sentences.comparison_phrases import (
    BETWEEN,
    CLAUSE_OPENINGS,
    GERUNDS,
    HOLDING,
    LOWER_BEFORE,
    LOWER_BEHIND,
    LOWER_OF_A_TIME,
    NEGATORS,
    SIGNS,
    STATES,
    UPPER_BEFORE,
    UPPER_BEHIND,
    UPPER_OF_A_TIME,
)
from rgss.trace.sentences.quantities import TextQuantity


@dataclass(frozen=True, slots=True, kw_only=True)
class BoundedQuantity:
    """Bound on a quantity in a sentence.

    Attributes:
        text: The quantity with the words of its bound, as written.
        is_lower: True for a lower bound.
        start: Where the words of the bound or the quantity start in the sentence.
        end: Where they end.
    """

    text: str
    is_lower: bool
    start: int
    end: int


def _alternatives(phrases: Iterable[str]) -> str:
    """A pattern of phrases, the longest first, with any blanks or hyphens between their words."""
    ordered = sorted(phrases, key=lambda phrase: (-len(phrase), phrase))
    return "|".join(r"[\s-]+".join(map(re.escape, phrase.split())) for phrase in ordered)


_NEGATOR = rf"(?:{_alternatives(NEGATORS)}|\w+n['’]t)"
_SIGNS = "|".join(re.escape(sign) for sign in sorted(SIGNS, key=len, reverse=True))
_BEFORE = re.compile(
    rf"""(?:\b(?P<negated>
               (?:{_NEGATOR}|from(?=\s+(?:{_alternatives(GERUNDS)})))[\s,]+(?:(?:{_alternatives(BETWEEN)})[\s,]+){{0,6}}
               (?:(?:{_alternatives(HOLDING)})\s+(?:[\w-]+\s+){{0,4}})?)?
             \b(?:(?P<lower>{_alternatives(LOWER_BEFORE)})|(?P<upper>{_alternatives(UPPER_BEFORE)})
                |(?P<slower>{_alternatives(LOWER_OF_A_TIME)})|(?P<faster>{_alternatives(UPPER_OF_A_TIME)}))\b
             \.?(?:\s+(?:a|an|any|its|the)\b)?(?:(?:\s+[a-z-]+){{0,3}}\s+of)?\s+(?:(?:±|\+/-)\s*)?
           |(?P<sign>{_SIGNS})\s*)$""",
    re.IGNORECASE | re.VERBOSE,
)
_BEHIND = re.compile(
    rf"""\s*(?:,\s*)?(?:(?P<lower>{_alternatives(LOWER_BEHIND)})|(?P<upper>{_alternatives(UPPER_BEHIND)}))\b
         (?!\s+(?:of\s+)?[~±]?\d)
        |\s*(?P<sign>{_SIGNS})""",
    re.IGNORECASE | re.VERBOSE,
)
_NEGATED_SUBJECT = re.compile(
    rf"""(?:^|[.,;]\s*)(?:no|none|neither|nothing)\b[^.,;]*\bshall\b
         (?P<direct>(?:\s+(?:{_alternatives(BETWEEN)})\b){{0,6}}(?:\s+(?:{_alternatives(HOLDING)})\b(?:\s+[\w-]+){{0,4}})?$)?""",
    re.IGNORECASE | re.VERBOSE,
)
_SAME_CLAUSE = re.compile(
    rf"\b{_NEGATOR}\b(?:(?![.,;:]|\b(?:{_alternatives(CLAUSE_OPENINGS)}|shall)\b).)*$", re.IGNORECASE | re.DOTALL
)
# "stay closed below 8 bar" says when, and not which pressure.
_STATE = re.compile(rf"\b(?:{_alternatives(STATES)})$", re.IGNORECASE)
_PREPOSITIONS = frozenset({"above", "at or above", "at or below", "below", "beyond", "over", "under"})
_CONDITION = re.compile(
    r"\b(?:as\s+long\s+as|as\s+soon\s+as|if|in\s+case|once|unless|until|when|whenever|while|whilst)\b[^,;]*$",
    re.IGNORECASE,
)
_FROM = re.compile(r"\bbetween\s+$", re.IGNORECASE)
_TO = re.compile(r"(?P<not>\bnot\s+(?:be\s+|lie\s+)?)?\bbetween\s+[^,;]*\d[^,;]*\s+and\s+$", re.IGNORECASE)


def is_in_trailing_condition(sentence: str, place: int, response_start: int) -> bool:
    """True within a condition behind the response: ``shall stop when the force exceeds 10 N``.

    Args:
        sentence: The sentence.
        place: Where a word or quantity of it starts.
        response_start: Where the response starts.
    """
    return _CONDITION.search(sentence[response_start:place]) is not None


def bound_of(sentence: str, quantity: TextQuantity) -> BoundedQuantity | None:
    """The bound that a sentence makes of one of its quantities, by the words or signs around it."""
    start = sentence[: quantity.start]
    before = _BEFORE.search(start)
    if before is not None:
        is_lower = _side(before, sentence, quantity)
        return None if is_lower is None else _bounded(sentence, before.start(), quantity.end, is_lower=is_lower)
    ends = _TO.search(start)
    if _FROM.search(start) or (ends is not None and not ends["not"]):
        return _bounded(sentence, start.lower().rindex("between"), quantity.end, is_lower=ends is None)
    behind = _BEHIND.match(sentence, quantity.end)
    if behind is None:
        return None
    is_lower = not SIGNS[behind["sign"]] if behind["sign"] else behind["lower"] is not None
    return _bounded(sentence, quantity.start, behind.end(), is_lower=is_lower)


def _bounded(sentence: str, start: int, end: int, *, is_lower: bool) -> BoundedQuantity:
    return BoundedQuantity(text=" ".join(sentence[start:end].split()), is_lower=is_lower, start=start, end=end)


def _side(before: re.Match[str], sentence: str, quantity: TextQuantity) -> bool | None:
    """True for a lower bound by the phrase before a number; None where a distant word leaves it open."""
    if before["sign"]:
        return SIGNS[before["sign"]]
    if before["faster"] or before["slower"]:
        is_lower = (before["slower"] is not None) is same_dimension(quantity.unit, "s")
    else:
        is_lower = before["lower"] is not None
    if before["negated"] is not None:
        return not is_lower
    start = sentence[: before.start()].rstrip()
    subject = _NEGATED_SUBJECT.search(start)
    if subject is not None:
        # "No finger shall touch cups of more than 5 N": of which cups is this said?
        return None if subject["direct"] is None else not is_lower
    preposition = before["lower"] or before["upper"] or ""
    if _STATE.search(start) and " ".join(preposition.lower().split()) in _PREPOSITIONS:
        return None
    # "not drop cups of more than 5 N" is as open.
    return None if _SAME_CLAUSE.search(start) else is_lower
