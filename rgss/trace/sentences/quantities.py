"""Numbers with and without units in the sentences of requirements."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache

from rgss.errors import QuantityError
from rgss.quantities import dimension

_DIGIT = re.compile(r"\d")
_NUMBER = re.compile(
    r"""(?<![\w.-])                                                  # not inside UR10, KG-2 or 4.3.1
        (?P<number>[+-]?(?:\d{1,3}(?:,\d{3})+|\d+)(?:\.\d+)?(?:[eE][+-]?\d{1,3})?)
        (?![\d.,]*\d)
        (?:\s?(?P<unit>[A-Za-zµμ°%$][A-Za-z0-9µμ°%$/^*·]*))?""",
    re.VERBOSE,
)
_PROSE = frozenset({"a", "are", "as", "at", "has", "in"})
"""Words that are also the names of units, and far more often are just words."""


@dataclass(frozen=True, slots=True, kw_only=True)
class TextQuantity:
    """A number in a sentence.

    Attributes:
        text: The quantity as it is written, with its unit.
        value: Its magnitude.
        unit: Its unit; ``"1"`` for a pure number.
        start: Where it starts in the sentence.
        end: Where it ends there, its unit included.
    """

    text: str
    value: float
    unit: str
    start: int
    end: int


def quantities_in(sentence: str) -> Iterator[TextQuantity]:
    """Find the numbers of a sentence that are written in digits, each with its unit if it has one."""
    if _DIGIT.search(sentence) is None:
        return
    for match in _NUMBER.finditer(sentence):
        number, unit = match["number"], match["unit"] or ""
        if unit in _PROSE or not is_unit(unit):
            unit = ""
        text = match[0] if unit else number
        start = match.start()
        yield TextQuantity(
            text=text, value=float(number.replace(",", "")), unit=unit or "1", start=start, end=start + len(text)
        )


@lru_cache(maxsize=4096)
def is_unit(text: str) -> bool:
    """True if a text is the name of a unit, or a product or quotient of such names."""
    try:
        dimension(text)
    except QuantityError:
        return False
    return True
