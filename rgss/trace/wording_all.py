"""Every rule of wording, in the order in which they are listed."""

from __future__ import annotations

from rgss.trace import wording_logic, wording_numbers, wording_repetition, wording_structure, wording_words

WORDING_RULES = (
    *wording_structure.RULES,
    *wording_words.RULES,
    *wording_numbers.RULES,
    *wording_logic.RULES,
    *wording_repetition.RULES,
)
