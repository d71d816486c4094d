"""Quantities without a bound or a tolerance (R33).

The number is that of the INCOSE *Guide to Writing Requirements*, version 3.1.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from rgss.findings import Severity
from rgss.trace.rules.rule import Flaw, SentenceRule, Worded
from rgss.trace.rules.wording.units_of_numbers import FUNCTION_WORDS
from rgss.trace.sentences import (
    BOUND_PHRASES,
    Sentence,
    TermList,
    TextQuantity,
    is_in_trailing_condition,
    phrases,
)

_OTHER_BOUNDS = phrases("""
    accuracy, between, confidence, every, from, limit, plus or minus, range, tolerance
""")
_BOUNDS = tuple(sorted({*BOUND_PHRASES, *_OTHER_BOUNDS}))
_SIGN_OF_BOUND = re.compile(r"[±≤≥⩽⩾≦≧<>–]|\+/-|\d\s?[A-Za-z°%µ/^*]{0,10}\sto\s[+-]?\d")
# "a 0.2 kg cup" names a cup; "lift 0.2 kg" sets a target.
_ATTRIBUTE = re.compile(r"\s+(?P<word>[A-Za-z]+)")


def _without_tolerance(sentence: Sentence, terms: TermList, _: Worded) -> Iterator[Flaw]:
    start = sentence.response_start
    if not sentence.quantities or _SIGN_OF_BOUND.search(sentence.text, start) or any(terms.find(sentence, start=start)):
        return
    exact = [
        quantity
        for quantity in sentence.quantities
        if quantity.unit != "1"
        and quantity.start >= start
        and not _is_attribute(sentence, quantity)
        and not is_in_trailing_condition(sentence.text, quantity.start, start)
    ]
    if exact:
        numbers = ", ".join(repr(quantity.text) for quantity in exact)
        yield Flaw(
            message=f"asks for {numbers} exactly",
            hint="give a bound ('at least', 'at most', 'within') or a tolerance ('± 1 mm')",
        )


def _is_attribute(sentence: Sentence, quantity: TextQuantity) -> bool:
    after = _ATTRIBUTE.match(sentence.text, quantity.end)
    return after is not None and after["word"].lower() not in FUNCTION_WORDS


RULES: tuple[SentenceRule, ...] = (
    SentenceRule(
        id="wording.R33",
        severity=Severity.WARNING,
        explanation=(
            "A quantity has a bound or a tolerance: no product has an exact value, so it could not be decided whether "
            "the requirement is met."
        ),
        find=_without_tolerance,
        terms=_BOUNDS,
        meaning="words of bounds; with one of them after 'shall', the quantities there are bounded",
        breaking=(
            "The gripper shall have a length of 120 mm.",
            "The arm shall move at 1 m/s.",
            "The arm shall stop 2 s after the alarm.",
        ),
        passing=(
            "The RGSS shall have a total cost of at most 43,000 USD.",
            "The gripper shall hold a 0.2 kg cup.",
            "The serving robot shall carry 2 cups.",
            "The connector shall have 8 pins.",
            "The controller shall count 10^3 pulses.",
            "The arm shall accelerate between 3 and 5 m/s^2.",
            "The table shall have a height of 740 mm ± 5 mm.",
            "The table shall have a height of 740 mm with a tolerance of 5 mm.",
            "The arm shall turn joint 6 within 90 deg.",
            "The sensor shall deliver at least 100 images per second.",
            "The algorithm shall state a confidence interval of 95 %.",
            "The gripper shall carry a load of 0.5 kg to 2 kg.",
            "The gripper shall limit the slip to at most 10 mm.",
            "The thermal model shall cover 0 to 40 degC.",
            "The pump shall deliver between 2 and 3 litres per minute.",
            "The tower shall withstand a wind speed of at least 50 m/s.",
            "The archive shall store each record for at least 10 years.",
            "The leak rate shall be no worse than 3 mm/s.",
            "The arm shall move faster than 1 m/s.",
            "The cell shall work at temperatures down to -10 degC.",
            "The controller shall reset if no command arrives for 1 s.",
        ),
    ),
)
