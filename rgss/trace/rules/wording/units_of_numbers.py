"""Numbers without a unit (R6).

The number is that of the INCOSE *Guide to Writing Requirements*, version 3.1.
"""

from __future__ import annotations

import math
import re
from bisect import bisect_right
from collections.abc import Iterator

from rgss.findings import Severity
from rgss.requirements import Requirement
from rgss.trace.rules.rule import Flaw, SentenceRule, Worded
from rgss.trace.sentences import Sentence, TermList, TextQuantity, phrases, words_of

_PURE_NUMBERS = phrases("""
    absorptivity, albedo, availability, coefficient, coefficients, confidence, count, duty cycle, efficiency,
    emissivity, exponent, factor, fraction, gain, index, likelihood, Mach, number, order, permittivity, pH,
    probability, proportion, quotient, rank, rate, ratio, recall, reflectivity, reliability, score, seed, sensitivity,
    share, specificity, transmittance, utilisation, utilization, value
""")
# "3 fingers" is a count; "a mass of 3 for each" and "3." are not.
_COUNTED = re.compile(r"(?:\s+|-)(?P<word>[A-Za-z][A-Za-z-]*)")
FUNCTION_WORDS = frozenset(
    words_of(
        "a after an and are as at before below above between but by during each for from has if in into is of on "
        "once or over per shall than that the then through to under until was when where while with within"
    )
)
# What a quantity stands behind. Behind another word a number is a name: station 3, joint 6, ISO 9001, SYS-012.
_INTRODUCTIONS = frozenset(
    words_of(
        "a about above an approximately are around at be below between beyond by equal equals exceed exceeding "
        "exceeds from is least maximum minimum most of over than to under was weigh weighs with within"
    )
)
_SHARE = re.compile(r"\d\s+(?:out\s+)?of\s+$")
# "3 of the cups" is a count of them.
_PART = re.compile(r"\s+of\s+(?:the|its|their|all|these|those)\s+(?P<word>[A-Za-z][A-Za-z-]*)")
_ONES = "two|three|four|five|six|seven|eight|nine"
_TEENS = "ten|eleven|twelve|thirteen|fourteen|fifteen|sixteen|seventeen|eighteen|nineteen"
_TENS = "twenty|thirty|forty|fifty|sixty|seventy|eighty|ninety"
_LARGE = "hundred|thousand|million|billion|dozen"
# "one" is a pronoun more often than a number.
_NUMBER_WORD = f"(?:{_ONES}|{_TEENS}|{_TENS}|{_LARGE})"
# "between 3 and 5 kg", "3 to 5 kg", "2, 4 or 6 kg", "2 × 3 m": the unit stands behind the last number.
# "95 of 100 cups", "two- and three-finger grippers", where what is counted stands there too.
_RANGE = re.compile(
    r"(?:-(?=\s))?\s*(?:,|(?:out\s+)?of\b|to\b|and\b|or\b|through\b|–|-|×|x\b|±|\+/-|:|/|\*|~|\.{3}|…)\s*"
    rf"(?:at\s+(?:least|most)\s+)?(?:[+-]?\d|{_NUMBER_WORD}\b)",
    re.IGNORECASE,
)
_IN_WORDS = re.compile(
    rf"\b(?:an?\s+(?={_LARGE}))?{_NUMBER_WORD}(?:(?:[\s-]|\s+and\s+)(?:one|{_NUMBER_WORD}))*\b", re.IGNORECASE
)
# "(1) the mode, (2) the voltage" are the marks of a list, "three (3) fingers" repeats a number, "[2]" is a reference.
_OPENING_OF_A_MARK = re.compile(r"[(\[]$|(?:^|[\s:;,])$")
_MARK = re.compile(r"\s*[)\]]")
_YEAR = re.compile(r"(?:19|20)\d\d")


def _without_unit(sentence: Sentence, terms: TermList, element: Worded) -> Iterator[Flaw]:
    bare = [
        (quantity.start, quantity.text)
        for quantity in sentence.quantities
        if quantity.unit == "1"
        and not _is_threshold(quantity, element)
        and not _needs_no_unit(sentence, quantity.start, quantity.end)
    ]
    bare += [
        (found.start(), found[0])
        for found in _IN_WORDS.finditer(sentence.text)
        if not _needs_no_unit(sentence, *found.span())
    ]
    if bare and not any(terms.find(sentence)):
        numbers = ", ".join(repr(text) for _, text in sorted(bare))
        yield Flaw(message=f"has the number {numbers} without a unit", hint="give the unit, or say what is counted")


