"""The '/' between words (R17).

The number is that of the INCOSE *Guide to Writing Requirements*, version 3.1.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from rgss.findings import Severity
from rgss.trace.rules.rule import Flaw, SentenceRule, Worded
from rgss.trace.sentences import Sentence, TermList, is_unit

_OBLIQUE = re.compile(r"[\w%°²³^*·.]+(?:\s?/\s?[\w%°²³^*·.]+)+")
_AFTER_A_NUMBER = re.compile(r"\d\s?$")
# "parts/h" is a rate also without a number; the words of "max/min" are none.
_RATE = re.compile(r"(?!max/|maximum/)[A-Za-z]+\s?/\s?(?:s|min|h)")
_ABBREVIATIONS = re.compile(r"[A-Z0-9]+(?:\s?/\s?[A-Z0-9]+)+")


def _oblique(sentence: Sentence, _: TermList, __: Worded) -> Iterator[Flaw]:
    if "/" not in sentence.text:
        return
    found = [
        match[0].rstrip(".")
        for match in _OBLIQUE.finditer(sentence.text)
        if not _is_no_choice(match[0].rstrip("."), sentence.text[: match.start()])
    ]
    if found:
        texts = ", ".join(repr(text) for text in dict.fromkeys(found))
        yield Flaw(message=f"has {texts}: both, or either?", hint="say 'and', 'or', or make two requirements")


def _is_no_choice(text: str, before: str) -> bool:
    """Units, rates, ratios of numbers, abbreviations such as I/O, and addresses are written with a '/'."""
    if is_unit(text.replace(" ", "")) or _ABBREVIATIONS.fullmatch(text) or _RATE.fullmatch(text):
        return True
    if _AFTER_A_NUMBER.search(before) and is_unit(text.rpartition("/")[2].strip()):
        return True
    return before.endswith((":/", "/")) or all(part.strip()[:1].isdigit() for part in text.split("/"))


RULES: tuple[SentenceRule, ...] = (
    SentenceRule(
        id="wording.R17",
        severity=Severity.WARNING,
        explanation=(
            "A requirement has no '/' between words, which may mean 'and', 'or', or both. Units, numbers and "
            "abbreviations are allowed."
        ),
        find=_oblique,
        breaking=(
            "The gripper shall hold the cup/plate.",
            "The gripper shall open and/or close.",
            "The gripper shall hold the cup / plate.",
            "The panel shall show the max/min.",
        ),
        passing=(
            "The I/O board shall read the sensor.",
            "The computer shall speak TCP/IP.",
            "The sensor shall have a sensitivity of at least 100 Ω/V.",
            "The spindle shall show the speed in r/min.",
            "The cell shall serve at least 60 parts/h.",
            "The cell shall serve at least 3 guests/day.",
            "The arm shall accelerate with at most 2 m/s2.",
        ),
    ),
)
