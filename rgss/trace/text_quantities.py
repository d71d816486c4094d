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

_LOWER = r"(?:at\s+least|(?:no|not)\s+(?:less|lower|fewer|smaller|shorter|earlier)\s+than|(?:a\s+)?minimum\s+of)"
_UPPER = (
    r"(?:at\s+most|(?:no|not)\s+(?:more|higher|greater|larger|longer|later)\s+than|(?:a\s+)?maximum\s+of|"
    r"not\s+exceed|up\s+to)"
)
_ABOVE = r"(?:more|higher|greater|larger|longer)\s+than|above"
_BELOW = r"(?:less|lower|fewer|smaller|shorter)\s+than|below|within"
_BOUND = re.compile(
    rf"\b(?:(?P<lower>{_LOWER}|(?<!no )(?<!not )(?:{_ABOVE}))|(?:{_UPPER}|(?<!no )(?<!not )(?:{_BELOW})))"
    r"(?:\s+(?:a|an|the))?\s+$",
    re.IGNORECASE,
)


@dataclass(frozen=True, slots=True, kw_only=True)
class TextQuantity:
    """A number in a sentence.

    Attributes:
        text: It as it is written, with its unit.
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


@dataclass(frozen=True, slots=True, kw_only=True)
class BoundWords:
    """Words that make the number behind them a bound.

    Attributes:
        text: They as they are written.
        is_lower: Whether what is bounded may be larger, and not smaller.
    """

    text: str
    is_lower: bool


def bound_before(sentence: str, start: int) -> BoundWords | None:
    """The words of a bound right before a number.

    Args:
        sentence: The sentence.
        start: Where the number starts.
    """
    match = _BOUND.search(sentence[:start])
    if match is None:
        return None
    return BoundWords(text=" ".join(match[0].split()), is_lower=match["lower"] is not None)


@lru_cache(maxsize=4096)
def is_unit(text: str) -> bool:
    """Tell whether a text is the name of a unit, or a product or quotient of such names."""
    try:
        dimension(text)
    except QuantityError:
        return False
    return True
