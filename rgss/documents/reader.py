"""A strict reading of YAML: plain data with the position of every key and value.

Only the part of YAML that cannot surprise is accepted. Tags, anchors, aliases and merge keys
are refused, so no document can build an object or grow when it is read; duplicate keys are
refused; ``yes``, ``on`` and ``1:30`` are texts, not truth values or sexagesimal numbers.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import yaml

from rgss.errors import DocumentError
from rgss.findings import Finding, Severity

LARGEST_FILE_BYTES = 8 * 1024 * 1024
DEEPEST_NESTING = 40

Location = tuple["str | int", ...]

_INTEGER = re.compile(r"[+-]?(0|[1-9][0-9]{0,17})")
_FLOAT = re.compile(r"[+-]?([0-9]+\.[0-9]*|\.[0-9]+|[0-9]+)([eE][+-]?[0-9]{1,3})?")
_CONSTANTS: Mapping[str, bool | None] = {"": None, "~": None, "null": None, "true": True, "false": False}


@dataclass(frozen=True, slots=True, kw_only=True)
class Document:
    """A YAML file as plain data, with where each part of it stands.

    Attributes:
        label: The file's name in messages, relative to the project.
        data: Mappings, lists, texts, numbers, truth values and None.
        values: Position (line, column; from 1) of the value at each location.
        keys: Position of the key at each location within a mapping.
    """

    label: str
    data: Any
    values: Mapping[Location, tuple[int, int]]
    keys: Mapping[Location, tuple[int, int]]

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
        """A finding at a location of this document, or at the nearest part around it.

        Args:
            rule: The id of the broken rule.
            message: What is wrong.
            location: Keys and indices from the top, such as ``("bodies", 2, "mass")``; parts
                that the document does not have are passed over.
            hint: How to mend it.
            severity: How much it matters.
            at_key: Point at the key instead of its value.
        """
        found: Location = ()
        for part in location:
            if (*found, part) in self.values:
                found = (*found, part)
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
        DocumentError: The file is missing, too large, not UTF-8, not YAML, empty, or uses a
            part of YAML that is refused; with every such problem that could be found.
    """
    name = label if label is not None else str(path)
    return _Composer(name).compose(_read_text(path, name))


def _read_text(path: Path, label: str) -> str:
    try:
        size = path.stat().st_size
        if size > LARGEST_FILE_BYTES:
            limit = LARGEST_FILE_BYTES // (1024 * 1024)
            raise DocumentError([_at_start(label, "size", f"is {size} bytes; at most {limit} MiB are read")])
        return path.read_text(encoding="utf-8-sig")
    except FileNotFoundError:
        raise DocumentError([_at_start(label, "missing", "no such file", hint="check the name and --project")]) from None
    except UnicodeDecodeError as error:
        raise DocumentError([_at_start(label, "encoding", f"is not UTF-8 at byte {error.start}")]) from None
    except OSError as error:
        raise DocumentError([_at_start(label, "unreadable", f"cannot be read: {error.strerror}")]) from None


def _at_start(label: str, rule: str, message: str, *, hint: str = "") -> Finding:
    return Finding(
        file=label, line=1, column=1, rule=f"document.{rule}", severity=Severity.ERROR, message=message, hint=hint
    )


