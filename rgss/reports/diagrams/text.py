"""Text width and line breaks of diagrams, the same on every machine."""

from __future__ import annotations

import unicodedata
from functools import lru_cache

_SLACK = 1.02
"""Margin for the differences between substitute fonts."""
_OTHER, _FULL_WIDTH, _NONE = 0.84, 1.0, 0.0

# Advance widths of DejaVu Sans, which Verdana has too, in thousandths of the font size, from the
# blank to the tilde. They are the widest of the usual fonts, so that a text fits with any of them.
_PLAIN = (
    318, 401, 460, 838, 636, 950, 780, 275, 390, 390, 500, 838, 318, 361, 318, 337,
    636, 636, 636, 636, 636, 636, 636, 636, 636, 636, 337, 337, 838, 838, 838, 531,
    1000, 684, 686, 698, 770, 632, 575, 775, 752, 295, 295, 656, 557, 863, 748, 787,
    603, 787, 695, 635, 611, 732, 684, 989, 685, 611, 685, 390, 337, 390, 838, 500,
    500, 613, 635, 550, 635, 615, 352, 635, 634, 278, 278, 579, 278, 974, 634, 612,
    635, 635, 411, 521, 392, 634, 592, 818, 592, 592, 525, 636, 337, 636, 838,
)  # fmt: skip
_BOLD = (
    348, 456, 521, 838, 696, 1002, 872, 306, 457, 457, 523, 838, 380, 415, 380, 365,
    696, 696, 696, 696, 696, 696, 696, 696, 696, 696, 400, 400, 838, 838, 838, 580,
    1000, 774, 762, 734, 830, 683, 683, 821, 837, 372, 372, 775, 637, 995, 837, 850,
    733, 850, 770, 720, 682, 812, 774, 1103, 771, 724, 725, 457, 365, 457, 838, 500,
    500, 675, 716, 593, 716, 678, 435, 716, 712, 343, 343, 665, 343, 1042, 712, 687,
    716, 716, 493, 595, 478, 712, 652, 924, 645, 652, 582, 712, 365, 712, 838,
)  # fmt: skip


@lru_cache(maxsize=8192)
def text_width(text: str, size: float, *, bold: bool = False) -> float:
    """Width of a line, in the unit of the font size.

    Args:
        text: The line.
        size: The font size.
        bold: True if it is bold.
    """
    widths = _BOLD if bold else _PLAIN
    return sum(_advance(character, widths) for character in text) * size * _SLACK


def wrapped(text: str, width: float, size: float, *, bold: bool = False) -> tuple[str, ...]:
    """Wrap a text into lines that fit; a word that is longer than a line is broken.

    Args:
        text: The text; any run of blanks and line breaks counts as one blank.
        width: The greatest width of a line, in the unit of the font size.
        size: The font size.
        bold: True if it is bold.
    """
    lines: list[str] = []
    line = ""
    for word in text.split():
        longer = f"{line} {word}" if line else word
        if text_width(longer, size, bold=bold) <= width:
            line = longer
            continue
        if line:
            lines.append(line)
        *full, line = _pieces(word, width, size, bold=bold)
        lines.extend(full)
    return (*lines, line) if line else tuple(lines)


def shortened(text: str, width: float, size: float) -> str:
    """Text on one line, cut with an ellipsis if it does not fit."""
    line = " ".join(text.split())
    if text_width(line, size) <= width:
        return line
    while line and text_width(f"{line}…", size) > width:
        line = line[:-1]
    return f"{line.rstrip()}…"


def _pieces(word: str, width: float, size: float, *, bold: bool) -> list[str]:
    """Pieces of a word that fit, broken after a hyphen, an underscore or a point if there is one."""
    pieces = []
    while text_width(word, size, bold=bold) > width and len(word) > 1:
        end = 1
        while end < len(word) and text_width(word[: end + 1], size, bold=bold) <= width:
            end += 1
        soft = max(word.rfind(sign, 0, end) for sign in "-_./:") + 1
        cut = soft if soft > end // 2 else end
        pieces.append(word[:cut])
        word = word[cut:]
    return [*pieces, word]


def _advance(character: str, widths: tuple[int, ...]) -> float:
    code = ord(character)
    if 32 <= code < 32 + len(widths):
        return widths[code - 32] / 1000
    if unicodedata.combining(character):
        return _NONE
    return _FULL_WIDTH if unicodedata.east_asian_width(character) in "WF" else _OTHER
