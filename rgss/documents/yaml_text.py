"""Writer of plain data as YAML, readable by `rgss.documents`."""

from __future__ import annotations

import json
import re
import textwrap
from typing import Any

WIDEST_LINE = 98

_CONSTANTS = frozenset({"", "~", "null", "true", "false", "yes", "no", "on", "off", "y", "n"})
_NOT_RAW = re.compile(r"[^ -~\xa0-\u2027\u202a-\ud7ff\ue000-\ufefe\uff00-\ufffd\U00010000-\U0010ffff]")
_FLOW_SIGNS = frozenset("?,[]{}:")


def value_lines(value: Any, indent: int, used: int = 0) -> list[str]:
    """Text of the value of a key of a block mapping.

    Args:
        value: Texts, numbers, truth values, None, lists and mappings of these.
        indent: The column of the key.
        used: Occupied characters of the key's line.

    Returns:
        The text after the colon, which may be empty; then whole lines.
    """
    inline = inline_text(value)
    fits = used + 1 + len(inline) <= WIDEST_LINE
    if isinstance(value, dict):
        return ["", *_mapping_lines(value, indent + 2)] if value else [inline]
    if isinstance(value, (list, tuple)):
        plain = all(not isinstance(item, (dict, list, tuple)) for item in value)
        return [inline] if not value or (plain and fits) else ["", *_list_lines(value, indent + 2)]
    if isinstance(value, str):
        if _is_plain(value) and fits:
            return [value]
        if not fits and _folds(value):
            width = max(WIDEST_LINE - indent - 2, 40)
            lines = textwrap.wrap(value, width, break_long_words=False, break_on_hyphens=False)
            return [">-", *(" " * (indent + 2) + line for line in lines)]
    return [inline]


def entry_lines(entry: Any, indent: int) -> list[str]:
    """Text of an entry of a block list, as whole lines.

    Args:
        entry: The entry.
        indent: The column of the dash.
    """
    if not isinstance(entry, dict) or not entry:
        return [f"{' ' * indent}- {inline_text(entry)}"]
    lines = _mapping_lines(entry, indent + 2)
    return [f"{' ' * indent}- {lines[0].lstrip(' ')}", *lines[1:]]


def inline_text(value: Any) -> str:
    """Text of a value on one line, in flow style."""
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key}: {inline_text(inner)}" for key, inner in value.items()) + "}"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(inline_text(inner) for inner in value) + "]"
    if isinstance(value, str):
        return value if _is_plain(value) and _FLOW_SIGNS.isdisjoint(value) else _quoted(value)
    return json.dumps(value, allow_nan=False)


def _mapping_lines(mapping: dict[str, Any], indent: int) -> list[str]:
    lines: list[str] = []
    for key, value in mapping.items():
        head = f"{' ' * indent}{key}:"
        first, *rest = value_lines(value, indent, len(head))
        lines += [f"{head} {first}" if first else head, *rest]
    return lines


def _list_lines(items: list[Any] | tuple[Any, ...], indent: int) -> list[str]:
    lines: list[str] = []
    for item in items:
        short = f"{' ' * indent}- {inline_text(item)}"
        flat = isinstance(item, dict) and all(not isinstance(inner, (dict, list)) for inner in item.values())
        lines += [short] if flat and len(short) <= WIDEST_LINE else entry_lines(item, indent)
    return lines


def _is_plain(text: str) -> bool:
    """True if a text needs no quotes, for this and other YAML readers."""
    if text.lower() in _CONSTANTS or not text.isprintable() or not text[0].isalnum() or text != text.strip():
        return False
    if ": " in text or " #" in text or text.endswith(":"):
        return False
    # A leading digit may be that of a number, a date or a time; a unit after it makes it a text for all readers.
    return not text[0].isdigit() or re.fullmatch(r"[0-9]+(\.[0-9]+)? [A-Za-z%°µ].*", text) is not None


def _folds(text: str) -> bool:
    """True if a text is unchanged by folding at its blanks and unfolding."""
    return text.isprintable() and text == text.strip() and "  " not in text


def _quoted(text: str) -> str:
    return _NOT_RAW.sub(_escape, json.dumps(text, ensure_ascii=False))


def _escape(match: re.Match[str]) -> str:
    return f"\\u{ord(match[0]):04x}"
