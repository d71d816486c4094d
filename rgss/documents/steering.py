"""Detection and escaping of control characters: controls, escapes and bidirectional formatting.

They are legal but invisible in a text, and affect a terminal, a reviewer's page or a log viewer.
`rgss.findings.printable` replaces them in texts for people; here they are escaped in whole output documents, in the
notation of the document, so that a program that reads it gets the same text.
"""

from __future__ import annotations

import re
from collections.abc import Callable

# Controls except tab and end of line; bidirectional marks, embeddings, overrides and isolates; line and paragraph
# separators; invisible operators, annotations and tags; unpaired surrogates.
_STEERING = re.compile(
    "[\x00-\x08\x0b-\x1f\x7f-\x9f\u061c\u180e\u200e\u200f\u2028-\u202e\u2060-\u206f\ufff9-\ufffb"
    "\U000e0000-\U000e007f\ud800-\udfff]"
)


def has_control_characters(text: str) -> bool:
    """True if a text has a character that controls a terminal or the order of the displayed text."""
    return _STEERING.search(text) is not None


def escaped_for_json(text: str) -> str:
    r"""A JSON document, or a text for a terminal, with such characters as ``\uXXXX``."""
    return _escaped(text, _as_json)


def escaped_for_xml(text: str) -> str:
    """An XML document with such characters as references, as far as XML may have them."""
    return _escaped(text, lambda sign: f"&#x{ord(sign):x};")


def _escaped(text: str, write: Callable[[str], str]) -> str:
    return _STEERING.sub(lambda found: write(found[0]), text)


def _as_json(sign: str) -> str:
    units = sign.encode("utf-16-be", "surrogatepass")
    return "".join(f"\\u{units[at] << 8 | units[at + 1]:04x}" for at in range(0, len(units), 2))
