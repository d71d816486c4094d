"""Comparison phrases: the words and signs that make a number in a sentence a lower or an upper bound."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

LOWER_BEFORE = (
    "above",
    "above or equal to",
    "at a minimum",
    "at least",
    "at minimum",
    "at the least",
    "at the very least",
    "beyond",
    "bigger than",
    "deeper than",
    "equal to or above",
    "equal to or greater than",
    "equal to or higher than",
    "equal to or larger than",
    "equal to or longer than",
    "equal to or more than",
    "exceed",
    "exceeding",
    "exceeds",
    "farther than",
    "further than",
    "greater or equal",
    "greater or equal to",
    "greater than",
    "greater than or equal to",
    "heavier than",
    "higher or equal to",
    "higher than",
    "higher than or equal to",
    "in excess of",
    "larger or equal to",
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
    "stronger than",
    "surpass",
    "surpasses",
    "surpassing",
    "taller than",
    "thicker than",
    "upwards of",
    "wider than",
)
"""Phrases before a number that the quantity may exceed."""

UPPER_BEFORE = (
    "at a maximum",
    "at maximum",
    "at most",
    "at the most",
    "at the very most",
    "below",
    "below or equal to",
    "bounded by",
    "capped at",
    "closer than",
    "earlier than",
    "equal to or below",
    "equal to or fewer than",
    "equal to or less than",
    "equal to or lower than",
    "equal to or shorter than",
    "equal to or smaller than",
    "fewer than",
    "fewer than or equal to",
    "less or equal",
    "less or equal to",
    "less than",
    "less than or equal to",
    "lighter than",
    "limited to",
    "lower or equal to",
    "lower than",
    "lower than or equal to",
    "max",
    "maximum",
    "maximum of",
    "narrower than",
    "nearer than",
    "restricted to",
    "shorter than",
    "shorter than or equal to",
    "smaller or equal",
    "smaller or equal to",
    "smaller than",
    "smaller than or equal to",
    "thinner than",
    "time limit of",
    "under",
    "up to",
    "up to and including",
    "within",
)
"""Phrases before a number that the quantity must not exceed."""

LOWER_BEHIND = (
    "and above",
    "and longer",
    "and more",
    "and over",
    "and up",
    "as a minimum",
    "at least",
    "at the least",
    "minimum",
    "or above",
    "or farther",
    "or further",
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

NEGATORS = ("avoid", "avoids", "cannot", "neither", "never", "no", "nor", "not", "without")
"""What turns the phrase before a number into its opposite: 'no more than', 'not exceeding'."""

BETWEEN = (
    "allowed",
    "any",
    "at",
    "be",
    "become",
    "case",
    "circumstance",
    "circumstances",
    "condition",
    "conditions",
    "drop",
    "dropping",
    "ever",
    "event",
    "fall",
    "falling",
    "get",
    "getting",
    "go",
    "going",
    "in",
    "last",
    "moment",
    "permitted",
    "point",
    "reach",
    "rise",
    "rising",
    "take",
    "time",
    "to",
    "under",
    "weigh",
)
"""Words that may come between a negator and its phrase: 'not fall below', 'not at any time exceed'."""

HOLDING = (
    "apply",
    "cause",
    "consume",
    "draw",
    "exert",
    "exhibit",
    "have",
    "introduce",
    "need",
    "produce",
    "require",
    "show",
    "use",
)
"""Verbs behind a negator whose object is the bounded quantity: 'not have a mass exceeding'."""

GERUNDS = ("dropping", "exceeding", "falling", "getting", "going", "rising", "surpassing")
"""Words behind a 'from' that forbids: 'keep the force from exceeding'."""

CLAUSE_OPENINGS = ("and", "but", "or", "so", "that", "then", "where", "which", "who", "whose")
"""Words behind which a negator before them no longer applies."""
