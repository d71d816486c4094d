"""Times without a number (R35).

The number is that of the INCOSE *Guide to Writing Requirements*, version 3.1.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from rgss.findings import Severity
from rgss.trace.rules.rule import Flaw, SentenceRule, Worded
from rgss.trace.sentences import Match, Sentence, TermList, listed, phrases

# Definite where the response states a time: 'within 2 s after'.
_SEQUENCE_WORDS = phrases("""
    after, afterwards, before, once, subsequently, until
""")
INDEFINITE_TIMES = (
    *_SEQUENCE_WORDS,
    *phrases("""
    a.s.a.p, as early as possible, as fast as possible, as late as possible, as promptly as possible, as quickly
    as possible, as rapidly as possible, as soon as possible, asap, at last, at regular intervals, at the
    earliest, at the latest, at times, eventually, finally, for a while, for some time, from time to time,
    immediately, in a timely fashion, in a timely manner, in due course, in good time, in near real time, in
    real time, in the long run, in the near future, in time, instantaneous, instantaneously, instantly,
    momentarily, near real time, now and then, on a regular basis, periodically, promptly, regularly, right
    away, shortly, simultaneously, sometimes, soon, sooner or later, straight away, ultimately, until further
    notice, with minimal delay, within a short time, without delay
"""),
)
"""Clauses to escape by (R8) may contain one of these; the sentence then breaks this rule alone."""
_END_OR_PURPOSE = re.compile(r"\s+(?:for|to)\b|\s*[.,;:]|\s*$")
# "50 mm before the table" and "before the shelf" are places, where no verb follows: "before the shelf moves".
_LENGTH_BEFORE = re.compile(r"\d\s?(?:[mcdµ]?m|metres?|meters?|inch(?:es)?|in|feet|ft)\s+$")
_PLACES = (
    "barrier|basket|belt|bin|border|bottle|boundary|box|cabinet|camera|chair|container|conveyor|counter|cup|curtain|"
    "desk|door|edge|end stop|fence|fixture|gate|gripper|guard|line|machine|mug|object|obstacle|pallet|person|place|"
    "plate|post|rack|robot|scanner|screen|shelf|station|surface|table|target|tool|tray|wall|window|workpiece|zone"
)
_PLACE_AFTER = re.compile(
    rf"\s+(?:an?|any|each|every|its|the)\s+(?:[a-z-]+\s+)??(?:{_PLACES})"
    r"(?=\s*(?:[.,;:)]|$)|\s+(?:and|at|by|for|in|of|on|or|to|when|while|with|within)\b)",
    re.IGNORECASE,
)
_TIME_GIVEN = re.compile(r"\d\s?(?:ns|us|µs|ms|s|sec|seconds?|min|minutes?|h|hours?|d|days?|weeks?|months?|years?)\b")
# "after 3 invalid samples"
_NUMBER_AFTER = re.compile(r"\s+(?:at\s+(?:least|most)\s+)?\d")


def _indefinite_time(sentence: Sentence, terms: TermList, _: Worded) -> Iterator[Flaw]:
    if terms.is_absent(sentence):
        return
    is_timed = _TIME_GIVEN.search(sentence.response) is not None
    found = listed(
        match
        for match in terms.find(sentence, start=sentence.response_start)
        if not (match.term in _SEQUENCE_WORDS and (is_timed or _is_counted(sentence, match)))
        and not _is_no_time(sentence, match)
    )
    if found:
        yield Flaw(message=f"says {found}, which sets no time", hint="say within which time of which event")


def _is_counted(sentence: Sentence, match: Match) -> bool:
    return _NUMBER_AFTER.match(sentence.text, sentence.tokens[match.after - 1].end) is not None


def _is_no_time(sentence: Sentence, match: Match) -> bool:
    """'once per day' is a rate, 'before the shelf' a place, 'a point in time' and 'in time services' are things."""
    tokens = sentence.tokens
    if match.term == "once":
        return match.after < len(tokens) and tokens[match.after].word in ("a", "again", "daily", "each", "every", "per")
    end = tokens[match.after - 1].end
    if match.term == "before":
        is_distance = _LENGTH_BEFORE.search(sentence.text, 0, tokens[match.first].start) is not None
        return is_distance or _PLACE_AFTER.match(sentence.text, end) is not None
    is_point = match.first > 0 and tokens[match.first - 1].word in ("point", "points")
    return match.term == "in time" and (is_point or _END_OR_PURPOSE.match(sentence.text, end) is None)


RULES: tuple[SentenceRule, ...] = (
    SentenceRule(
        id="wording.R35",
        severity=Severity.WARNING,
        explanation=(
            "A requirement sets its times by numbers. Words of sequence, such as 'after', are allowed where the "
            "response states a time, and 'before' where it is of a place: behind a length, or before a thing such as "
            "'the shelf'."
        ),
        find=_indefinite_time,
        terms=INDEFINITE_TIMES,
        meaning="words of indefinite time",
        breaking=(
            "The gripper shall eventually hold the cup.",
            "The arm shall eventually stop.",
            "The arm shall stop immediately.",
            "The arm shall stop after the cup is placed.",
            "The arm shall wait until the cup is placed.",
            "The arm shall stop as soon as possible.",
            "The arm shall stop ASAP.",
            "The arm shall stop in time.",
            "The arm shall stop once the cup is placed.",
            "The arm shall stop a.s.a.p. when told.",
            "The arm shall stop before the shelf moves.",
            "The arm shall stop before the alarm.",
            "The arm shall stop before placing the cup.",
            "The arm shall stop in a timely fashion.",
        ),
        passing=(
            "The arm shall stop within 2 s after the alarm.",
            "The cell shall report once per day.",
            "The cell shall report a fault after 3 invalid samples.",
            "The supplier shall deliver the arm at least 4 weeks before the start.",
            "The arm shall stop before the shelf.",
            "The arm shall stop at least 50 mm before the end of travel.",
            "The cell shall report the counters in Time Services telemetry.",
        ),
    ),
)
