"""Absolutes (R26).

The number is that of the INCOSE *Guide to Writing Requirements*, version 3.1.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from rgss.findings import Severity
from rgss.trace.rules.rule import Flaw, SentenceRule, Worded
from rgss.trace.sentences import Match, Sentence, TermList, phrases

_ABSOLUTES = phrases("""
    absolutely, always, at all times, bug-free, completely, defect-free, entirely, error-free, every,
    fault-free, flawless, flawlessly, foolproof, forever, impossible, in all cases, in all circumstances,
    infinite, infinitely, maintenance-free, never, perfect, perfectly, risk-free, totally, trouble-free, under
    all circumstances, under any circumstances, under no circumstances, unlimited, without exception, zero
    defects, zero downtime
""")
_NUMBER_NEXT = re.compile(r"\s*[~±]?\d")
_HUNDRED = re.compile(r"(?<![\w.])100\s?(?:%|percent\b|per\s?cent\b)")
_BOUND_BEFORE = re.compile(r"(?:at most|up to|to|than|below|under|within|and|-|–|≤|<)\s*$", re.IGNORECASE)


def _absolute(sentence: Sentence, terms: TermList, _: Worded) -> Iterator[Flaw]:
    said = [match.term for match in terms.find(sentence) if not _is_period(sentence, match)]
    said += [match[0] for match in _HUNDRED.finditer(sentence.text) if not _is_bounded(sentence, match.start())]
    if said:
        found = ", ".join(f"'{term}'" for term in dict.fromkeys(said))
        yield Flaw(
            message=f"says {found}, which nothing attains", hint="give the share, rate or limit that is good enough"
        )


def _is_period(sentence: Sentence, match: Match) -> bool:
    """'every 10 ms' is a period, no absolute."""
    end = sentence.tokens[match.after - 1].end
    return match.term == "every" and _NUMBER_NEXT.match(sentence.text, end) is not None


def _is_bounded(sentence: Sentence, start: int) -> bool:
    return _BOUND_BEFORE.search(sentence.text[:start]) is not None


RULES: tuple[SentenceRule, ...] = (
    SentenceRule(
        id="wording.R26",
        severity=Severity.ERROR,
        explanation="A requirement asks for no absolute, which nothing attains and no number of trials can show.",
        find=_absolute,
        terms=_ABSOLUTES,
        meaning="absolutes, beside 100 %",
        breaking=(
            "The gripper shall always hold the cup.",
            "The gripper shall never drop the cup.",
            "The arm shall have 100 % availability.",
            "The arm shall reach every waypoint.",
            "The software shall be error-free.",
        ),
        passing=(
            "The planner shall sample the path every 10 ms.",
            "The supply shall deliver up to 100 % of the rated load.",
        ),
    ),
)
