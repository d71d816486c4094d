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
    "at or above",
    "at the least",
    "at the very least",
    "beyond",
    "bigger than",
    "deeper than",
    "equal or greater than",
    "equal or more than",
    "equal to or above",
    "equal to or greater than",
    "equal to or higher than",
    "equal to or larger than",
    "equal to or longer than",
    "equal to or more than",
    "exceed",
    "exceeding",
    "exceeds",
    "farther away than",
    "farther than",
    "further away than",
    "further than",
    "greater or equal",
    "greater or equal to",
    "greater than",
    "greater than or equal to",
    "heavier than",
    "higher or equal to",
    "higher than",
    "higher than or equal to",
    "hotter than",
    "in excess of",
    "larger or equal to",
    "larger than",
    "larger than or equal to",
    "later than",
    "longer than",
    "longer than or equal to",
    "louder than",
    "min",
    "minimum",
    "minimum of",
    "more than",
    "more than or equal to",
    "older than",
    "over",
    "stronger than",
    "surpass",
    "surpasses",
    "surpassing",
    "taller than",
    "thicker than",
    "upwards of",
    "warmer than",
    "wider than",
)
"""Phrases before a number that the quantity may exceed."""

UPPER_BEFORE = (
    "at a maximum",
    "at maximum",
    "at most",
    "at or below",
    "at the most",
    "at the very most",
    "below",
    "below or equal to",
    "bounded by",
    "capped at",
    "closer than",
    "colder than",
    "cooler than",
    "earlier than",
    "equal or fewer than",
    "equal or less than",
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
    "quieter than",
    "restricted to",
    "shorter than",
    "shorter than or equal to",
    "smaller or equal",
    "smaller or equal to",
    "smaller than",
    "smaller than or equal to",
    "sooner than",
    "thinner than",
    "time limit of",
    "under",
    "within",
    "younger than",
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

UPPER_OF_A_TIME = ("faster than", "quicker than")
"""Phrases before a number that a time must not exceed, and that a speed may exceed."""

LOWER_OF_A_TIME = ("slower than",)
"""Phrases before a number that a time may exceed, and that a speed must not exceed."""

EITHER_BEFORE = ("better than", "down to", "up to", "up to and including", "worse than")
"""Phrases that bound a number to a side which the measured quantity decides: 'lift up to 3 kg' asks for 3 kg."""

EITHER_BEHIND = ("or better", "or worse")
"""The same behind a number: of an accuracy ``or better`` is less, of a margin more."""

BOUND_PHRASES = frozenset(
    {*LOWER_BEFORE, *UPPER_BEFORE, *UPPER_OF_A_TIME, *LOWER_OF_A_TIME, *EITHER_BEFORE}
    | {*LOWER_BEHIND, *UPPER_BEHIND, *EITHER_BEHIND}
)
"""Every phrase before or behind a number that bounds it, to whichever side."""

STATES = ("active", "closed", "disabled", "enabled", "inactive", "locked", "off", "on", "open", "shut", "unlocked")
"""Words behind which 'above' and 'below' say when something is in a state: 'stay closed below 8 bar'."""

SIGNS: Mapping[str, bool] = MappingProxyType(
    {">=": True, "=>": True, "≥": True, "≧": True, "⩾": True, ">": True}
    | {"<=": False, "=<": False, "≤": False, "≦": False, "⩽": False, "<": False}
)
"""Signs before a number, and whether the quantity may exceed it; behind a number the other holds."""

NEGATORS = ("avoid", "avoids", "cannot", "neither", "never", "no", "nor", "not", "without")
"""Words that turn the phrase before a number into its opposite: 'no more than', 'not exceeding'."""

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
    "decrease",
    "decreasing",
    "drop",
    "dropping",
    "event",
    "ever",
    "fall",
    "falling",
    "get",
    "getting",
    "go",
    "going",
    "grow",
    "growing",
    "in",
    "increase",
    "increasing",
    "last",
    "moment",
    "move",
    "permitted",
    "point",
    "raised",
    "reach",
    "reduced",
    "rise",
    "rising",
    "sink",
    "sinking",
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

GERUNDS = (
    "decreasing",
    "dropping",
    "exceeding",
    "falling",
    "getting",
    "going",
    "increasing",
    "rising",
    "sinking",
    "surpassing",
)
"""Words behind a 'from' that forbids: 'keep the force from exceeding'."""

CLAUSE_OPENINGS = ("and", "but", "or", "so", "that", "then", "where", "which", "who", "whose")
"""Words behind which a negator before them no longer applies."""
