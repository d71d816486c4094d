"""Comparison phrases: the words and signs that make a number in a sentence a lower or an upper bound."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

LOWER_BEFORE = (
    "above",
    "at a minimum",
    "at least",
    "at minimum",
    "beyond",
    "bigger than",
    "equal to or above",
    "equal to or greater than",
    "equal to or higher than",
    "equal to or larger than",
    "equal to or longer than",
    "equal to or more than",
    "exceed",
    "exceeding",
    "exceeds",
    "greater or equal to",
    "greater than",
    "greater than or equal to",
    "heavier than",
    "higher than",
    "higher than or equal to",
    "in excess of",
    "larger than",
    "larger than or equal to",
    "later than",
    "longer than",
    "longer than or equal to",
    "min",
    "minimum",
    "minimum of",
    "more than",
    "more than or equal to",
    "over",
    "upwards of",
    "wider than",
)
"""Phrases before a number that the quantity may exceed."""

UPPER_BEFORE = (
    "at a maximum",
    "at maximum",
    "at most",
    "at the most",
    "below",
    "bounded by",
    "capped at",
    "earlier than",
    "equal to or below",
    "equal to or fewer than",
    "equal to or less than",
    "equal to or lower than",
    "equal to or shorter than",
    "equal to or smaller than",
    "fewer than",
    "fewer than or equal to",
    "less or equal to",
    "less than",
    "less than or equal to",
    "lighter than",
    "limited to",
    "lower than",
    "lower than or equal to",
    "max",
    "maximum",
    "maximum of",
    "narrower than",
    "restricted to",
    "shorter than",
    "shorter than or equal to",
    "smaller than",
    "smaller than or equal to",
    "under",
    "up to",
    "up to and including",
    "within",
)
"""Phrases before a number that the quantity must not exceed."""

LOWER_BEHIND = (
    "and above",
    "and more",
    "and over",
    "and up",
    "as a minimum",
    "at least",
    "at the least",
    "minimum",
    "or above",
    "or greater",
    "or heavier",
    "or higher",
    "or larger",
    "or later",
    "or longer",
    "or more",
    "or over",
    "or upwards",
    "upwards",
)
"""Phrases behind a number that the quantity may exceed."""

UPPER_BEHIND = (
    "and below",
    "and under",
    "as a maximum",
    "at most",
    "at the latest",
    "at the most",
    "max",
    "maximum",
    "or below",
    "or earlier",
    "or fewer",
    "or less",
    "or lighter",
    "or lower",
    "or shorter",
    "or smaller",
    "or under",
)
"""Phrases behind a number that the quantity must not exceed."""

SIGNS: Mapping[str, bool] = MappingProxyType(
    {">=": True, "=>": True, "≥": True, "≧": True, "⩾": True, ">": True}
    | {"<=": False, "=<": False, "≤": False, "≦": False, "⩽": False, "<": False}
)
"""Signs before a number, and whether the quantity may exceed it; behind a number the other holds."""

NEGATORS = ("cannot", "never", "no", "not", "without")
"""What turns the phrase before a number into its opposite: 'no more than', 'not exceeding'."""

BETWEEN = (
    "allowed",
    "be",
    "become",
    "drop",
    "ever",
    "fall",
    "get",
    "go",
    "last",
    "reach",
    "rise",
    "take",
    "to",
    "weigh",
)
"""Words that may come between a negator and its phrase: 'not fall below', 'not be allowed to exceed'."""
