"""Rules of numbers in a requirement: units, tolerances, targets.

Numbers of the rules are those of the INCOSE *Guide to Writing Requirements*, version 3.1.
"""

from __future__ import annotations

import math
import re
from bisect import bisect_right
from collections.abc import Iterator

from rgss.findings import Severity
from rgss.requirements import Requirement
from rgss.trace.rules.rule import Flaw, SentenceRule, Worded
from rgss.trace.rules.wording.number_lists import BOUNDS, EXTREMES, EXTREMES_AFTER, PURE_NUMBERS, UNMEASURED
from rgss.trace.sentences import Match, Sentence, TermList, TextQuantity, words_of

# "3 fingers" is a count; "a mass of 3 for each" and "3." are not.
_COUNTED = re.compile(r"(?:\s+|-)(?P<word>[A-Za-z][A-Za-z-]*)")
_FUNCTION_WORDS = frozenset(
    words_of(
        "a after an and are as at before below above between but by during each for from has if in into is of on "
        "once or over per shall than that the then through to under until was when where while with within"
    )
)
# "between 3 and 5 kg", "3 to 5 kg", "2, 4 or 6 kg", "2 × 3 m": the unit stands behind the last number.
_RANGE = re.compile(r"\s*(?:,|to\b|and\b|or\b|through\b|–|-|×|x\b|±|\+/-|:|/|\*)\s*[+-]?\d", re.IGNORECASE)
# What a quantity stands behind. Behind another word a number is a name: station 3, joint 6, ISO 9001, SYS-012.
_INTRODUCTIONS = frozenset(
    words_of(
        "a about above an approximately are around at be below between beyond by equal equals exceed exceeding "
        "exceeds from is least maximum minimum most of over than to under was weigh weighs with within"
    )
)
_YEAR = re.compile(r"(?:19|20)\d\d")
_SIGN_OF_BOUND = re.compile(r"[±≤≥⩽⩾≦≧<>–]|\+/-|\d\s?[A-Za-z°%µ/^*]{0,10}\sto\s[+-]?\d")
# "a 0.2 kg cup" names a cup; "lift 0.2 kg" sets a target.
_ATTRIBUTE = re.compile(r"\s+(?P<word>[A-Za-z]+)")


def _without_unit(sentence: Sentence, terms: TermList, element: Worded) -> Iterator[Flaw]:
    bare = [
        quantity
        for quantity in sentence.quantities
        if quantity.unit == "1" and not _needs_no_unit(sentence, quantity, element)
    ]
    if bare and not any(terms.find(sentence)):
        numbers = ", ".join(repr(quantity.text) for quantity in bare)
        yield Flaw(message=f"has the number {numbers} without a unit", hint="give the unit, or say what is counted")


def _needs_no_unit(sentence: Sentence, quantity: TextQuantity, element: Worded) -> bool:
    if _RANGE.match(sentence.text, quantity.end) or _YEAR.fullmatch(quantity.text):
        return True
    count = bisect_right(sentence.tokens, quantity.start, key=lambda token: token.end)
    if count:
        before = sentence.tokens[count - 1]
        if before.start != sentence.response_start + 1 and before.word not in _INTRODUCTIONS:
            return True
    counted = _COUNTED.match(sentence.text, quantity.end)
    if counted is not None and counted["word"].lower() not in _FUNCTION_WORDS:
        return True
    criterion = element.criterion if isinstance(element, Requirement) else None
    return criterion is not None and criterion.unit == "1" and math.isclose(criterion.threshold, quantity.value)


def _without_tolerance(sentence: Sentence, terms: TermList, _: Worded) -> Iterator[Flaw]:
    start = sentence.response_start
    if not sentence.quantities or _SIGN_OF_BOUND.search(sentence.text, start) or any(terms.find(sentence, start=start)):
        return
    exact = [
        quantity
        for quantity in sentence.quantities
        if quantity.unit != "1" and quantity.start >= start and not _is_attribute(sentence, quantity)
    ]
    if exact:
        numbers = ", ".join(repr(quantity.text) for quantity in exact)
        yield Flaw(
            message=f"asks for {numbers} exactly",
            hint="give a bound ('at least', 'at most', 'within') or a tolerance ('± 1 mm')",
        )


def _is_attribute(sentence: Sentence, quantity: TextQuantity) -> bool:
    after = _ATTRIBUTE.match(sentence.text, quantity.end)
    return after is not None and after["word"].lower() not in _FUNCTION_WORDS


def _without_target(sentence: Sentence, terms: TermList, element: Worded) -> Iterator[Flaw]:
    if isinstance(element, Requirement) and element.criterion is not None:
        return
    if terms.is_absent(sentence):
        return
    matches = terms.find(sentence, start=sentence.response_start)
    found = dict.fromkeys(match.term for match in matches if not _is_named_extreme(sentence, match))
    if found and not any(quantity.start >= sentence.response_start for quantity in sentence.quantities):
        words = ", ".join(f"'{term}'" for term in found)
        yield Flaw(message=f"says {words}, but sets no target", hint="give a number to measure by, or a criterion")


def _is_named_extreme(sentence: Sentence, match: Match) -> bool:
    """'the maximum rate' is the name of a quantity; 'maximum uptime' is as much of it as there can be."""
    if match.term not in EXTREMES:
        return False
    tokens = sentence.tokens
    is_bound = match.after < len(tokens) and tokens[match.after].word == "of"
    return is_bound or match.first == 0 or tokens[match.first - 1].word not in EXTREMES_AFTER


RULES: tuple[SentenceRule, ...] = (
    SentenceRule(
        id="wording.R6",
        severity=Severity.ERROR,
        explanation=(
            "A number has a unit, unless it counts something that is named, or is a pure number such as a ratio. "
            "Without its unit a number is read in whatever unit the reader is used to."
        ),
        find=_without_unit,
        terms=PURE_NUMBERS,
        meaning="words for pure numbers; where one stands in the sentence, a number needs no unit",
    ),
    SentenceRule(
        id="wording.R33",
        severity=Severity.WARNING,
        explanation=(
            "A quantity has a bound or a tolerance: no product has an exact value, so nobody could say whether "
            "the requirement is met."
        ),
        find=_without_tolerance,
        terms=BOUNDS,
        meaning="words of bounds; where one stands behind 'shall', the quantities there are bounded",
    ),
    SentenceRule(
        id="wording.R34",
        severity=Severity.WARNING,
        explanation=(
            "A requirement on performance has a target that can be measured: a number in its response, or a criterion."
        ),
        find=_without_target,
        terms=UNMEASURED,
        meaning="words of performance that need a number",
    ),
)
