"""Invisible characters: those that reorder, join or hide text, and their visible form.

A right-to-left override changes the displayed order of a sentence ("Trojan Source", Boucher and Anderson, 2021); a
zero-width character makes two words differ that look alike. Output of rgss for people shows them by their code point,
as in ``[U+202E]``.
"""

from __future__ import annotations

import re
from typing import Any

_INVISIBLE = re.compile(
    "["
    "\u00ad"  # soft hyphen
    "\u061c\u200e\u200f"  # bidirectional marks
    "\u202a-\u202e\u2066-\u2069"  # embeddings, overrides, isolates
    "\u115f\u1160\u17b4\u17b5\u180e\u200b\u2060-\u2065\u206a-\u206f\u3164\ufeff\uffa0\ufff9-\ufffb"  # zero width
    "\u2028\u2029"  # line breaks that few programs recognise
    "\U000e0000-\U000e007f"  # tags
    "]"
    # Joiners are legitimate only in the spelling of some scripts and in emoji.
    "|(?<![\u0300-\U0010ffff])[\u200c\u200d]|[\u200c\u200d](?![\u0300-\U0010ffff])"
)


def invisible_places(text: str) -> list[int]:
    """Indices of the invisible characters of a text."""
    return [match.start() for match in _INVISIBLE.finditer(text)]


def code_point(character: str) -> str:
    """Code point of a character, such as ``U+202E``."""
    return f"U+{ord(character):04X}"


def visible(text: str) -> str:
    """Text with invisible characters replaced by their code points."""
    return text if text.isascii() else _INVISIBLE.sub(lambda match: f"[{code_point(match[0])}]", text)


def visible_throughout(value: Any) -> Any:
    """Plain data with `visible` applied to every text and every key."""
    if isinstance(value, str):
        return visible(value)
    if isinstance(value, dict):
        return {visible_throughout(key): visible_throughout(each) for key, each in value.items()}
    if isinstance(value, (list, tuple)):
        return [visible_throughout(each) for each in value]
    return value
