"""Every rule of wording, in the order in which they are listed."""

from __future__ import annotations

from rgss.trace.rules.wording import logic as wording_logic
from rgss.trace.rules.wording import numbers as wording_numbers
from rgss.trace.rules.wording import repetition as wording_repetition
from rgss.trace.rules.wording import structure as wording_structure
from rgss.trace.rules.wording import words as wording_words

WORDING_RULES = (
    *wording_structure.RULES,
    *wording_words.RULES,
    *wording_numbers.RULES,
    *wording_logic.RULES,
    *wording_repetition.RULES,
)