class _Composer:
    """Builds data and positions from parser events, without recursion on the input's depth."""

    def __init__(self, label: str) -> None:
        self._label = label
        self._values: dict[Location, tuple[int, int]] = {}
        self._keys: dict[Location, tuple[int, int]] = {}
        self._findings: list[Finding] = []

    def compose(self, text: str) -> Document:
        loader = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
        try:
            events = iter(yaml.parse(text, Loader=loader))
            data = self._compose_stream(events)
        except yaml.MarkedYAMLError as error:
            mark = error.problem_mark or error.context_mark
            position = (mark.line + 1, mark.column + 1) if mark else (1, 1)
            problem = " ".join(str(part) for part in (error.context, error.problem) if part)
            self._report("syntax", f"not valid YAML: {problem}", position)
        except yaml.reader.ReaderError as error:
            line = text.count("\n", 0, error.position) + 1
            column = error.position - (text.rfind("\n", 0, error.position) + 1) + 1
            self._report("syntax", f"a character that YAML does not allow: {error.character!r}", (line, column))
        if self._findings:
            raise DocumentError(sorted(self._findings))
        return Document(label=self._label, data=data, values=self._values, keys=self._keys)

    def _compose_stream(self, events: Iterator[yaml.Event]) -> Any:
        data: Any = None
        documents = 0
        for event in events:
            if isinstance(event, yaml.DocumentStartEvent):
                documents += 1
                if documents > 1:
                    self._report("several", "a second document in one file", _position(event), "remove the '---'")
                    return data
                data = self._compose_node(next(events), events, ())
        if documents == 0 or data is None:
            self._report("empty", "the file is empty", (1, 1), "give it the keys that its kind of file has")
        return data

    def _compose_node(self, event: yaml.Event, events: Iterator[yaml.Event], location: Location) -> Any:
        self._values[location] = _position(event)
        if len(location) > DEEPEST_NESTING:
            self._report("nesting", f"nested more than {DEEPEST_NESTING} deep", _position(event))
            raise DocumentError(sorted(self._findings))
        if isinstance(event, yaml.AliasEvent):
            self._report("alias", f"alias *{event.anchor} is refused", _position(event), "write the value out")
            return None
        self._refuse_extras(event)
        if isinstance(event, yaml.ScalarEvent):
            return _resolve(event)
        if isinstance(event, yaml.SequenceStartEvent):
            return self._compose_sequence(events, location)
        return self._compose_mapping(events, location)

    def _refuse_extras(self, event: yaml.Event) -> None:
        if getattr(event, "anchor", None):
            self._report("alias", f"anchor &{event.anchor} is refused", _position(event), "write the value out")
        if getattr(event, "tag", None) not in (None, "!"):
            self._report("tag", f"tag {event.tag} is refused", _position(event), "remove the tag")

    def _compose_sequence(self, events: Iterator[yaml.Event], location: Location) -> list[Any]:
        items: list[Any] = []
        for event in events:
            if isinstance(event, yaml.SequenceEndEvent):
                break
            items.append(self._compose_node(event, events, (*location, len(items))))
        return items

    def _compose_mapping(self, events: Iterator[yaml.Event], location: Location) -> dict[str, Any]:
        mapping: dict[str, Any] = {}
        for event in events:
            if isinstance(event, yaml.MappingEndEvent):
                break
            key = self._key(event, events)
            position = _position(event)
            if key in mapping:
                first = self._keys[(*location, key)]
                self._report("duplicate-key", f"key {key!r} stands already in line {first[0]}", position, "keep one")
            self._keys.setdefault((*location, key), position)
            value = self._compose_node(next(events), events, (*location, key))
            mapping.setdefault(key, value)
        return mapping

    def _key(self, event: yaml.Event, events: Iterator[yaml.Event]) -> str:
        self._refuse_extras(event)
        if isinstance(event, yaml.ScalarEvent):
            if event.value == "<<" and event.style is None:
                self._report("merge-key", "merge key << is refused", _position(event), "write the keys out")
            return str(event.value)
        self._report("key", "a key must be a plain text", _position(event))
        if not isinstance(event, yaml.AliasEvent):
            self._compose_node(event, events, ("<key>",) * 2)
        return f"<key at {_position(event)}>"

    def _report(self, rule: str, message: str, position: tuple[int, int], hint: str = "") -> None:
        self._findings.append(
            Finding(
                file=self._label,
                line=position[0],
                column=position[1],
                rule=f"document.{rule}",
                severity=Severity.ERROR,
                message=message,
                hint=hint,
            )
        )


def _position(event: yaml.Event) -> tuple[int, int]:
    return event.start_mark.line + 1, event.start_mark.column + 1


def _resolve(event: yaml.ScalarEvent) -> str | int | float | bool | None:
    text: str = event.value
    if event.style is not None:
        return text
    if text in _CONSTANTS:
        return _CONSTANTS[text]
    if _INTEGER.fullmatch(text):
        return int(text)
    if _FLOAT.fullmatch(text):
        return float(text)
    return text