def _needs_no_unit(sentence: Sentence, start: int, end: int) -> bool:
    """True if a number from one place of a sentence to another is a name, counts something, or is a part of one."""
    text = sentence.text
    if _is_mark(text, start, end):
        return True
    if _RANGE.match(text, end) or _YEAR.fullmatch(text, start, end) or _PART.match(text, end):
        return True
    count = bisect_right(sentence.tokens, start, key=lambda token: token.end)
    if count and _SHARE.search(text, 0, start) is None:
        before = sentence.tokens[count - 1]
        if before.start != sentence.response_start + 1 and before.word not in _INTRODUCTIONS:
            return True
    counted = _COUNTED.match(text, end)
    return counted is not None and counted["word"].lower() not in FUNCTION_WORDS


def _is_mark(text: str, start: int, end: int) -> bool:
    if _MARK.match(text, end) is None or (opening := _OPENING_OF_A_MARK.search(text, 0, start)) is None:
        return False
    # "1) the mode", where no bracket is open.
    return opening[0] in ("(", "[") or text.count("(", 0, start) <= text.count(")", 0, start)


def _is_threshold(quantity: TextQuantity, element: Worded) -> bool:
    """True if a pure number is the threshold of the requirement's criterion."""
    criterion = element.criterion if isinstance(element, Requirement) else None
    if criterion is None or criterion.unit != "1":
        return False
    return any(math.isclose(criterion.threshold, value) for value in quantity.values)


RULES: tuple[SentenceRule, ...] = (
    SentenceRule(
        id="wording.R6",
        severity=Severity.ERROR,
        explanation=(
            "A number has a unit, unless it counts something that is named, or is a pure number such as a ratio. "
            "Without its unit a number is read in whatever unit the reader is used to."
        ),
        find=_without_unit,
        terms=_PURE_NUMBERS,
        meaning="words for dimensionless numbers; with one of them in the sentence, a number needs no unit",
        breaking=(
            "The gripper shall weigh at most 3.",
            "The gripper shall lift 3.",
            "The arm shall stop within 0.5.",
            "When the load exceeds 3, the arm shall stop.",
            "The table shall have a height of 0.74 for each guest.",
            "The RGSS shall serve at least 95 of 100.",
            "The RGSS shall succeed in 95 out of 100.",
            "The gripper shall weigh at most ten.",
            "The arm shall stop in less than twenty-five.",
            "The gripper shall weigh at most 3 (as before).",
            "The gripper shall weigh (with cable at most 3) little.",
        ),
        passing=(
            "The cell shall fit on a table of at most 2 × 3 m.",
            "The gripper shall weigh at most 3 kg.",
            "The gripper shall have 3 fingers.",
            "The gripper shall have at least three fingers.",
            "The arm shall stop in less than ten seconds.",
            "The RGSS shall serve at least 95 of 100 cups.",
            "The RGSS shall serve two to four cups.",
            "The RGSS shall accept two- and three-finger grippers.",
            "The gripper shall have at least 2, at most three fingers.",
            "The gripper shall hold at most two of the cups.",
            "The gripper shall hold at most 3 of the cups.",
            "The gripper shall endure at least 10^6 cycles.",
            "The gripper shall endure at least 10⁶ cycles.",
            "The gripper shall run for at least 10 000 h.",
            "The sensor shall have a resistance of at least 50 Ω.",
            "The gripper shall cost at most $43000.",
            "The gripper shall cost at most 43,000 EUR.",
            "The arm shall reach station 3 of the line.",
            "The arm shall comply with ISO 10218 part 1.",
            "The cell shall keep the rules of EN 60204-1.",
            "The computer shall have a port of USB 3.0.",
            "The RGSS shall reach a task success score of at least 0.9.",
            "The contact shall have a friction coefficient of at least 0.5.",
            "The screw shall have a gear ratio of 3 to 1.",
            "The trial shall end with one of the outcomes in table 4.",
            "The cell shall report (1) the mode, (2) the state of the heater.",
            "The cell shall report, in this order: 1) the mode, 2) the state of the heater.",
            "The pump shall have a reliability of at least 0.98.",
            "The charger shall have an efficiency of at least 0.94.",
            "The detector shall have a sensitivity of at least 0.99.",
        ),
    ),
)
