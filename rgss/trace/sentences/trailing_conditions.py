"""Conditions behind the response, where EARS has them before the subject: ``shall open when a cup is seen``."""

from __future__ import annotations

import re
from collections.abc import Sequence

_OPENINGS = frozenset({"if", "unless", "when", "whenever", "while", "whilst"})
"""Words that open a condition within a response. ``where`` is left out: it mostly refers to a noun before it."""

# Verbs whose object may begin with such a word: "shall record when the door opens".
_REPORTING = re.compile(
    "calculate|check|compute|confirm|decide|detect|determine|display|find|indicate|know|learn|log|measure|monitor|"
    "notice|observe|predict|print|read|recogni[sz]e|record|register|report|see|sense|show|signal|state|test|track|verify"
)
# "as if", "even when", "of when", "a short while", "at the time when".
_NO_CONDITION_AFTER = re.compile(
    "a|as|case|day|even|from|instant|like|little|long|moment|of|or|point|short|state|than|time|until|whether"
)
# The ends of clauses to escape by, such as "if necessary", which a rule of their own judges.
_ESCAPE = re.compile(
    "applicable|appropriate|available|desirable|desired|feasible|impractical|impracticable|necessary|needed|"
    "possible|practical|practicable|relevant|required"
)
_LONGEST_ESCAPE = 3
"""Words of the longest such clause behind the first: ``if at all possible``."""


def trailing_condition(response: Sequence[str]) -> str:
    """The word that opens a condition within a response; empty if there is none.

    Args:
        response: The words behind ``shall``.
    """
    words = [word.lower() for word in response]
    for index, word in enumerate(words[1:-1], start=1):
        if word not in _OPENINGS:
            continue
        is_object = index == 1 and _REPORTING.fullmatch(words[0])
        is_escape = any(map(_ESCAPE.fullmatch, words[index + 1 : index + 1 + _LONGEST_ESCAPE]))
        if not is_object and not is_escape and not _NO_CONDITION_AFTER.fullmatch(words[index - 1]):
            return word
    return ""
