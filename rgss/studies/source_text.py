"""Invisible characters in a project's sources, each with its place."""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from rgss.documents import DATA_FOLDERS, LARGEST_FILE_BYTES, chunks_of, cut_short, read_document
from rgss.errors import DocumentError
from rgss.findings import Finding, Severity
from rgss.invisible_characters import code_point, invisible_places

_TEXTS = frozenset({".yaml", ".yml", ".urdf", ".xacro"})
_BREAKS = re.compile(r"\r\n|[\n\r\x85]")
# How YAML and XML write a character by its number.
_ESCAPE = re.compile(
    r"\\x(?P<x>[0-9a-fA-F]{2})|\\u(?P<u>[0-9a-fA-F]{4})|\\U(?P<U>[0-9a-fA-F]{8})|"
    r"&#x(?P<hex>[0-9a-fA-F]{1,6});|&#(?P<dec>[0-9]{1,7});|\\(?P<name>[LP])"
)
_NAMED = {"L": "\u2028", "P": "\u2029"}


def invisible_findings(project: Path) -> tuple[Finding, ...]:
    """Characters in the sources of a project that reorder or hide text, in files that are small enough to read."""
    findings: list[Finding] = []
    for folder in DATA_FOLDERS:
        for path in sorted(path for path in (project / folder).rglob("*") if path.suffix.lower() in _TEXTS):
            findings += cut_short(path.relative_to(project).as_posix(), list(_of_file(path, project)))
    return tuple(findings)


def _of_file(path: Path, project: Path) -> Iterator[Finding]:
    label = path.relative_to(project).as_posix()
    try:
        text = b"".join(chunks_of(path, largest=LARGEST_FILE_BYTES)).decode("utf-8-sig")
    except (OSError, UnicodeDecodeError):
        return  # reported where the file is needed
    found = [(place, text[place]) for place in invisible_places(text)]
    found += _escaped(path, label, text)
    if not found:
        return
    starts = [0, *(match.end() for match in _BREAKS.finditer(text))]
    for place, character in sorted(found):
        line = bisect_right(starts, place)
        yield Finding(
            file=label,
            line=line,
            column=place - starts[line - 1] + 1,
            rule="document.invisible",
            severity=Severity.WARNING,
            message=f"has the invisible character {code_point(character)}, so the text may read otherwise than it is",
            hint="remove it",
        )


def _escaped(path: Path, label: str, text: str) -> list[tuple[int, str]]:
    """Invisible characters that are written by their numbers."""
    found = []
    for match in _ESCAPE.finditer(text):
        digits = match["x"] or match["u"] or match["U"] or match["hex"]
        number = int(digits, 16) if digits else int(match["dec"] or 0)
        character = _NAMED[match["name"]] if match["name"] else chr(number) if number < 0x110000 else ""
        if character and invisible_places(character):
            found.append((match.start(), character))
    if not found or path.suffix.lower() not in (".yaml", ".yml"):
        return found
    try:
        held = set("".join(_texts(read_document(path, label=label).data)))
    except DocumentError:
        return []
    # Only within double quotes an escape is one.
    return [(place, character) for place, character in found if character in held and text[place] == "\\"]


def _texts(value: Any) -> Iterator[str]:
    if isinstance(value, str):
        yield value
    elif isinstance(value, dict):
        for key, each in value.items():
            yield from _texts(key)
            yield from _texts(each)
    elif isinstance(value, list):
        for each in value:
            yield from _texts(each)
