"""Lexical elements of the textual notation: names, strings, documentation, bodies.

The notation is for readers; rgss does not import it. Characters that reorder or hide text are shown by
their code points.
"""

from __future__ import annotations

import re
from collections.abc import Iterable

from rgss.invisible_characters import visible

_INDENT = "    "
_BLANKS = re.compile(r"\s+")
_ESCAPES = {"\\": "\\\\", "'": "\\'", '"': '\\"', "\b": "\\b", "\f": "\\f", "\n": "\\n", "\r": "\\r", "\t": "\\t"}


def name(text: str) -> str:
    """A text as an unrestricted name, in single quotes, whatever it holds."""
    return "'" + "".join(_ESCAPES.get(each, each) if each != '"' else each for each in visible(text)) + "'"


def string(text: str) -> str:
    """A text as a string literal."""
    return '"' + "".join(_ESCAPES.get(each, each) if each != "'" else each for each in visible(text)) + '"'


def real(value: float) -> str:
    """A number as a literal that reads back as the same float."""
    if value < 0:
        return f"-{real(-value)}"
    text = repr(float(value))
    mantissa, exponent, power = text.partition("e")
    # The grammar requires digits after a point, and an exponent without a plus sign.
    return f"{mantissa if '.' in mantissa else mantissa + '.0'}{exponent}{power.replace('+', '')}"


def documentation(text: str) -> str:
    """A text as the documentation of its element; it cannot end the comment that contains it."""
    return f"doc {_remark(text)}"


def comment(about: str, text: str) -> str:
    """A text as a comment on another element, for elements that cannot contain documentation."""
    return f"comment about {name(about)} {_remark(text)}"


def declared(keyword: str, identity: str, called: str = "") -> str:
    """The head of a declaration: keyword, short name if it differs from the name, name."""
    return f"{keyword} <{name(identity)}> {name(called)}" if called else f"{keyword} {name(identity)}"


def body(head: str, lines: Iterable[str]) -> list[str]:
    """A declaration with its indented members; a semicolon if it has none."""
    inner = list(lines)
    return [f"{head} {{", *(_INDENT + line for line in inner), "}"] if inner else [f"{head};"]


def _remark(text: str) -> str:
    return f"/* {_BLANKS.sub(' ', visible(text)).strip().replace('*/', '* /')} */"
