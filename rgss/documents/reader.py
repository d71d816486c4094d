"""A strict reading of YAML: plain data with the position of every key and value.

Only the part of YAML that cannot surprise is accepted. Tags, anchors, aliases and merge keys
are refused, so no document can build an object or grow when it is read; duplicate keys are
refused; ``yes``, ``on`` and ``1:30`` are texts, not truth values or sexagesimal numbers.
"""

from __future__ import annotations

import codecs
import math
import re
import stat
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import yaml

from rgss.errors import DocumentError
from rgss.findings import Finding, Severity, shown

LARGEST_FILE_BYTES = 8 * 1024 * 1024
DEEPEST_NESTING = 40

Location = tuple["str | int", ...]

# What YAML counts as printable and as one line break. A byte order mark may stand only at the start.
_NOT_PRINTABLE = re.compile(r"[^\t\n\r -~\x85\xa0-\ud7ff\ue000-\ufefe\uff00-\ufffd\U00010000-\U0010ffff]")
_LINE_BREAK = re.compile(r"\r\n|[\n\r\x85\u2028\u2029]")
_LONE_SURROGATE = re.compile(r"[\ud800-\udfff]")
_INTEGER = re.compile(r"[+-]?(0|[1-9][0-9]{0,17})")
_FLOAT = re.compile(
    r"[+-]?(((0|[1-9][0-9]*)\.[0-9]*|\.[0-9]+)([eE][+-]?[0-9]{1,3})?|(0|[1-9][0-9]*)[eE][+-]?[0-9]{1,3})"
)
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

    def nearest(self, location: Sequence[str | int]) -> Location:
        """The location of this document that is met on the way to another, passing over what it lacks."""
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
        DocumentError: The file is missing, too large, not UTF-8, not YAML, empty, or uses a
            part of YAML that is refused; with every such problem that could be found.
    """
    name = label if label is not None else str(path)
    return _Composer(name).compose(_read_text(path, name))


def _read_text(path: Path, label: str) -> str:
    try:
        if not stat.S_ISREG(path.stat().st_mode):
            raise DocumentError([_finding(label, "unreadable", "cannot be read: not a file")])
        with path.open("rb") as file:
            content = file.read(LARGEST_FILE_BYTES + 1)
    except FileNotFoundError:
        raise DocumentError([_finding(label, "missing", "no such file", hint="check the name and --project")]) from None
    except OSError as error:
        raise DocumentError([_finding(label, "unreadable", f"cannot be read: {error.strerror}")]) from None
    except ValueError:  # a name with a null character in it
        raise DocumentError([_finding(label, "missing", "not the name of a file")]) from None
    if len(content) > LARGEST_FILE_BYTES:
        limit = LARGEST_FILE_BYTES // (1024 * 1024)
        raise DocumentError([_finding(label, "size", f"is too large: at most {limit} MiB are read")])
    content = content.removeprefix(codecs.BOM_UTF8)
    try:
        return content.decode("utf-8")
    except UnicodeDecodeError as error:
        before = content[: error.start].decode("utf-8")
        finding = _finding(label, "encoding", "is not UTF-8", _end_of(before), hint="save the file as UTF-8")
        raise DocumentError([finding]) from None


def _finding(label: str, rule: str, message: str, position: tuple[int, int] = (1, 1), *, hint: str = "") -> Finding:
    line, column = position
    return Finding(
        file=label,
        line=line,
        column=column,
        rule=f"document.{rule}",
        severity=Severity.ERROR,
        message=message,
        hint=hint,
    )


def _end_of(text: str) -> tuple[int, int]:
    """Line and column of what follows a text."""
    breaks = [match.end() for match in _LINE_BREAK.finditer(text)]
    return len(breaks) + 1, len(text) - (breaks[-1] if breaks else 0) + 1


class _Composer:
    """Builds data and positions from parser events, no deeper than the nesting that is allowed."""

    def __init__(self, label: str) -> None:
        self._label = label
        self._values: dict[Location, tuple[int, int]] = {}
        self._keys: dict[Location, tuple[int, int]] = {}
        self._findings: list[Finding] = []
        self._end = (1, 1)

    def compose(self, text: str) -> Document:
        self._end = _end_of(text)
        loader = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
        data: Any = None
        unprintable = _NOT_PRINTABLE.search(text)
        if unprintable:
            character = f"U+{ord(unprintable[0]):04X}"
            place = _end_of(text[: unprintable.start()])
            self._report("character", f"the character {character} is not allowed", place, "remove it")
        else:
            try:
                data = self._compose_stream(iter(yaml.parse(text, Loader=loader)))
            except yaml.MarkedYAMLError as error:
                place = self._place(error.problem_mark or error.context_mark)
                problem = " ".join(str(part) for part in (error.context, error.problem) if part)
                self._report("syntax", f"not valid YAML: {problem}", place)
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
                    self._report("several", "a second document in one file", self._position(event), "remove the '---'")
                    return data
                data = self._compose_node(next(events), events, ())
        if data is None and not self._findings:
            self._report("empty", "the file is empty", (1, 1), "give it the keys that its kind of file has")
        return data

    def _compose_node(self, event: yaml.Event, events: Iterator[yaml.Event], location: Location) -> Any:
        self._values.setdefault(location, self._position(event))
        if len(location) > DEEPEST_NESTING:
            self._report("nesting", f"nested more than {DEEPEST_NESTING} deep", self._position(event))
            raise DocumentError(sorted(self._findings))
        if isinstance(event, yaml.AliasEvent):
            self._report("alias", f"alias *{event.anchor} is refused", self._position(event), "write the value out")
            return None
        self._refuse_extras(event)
        if isinstance(event, yaml.ScalarEvent):
            if _LONE_SURROGATE.search(event.value):
                self._report("character", "half a surrogate pair is no character", self._position(event), "remove it")
            return _resolve(event)
        if isinstance(event, yaml.SequenceStartEvent):
            return self._compose_sequence(events, location)
        return self._compose_mapping(events, location)

    def _refuse_extras(self, event: Any) -> None:
        if event.anchor is not None:
            self._report("alias", f"anchor &{event.anchor} is refused", self._position(event), "write the value out")
        if event.tag is not None:
            self._report("tag", f"tag {shown(event.tag)} is refused", self._position(event), "remove the tag")

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
            key = self._key(event, events, location)
            position = self._position(event)
            inner = (*location, key)
            if key in mapping:
                first, _ = self._keys[inner]
                self._report("duplicate-key", f"key {shown(key)} stands already in line {first}", position, "keep one")
            self._keys.setdefault(inner, position)
            value = self._compose_node(next(events), events, inner)
            mapping.setdefault(key, value)
        return mapping

    def _key(self, event: yaml.Event, events: Iterator[yaml.Event], location: Location) -> str:
        if isinstance(event, yaml.ScalarEvent):
            self._refuse_extras(event)
            if event.value == "<<" and not event.style:
                self._report("merge-key", "merge key << is refused", self._position(event), "write the keys out")
            return str(event.value)
        if not isinstance(event, yaml.AliasEvent):
            self._report("key", "a key must be a text", self._position(event), "write one word or a quoted text")
        stand_in = f"<key at {self._position(event)}>"
        self._compose_node(event, events, (*location, stand_in))
        return stand_in

    def _position(self, event: yaml.Event) -> tuple[int, int]:
        return self._place(event.start_mark)

    def _place(self, mark: Any) -> tuple[int, int]:
        # Where a file does not end with a line break, libyaml counts one more line than there is.
        return min((mark.line + 1, mark.column + 1), self._end)

    def _report(self, rule: str, message: str, position: tuple[int, int], hint: str = "") -> None:
        self._findings.append(_finding(self._label, rule, message, position, hint=hint))


def _resolve(event: yaml.ScalarEvent) -> str | int | float | bool | None:
    text: str = event.value
    if event.style:  # PyYAML's two parsers call the style of a plain scalar None and ""
        return text
    if text in _CONSTANTS:
        return _CONSTANTS[text]
    if _INTEGER.fullmatch(text):
        return int(text)
    if _FLOAT.fullmatch(text) and math.isfinite(float(text)):
        return float(text)
    return text
