"""Bounds in the sentences of requirements: which numbers are limits, and to which side."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass

from rgss.trace.sentences.comparison_phrases import (
    BETWEEN,
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


_SIGNS = "|".join(re.escape(sign) for sign in sorted(SIGNS, key=len, reverse=True))
_BEFORE = re.compile(
    rf"""(?:\b(?P<negated>(?:{_alternatives(NEGATORS)}|\w+n['’]t)\s+(?:(?:{_alternatives(BETWEEN)})\s+){{0,3}})?
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


def bound_of(sentence: str, quantity: TextQuantity) -> BoundedQuantity | None:
    """The bound that a sentence makes of one of its quantities, by the words or signs around it.

    Args:
        sentence: The sentence.
        quantity: One of its quantities.
    """
    before = _BEFORE.search(sentence[: quantity.start])
    if before is not None:
        if before["sign"]:
            is_lower = SIGNS[before["sign"]]
        else:
            is_lower = (before["lower"] is not None) is not (before["negated"] is not None)
        return BoundedQuantity(text=_flat(sentence[before.start() : quantity.end]), is_lower=is_lower)
    behind = _BEHIND.match(sentence, quantity.end)
    if behind is None:
        return None
    is_lower = not SIGNS[behind["sign"]] if behind["sign"] else behind["lower"] is not None
    return BoundedQuantity(text=_flat(sentence[quantity.start : behind.end()]), is_lower=is_lower)


def _flat(text: str) -> str:
    return " ".join(text.split())
