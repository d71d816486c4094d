"""Numbers with and without units in the sentences of requirements."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

from rgss.currencies import currencies_in
from rgss.quantities import dimension
from rgss.trace.sentences.numbers import NOT_WITHIN, NUMBER, readings
from rgss.trace.sentences.units import ANY_CURRENCY, CURRENCIES, unit_of

_DIGIT = re.compile(r"\d")
# A unit goes on after a spaced operator, "5 m / s", and after a space where a symbol of a time or a length follows:
# "5 N m", "0.1 kg m²", "10 N s".
_GOES_ON = re.compile(
    r"\s?[/*·⋅]\s?(?P<operand>[A-Za-zµμ°Ω\u2126][A-Za-z0-9µμ°Ω\u2126^*⁻¹²³⁴]*)|\s(?P<symbol>(?:[mc]?m|s|h)(?:\^?-?[1-4]|⁻?[¹²³⁴])?)(?![\w^])"
)
_QUANTITY = re.compile(
    rf"""(?:(?<![\w.])(?P<currency>{ANY_CURRENCY})\s?|{NOT_WITHIN})
        (?P<number>{NUMBER})
        (?(currency)(?P<rate>/[A-Za-z]+)?|(?:\s?(?P<unit>[A-Za-zµμ°%$€£¥Ω\u2126](?:\^-\d|[A-Za-z0-9µμ°%$€£¥Ω\u2126/^*·⋅⁻¹²³⁴])*))?)""",
    re.VERBOSE,
)


@dataclass(frozen=True, slots=True, kw_only=True)
class TextQuantity:
    """A number in a sentence.

    Attributes:
        text: The quantity as it is written, with its unit.
        values: The magnitudes that it may have, the most likely first: ``1,500`` may be 1500 or 1.5.
        unit: Its unit, with the code of its currency if it has one; ``"1"`` for a pure number.
        start: Where it starts in the sentence.
        end: Where it ends there, its unit included.
    """

    text: str
    values: tuple[float, ...]
    unit: str
    start: int
    end: int


def quantities_in(sentence: str) -> Iterator[TextQuantity]:
    """Find the numbers of a sentence that are written in digits, each with its unit if it has one."""
    if _DIGIT.search(sentence) is None:
        return
    for match in _QUANTITY.finditer(sentence):
        before = match["currency"]
        found = unit_of(f"{before}{match['rate'] or ''}" if before else match["unit"] or "")
        end = match.end() if found else match.end("number")
        if found and not before:
            found, end = _whole_unit(sentence, found, match.start("unit"), end)
        unit = found or (CURRENCIES[before] if before else "1")
        values = readings(match.groupdict(), is_money=bool(currencies_in(dimension(unit))), is_pure=unit == "1")
        if not values:
            continue
        yield TextQuantity(
            text=sentence[match.start() : end],
            values=values,
            unit=unit,
            start=match.start(),
            end=end,
        )


def _whole_unit(sentence: str, found: str, start: int, end: int) -> tuple[str, int]:
    """The longest unit that begins where one was found, and where it ends."""
    while (more := _GOES_ON.match(sentence, end)) and (longer := unit_of(sentence[start : more.end()])):
        found, end = longer, more.end()
    return found, end
