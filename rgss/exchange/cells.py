"""Conversion between entries of YAML files and text cells, one for each attribute."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from typing import Any

from rgss.documents import canonical_json
from rgss.exchange.attributes import ATTRIBUTES, Attribute, Form, Part

_DIVIDER = re.compile(r"(?<!\\)((?:\\\\)*);")

Cells = Mapping[str, str]
"""The attributes of an element by name, each as one text; empty if it is open."""


class CellError(ValueError):
    """A text does not have the form of its attribute."""


def cells_of(part: Part, entry: Mapping[str, Any]) -> dict[str, str]:
    """Every attribute of an entry as one text."""
    return {attribute.name: _cell(attribute, _at(entry, attribute.path)) for attribute in ATTRIBUTES[part]}


def entry_of(part: Part, cells: Cells) -> dict[str, Any]:
    """Entry from the texts of its attributes; empty ones are omitted.

    Raises:
        CellError: A text does not have the form of its attribute.
    """
    entry: dict[str, Any] = {}
    for attribute in ATTRIBUTES[part]:
        value = _value(attribute, cells.get(attribute.name, ""))
        if value is None:
            continue
        inner = entry
        for key in attribute.path[:-1]:
            inner = inner.setdefault(key, {})
        inner[attribute.path[-1]] = value
    return entry


def ids_in(cell: str) -> tuple[str, ...]:
    """The ids of a cell, each once."""
    return tuple(dict.fromkeys(_divided(cell)))


def joined(ids: list[str]) -> str:
    """Ids as one cell."""
    return "; ".join(ids)


def _at(entry: Mapping[str, Any], path: tuple[str, ...]) -> Any:
    found: Any = entry
    for key in path:
        found = found.get(key) if isinstance(found, Mapping) else None
    return found


def _cell(attribute: Attribute, value: Any) -> str:
    if value is None or value is False or value == []:
        return ""
    if attribute.form is Form.LINKS:
        return joined(list(dict.fromkeys(value)))
    if attribute.form is Form.EXEMPTIONS:
        return "; ".join(f"{item['rule']}: {_escaped(item['reason'])}" for item in value)
    if attribute.form in (Form.DETAIL, Form.DETAILS):
        return canonical_json(value)
    return "true" if value is True else str(value)


def _value(attribute: Attribute, cell: str) -> Any:
    text = cell.strip()
    if not text:
        return None
    if attribute.form is Form.LINKS:
        return list(ids_in(text))
    if attribute.form is Form.EXEMPTIONS:
        return [_exemption(item) for item in _divided(text)]
    if attribute.form is Form.DETAIL:
        return _json(text, dict, "a JSON object is expected")
    if attribute.form is Form.DETAILS:
        return _json(text, list, "a JSON list is expected")
    if attribute.form is Form.FLAG:
        if text.lower() not in ("true", "false"):
            raise CellError("true or false is expected")
        return True if text.lower() == "true" else None
    if attribute.form is Form.CHOICE:
        # Other tools capitalise such words, or write them in capitals.
        folded = text.lower()
        return folded if folded in attribute.choices else text
    return text


def _json(text: str, kind: type, expected: str) -> Any:
    try:
        value = json.loads(text)
    except (ValueError, RecursionError):
        raise CellError("JSON is expected") from None
    if not isinstance(value, kind):
        raise CellError(expected)
    return value


def _exemption(text: str) -> dict[str, str]:
    rule, colon, reason = text.partition(": ")
    if not colon or not reason.strip():
        raise CellError("each entry is 'rule: reason'")
    return {"rule": rule.strip(), "reason": reason.strip()}


def _escaped(text: str) -> str:
    return text.replace("\\", "\\\\").replace(";", "\\;")


def _divided(text: str) -> list[str]:
    """The parts between semicolons without a preceding backslash."""
    parts = _DIVIDER.sub("\\1\x00", text).split("\x00")
    plain = [re.sub(r"\\([\\;])", r"\1", part).strip() for part in parts]
    return [part for part in plain if part]
