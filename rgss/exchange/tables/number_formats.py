"""Texts that a workbook shows of its numbers: `0007`, `REQ-0007`, `0.7 kg`, `95%`."""

from __future__ import annotations

import re
from decimal import Decimal

_TOKEN = re.compile(
    r'"(?P<quoted>[^"]*)"|\\(?P<escaped>.)|\[\$(?P<currency>[^\]-]*)[^\]]*\]|\[(?P<condition>[^\]]*)\]|[_*].'
    r"|(?P<digits>[0#?][0#?,.]*)|(?P<literal>[-+/():%$€£¥ ])",
    re.DOTALL,
)


def number_text(value: float, number_format: str) -> str:
    """A number with the text, the per cent sign and the leading zeros of its format.

    Decimals are those of the number, whatever the format rounds to, and thousands are not separated. A number of a
    format with another meaning, such as a fraction, or with another form for its sign, is as it is without a format.

    Args:
        value: The number.
        number_format: The format, in the notation of Excel (ECMA-376, 18.8.31).
    """
    plain = str(value)
    sections = number_format.split(";")
    if (value < 0 and len(sections) > 1) or (value == 0 and len(sections) > 2) or "e" in plain or "n" in plain:
        return plain
    parts, digits, end = [""], "", 0
    while found := _TOKEN.match(sections[0], end):
        end = found.end()
        if found["condition"] and found["condition"][0] in "<>=":
            return plain
        if found["digits"] is None:
            parts[-1] += found["quoted"] or found["escaped"] or found["currency"] or found["literal"] or ""
            continue
        if digits:
            return plain
        digits = found["digits"]
        parts.append("")
    if end < len(sections[0]) or not digits:
        return plain
    before, after = parts
    if "%" in before + after:
        plain = f"{(Decimal(plain) * 100).normalize():f}"
    elif re.fullmatch("0+", digits) and re.fullmatch("-?[0-9]+", plain):
        plain = plain.zfill(len(digits) + plain.startswith("-"))
    sign = "-" if plain.startswith("-") else ""
    return f"{sign}{before}{plain.removeprefix('-')}{after}".strip()
