"""Strict reader of YAML: plain data with the position of every key and value.

Only an unambiguous subset of YAML is accepted. Tags, anchors, aliases and merge keys are rejected, so that no document
can construct an object or expand when it is read; duplicate keys are rejected; ``yes``, ``on`` and ``1:30`` are texts,
not truth values or sexagesimal numbers.
"""

from __future__ import annotations

import codecs
import stat
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import lru_cache
from pathlib import Path
from typing import Any

from rgss.documents.composing import Composer
from rgss.documents.positions import KeyPositions, Location, Position, ValuePositions
from rgss.documents.refusals import end_of, refusal
from rgss.errors import DocumentError
from rgss.findings import Finding, Severity

LARGEST_FILE_BYTES = 16 * 1024 * 1024

_LONGEST_KEPT = 256 * 1024
"""Characters of a text up to which its document is kept for the next time."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Document:
    """YAML file as plain data, with the position of each part.

    Attributes:
        label: The file's name in messages, relative to the project.
        data: Mappings, lists, texts, numbers, truth values and None; shared by all who read the same text, so never
        changed.
        values: Position (line, column; from 1) of the value at each location.
        keys: Position of the key at each location within a mapping.
        text: The text that all of this was read from, without a byte order mark.
    """

    label: str
    data: Any = field(compare=False)
    values: Mapping[Location, Position] = field(compare=False)
    keys: Mapping[Location, Position] = field(compare=False)
    text: str = field(default="", repr=False)

    def nearest(self, location: Sequence[str | int]) -> Location:
        """Nearest enclosing location that exists in this document."""
        found: Location = ()
        for part in location:
            if (*found, part) in self.values:
                found = (*found, part)
        return found

    def finding(
        self,
        rule: str,
        message: str,
        location: Sequence[str | int] = (),
        *,
        hint: str = "",
        severity: Severity = Severity.ERROR,
        at_key: bool = False,
    ) -> Finding:
        """Finding at a location of this document, or at the nearest enclosing part.

        Args:
            rule: The id of the violated rule.
            message: The problem.
            location: Keys and indices from the top, such as ``("bodies", 2, "mass")``; missing parts are skipped.
            hint: Advice.
            severity: Its severity.
            at_key: True to point at the key instead of its value.
        """
        found = self.nearest(location)
        line, column = self.keys.get(found, self.values[found]) if at_key else self.values[found]
        return Finding(
            file=self.label, line=line, column=column, rule=rule, severity=severity, message=message, hint=hint
        )


def read_document(path: Path, *, label: str | None = None) -> Document:
    """Read one YAML file strictly.

    Args:
        path: The file.
        label: Its name in messages; the path itself by default.

    Raises:
        DocumentError: The file is missing, too large, not UTF-8, not YAML, empty, or uses an unsupported part of YAML;
        with every problem found.
    """
    name = label if label is not None else str(path)
    text = _read_text(path, name)
    return _document(text, name) if len(text) <= _LONGEST_KEPT else _document.__wrapped__(text, name)


@lru_cache(maxsize=128)
def _document(text: str, name: str) -> Document:
    """Document of a text; several studies of one project share most files, and a verb may read them more than once."""
    composer = Composer(text, name)
    data, places = composer.compose()
    return Document(
        label=name,
        data=data,
        values=ValuePositions(places, composer.end),
        keys=KeyPositions(places, composer.end),
        text=text,
    )


def _read_text(path: Path, label: str) -> str:
    try:
        if not stat.S_ISREG(path.stat().st_mode):
            raise DocumentError([refusal(label, "unreadable", "cannot be read: not a file")])
        with path.open("rb") as file:
            content = file.read(LARGEST_FILE_BYTES + 1)
    except FileNotFoundError:
        raise DocumentError([refusal(label, "missing", "no such file", hint="check the name and --project")]) from None
    except OSError as error:
        raise DocumentError([refusal(label, "unreadable", f"cannot be read: {error.strerror}")]) from None
    except ValueError:  # a name with a null character in it
        raise DocumentError([refusal(label, "missing", "not the name of a file")]) from None
    if len(content) > LARGEST_FILE_BYTES:
        limit = LARGEST_FILE_BYTES // (1024 * 1024)
        raise DocumentError([refusal(label, "size", f"is too large: at most {limit} MiB are read")])
    content = content.removeprefix(codecs.BOM_UTF8)
    try:
        return content.decode("utf-8")
    except UnicodeDecodeError as error:
        before = content[: error.start].decode("utf-8")
        finding = refusal(label, "encoding", "is not UTF-8", end_of(before), hint="save the file as UTF-8")
        raise DocumentError([finding]) from None
