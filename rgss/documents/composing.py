"""Composition of plain data with positions from the events of a YAML parser."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping
from typing import Any

import yaml
from yaml.events import (
    AliasEvent,
    DocumentStartEvent,
    Event,
    MappingEndEvent,
    MappingStartEvent,
    ScalarEvent,
    SequenceEndEvent,
    SequenceStartEvent,
    StreamEndEvent,
)

from rgss.documents.positions import ListPlaces, MappingPlaces, Mark, Places, Position, mark_of, position_of
from rgss.documents.refusals import MOST_PROBLEMS, cut_short, end_of, refusal
from rgss.documents.yaml_parsers import EMPTY_IN_FLOW, READ_ALIKE_NOT
from rgss.errors import DocumentError
from rgss.findings import Finding, shown

DEEPEST_NESTING = 40
MOST_VALUES = 500_000
"""Values of thirty thousand requirements, whose import takes some 0.6 GB of memory."""

# Printable characters of YAML. A byte order mark is allowed only at the start.
_NOT_PRINTABLE = re.compile(r"[^\t\n\r -~\x85\xa0-\ud7ff\ue000-\ufefe\uff00-\ufffd\U00010000-\U0010ffff]")
_SURROGATE = re.compile(r"[\ud800-\udfff]")
# JSON escapes a character beyond the basic plane as a pair.
_SURROGATE_PAIR = re.compile(r"[\ud800-\udbff][\udc00-\udfff]")
_INTEGER = re.compile(r"[+-]?(0|[1-9][0-9]{0,17})")
_FLOAT = re.compile(
    r"[+-]?(((0|[1-9][0-9]*)\.[0-9]*|\.[0-9]+)([eE][+-]?[0-9]{1,3})?|(0|[1-9][0-9]*)[eE][+-]?[0-9]{1,3})"
)
_DIRECTIVE = re.compile(r"(?:(?:[ \t]*(?:#[^\r\n]*)?|%YAML 1\.[12])[\r\n])*(?=%(?!YAML 1\.[12][\r\n]))")
"""Text before a rejected directive; a version known to both parsers is accepted."""

_NUMBER_START = frozenset("+-.0123456789")
_CONSTANTS: Mapping[str, bool | None] = {"": None, "~": None, "null": None, "true": True, "false": False}


class _ParsersDisagreeError(Exception):
    """libyaml accepts a document that PyYAML's own parser rejects, or locates a part differently."""


class Composer:
    """Builder of data and positions from parser events, within limits of nesting and size.

    The grammar is that of PyYAML's own parser. libyaml, if available, is ten times faster, but accepts more documents:
    a question mark within a plain scalar of a flow collection, and tabs between tokens; and it locates an omitted value
    of a flow mapping differently. Documents that it rejects, and those with one of these features, are read again by
    PyYAML's own parser, so that every machine accepts the same documents and reports the same findings at the same
    positions. Directives other than a version, on which the two parsers disagree, are rejected.
    """

    def __init__(self, text: str, label: str) -> None:
        """Composer of a text.

        Args:
            text: The text of a file.
            label: The file's name in messages.
        """
        self._text = text
        self._label = label
        self._findings: list[Finding] = []
        self._end: Position | None = None
        self._room = MOST_VALUES
        self._next: Callable[[], Any] = lambda: None
        self._flow = 0

    def compose(self) -> tuple[Any, Places]:
        """Read the whole text.

        Returns:
            Its data, and the position of each part.

        Raises:
            DocumentError: The text is not YAML, empty, or uses an unsupported part of YAML; with every problem found.
        """
        data: Any = None
        places: Places = mark_of(0, 0)
        unprintable = _NOT_PRINTABLE.search(self._text)
        if unprintable:
            character = f"U+{ord(unprintable[0]):04X}"
            place = end_of(self._text[: unprintable.start()])
            self._report("character", f"the character {character} is not allowed", place, "remove it")
        elif directive := _DIRECTIVE.match(self._text):
            self._report("directive", "a directive is refused", end_of(directive[0]), "remove the line with the '%'")
        else:
            try:
                data, places = self._compose_stream()
            except yaml.MarkedYAMLError as error:
                mark: Any = error.problem_mark or error.context_mark
                place = self._position(mark_of(mark.line, mark.column))
                problem = " ".join(str(part) for part in (error.context, error.problem) if part)
                hint = "indent with spaces, not tabs" if self._character_at(mark) == "\t" else ""
                self._report("syntax", f"not valid YAML: {problem}", place, hint)
        if self._findings:
            raise self._error()
        return data, places

    def _character_at(self, mark: Any) -> str:
        """Character at a position; empty at the end of a line."""
        lines = self._text.split("\n", mark.line + 1)
        return lines[mark.line][mark.column : mark.column + 1] if mark.line < len(lines) else ""

    def end(self) -> Position:
        """Line and column of the end of the text.

        For a file without a final line break libyaml counts one line too many.
        """
        if self._end is None:
            self._end = end_of(self._text)
        return self._end

    def _compose_stream(self) -> tuple[Any, Places]:
        fast = getattr(yaml, "CSafeLoader", None)
        if fast is not None and not READ_ALIKE_NOT.search(self._text):
            try:
                watched = "?" in self._text or EMPTY_IN_FLOW.search(self._text) is not None
                return self._compose_with(fast(self._text), watched=watched)
            except (yaml.MarkedYAMLError, _ParsersDisagreeError):
                self._findings.clear()
                self._room = MOST_VALUES
        return self._compose_with(yaml.SafeLoader(self._text), watched=False)

    def _compose_with(self, loader: Any, *, watched: bool) -> tuple[Any, Places]:
        self._flow = 0
        try:
            self._next = (lambda: self._watched(loader.get_event())) if watched else loader.get_event
            return self._compose_documents()
        except (ValueError, OverflowError):
            # PyYAML's own parser converts every escaped number to a character.
            raise yaml.MarkedYAMLError(
                problem="found an escaped number beyond the last character", problem_mark=loader.get_mark()
            ) from None
        finally:
            loader.dispose()

    def _watched(self, event: Any) -> Any:
        """Pass an event of libyaml on, unless the other parser would reject it or locate it differently.

        Raises:
            _ParsersDisagreeError: A plain scalar of a flow collection is empty or contains a question mark.
        """
        kind = type(event)
        if kind is ScalarEvent:
            if self._flow and not event.style and ("?" in event.value or not event.value):
                raise _ParsersDisagreeError
        elif kind is MappingStartEvent or kind is SequenceStartEvent:
            # Everything within a flow collection is in flow style.
            self._flow += bool(event.flow_style)
        elif self._flow and (kind is MappingEndEvent or kind is SequenceEndEvent):
            self._flow -= 1
        return event

    def _compose_documents(self) -> tuple[Any, Places]:
        data: Any = None
        places: Places = mark_of(0, 0)
        documents = 0
        event = self._next()
        while not isinstance(event, StreamEndEvent):
            if isinstance(event, DocumentStartEvent):
                documents += 1
                if documents > 1:
                    self._report("several", "a second document in one file", self._at(event), "remove the '---'")
                    return data, places
                data, places = self._compose_node(self._next(), 0)
            event = self._next()
        if data is None and not self._findings:
            self._report("empty", "the file is empty", (1, 1), "give it the keys that its kind of file has")
        return data, places

    def _compose_node(self, event: Any, depth: int) -> tuple[Any, Places]:
        start = event.start_mark
        mark = mark_of(start.line, start.column)
        if depth > DEEPEST_NESTING:
            self._report("nesting", f"nested more than {DEEPEST_NESTING} deep", self._at(event))
            raise self._error()
        self._room -= 1
        if self._room < 0:
            hint = "divide it into several files"
            self._report("values", f"holds more than {MOST_VALUES} values", self._at(event), hint)
            raise self._error()
        if isinstance(event, AliasEvent):
            self._report("alias", f"alias *{event.anchor} is refused", self._at(event), "write the value out")
            return None, mark
        if event.anchor is not None or event.tag is not None:
            self._refuse_extras(event)
        if isinstance(event, ScalarEvent):
            return _resolve(self._text_of(event), event.style), mark
        if isinstance(event, SequenceStartEvent):
            return self._compose_sequence(mark, depth)
        return self._compose_mapping(mark, depth)

    def _text_of(self, event: ScalarEvent) -> str:
        text = str(event.value)
        if event.style == '"' and _SURROGATE.search(text):
            text = _SURROGATE_PAIR.sub(lambda pair: pair[0].encode("utf-16", "surrogatepass").decode("utf-16"), text)
            if _SURROGATE.search(text):
                self._report("character", "half a surrogate pair is not a character", self._at(event), "remove it")
        return text

    def _refuse_extras(self, event: Any) -> None:
        if event.anchor is not None:
            self._report("alias", f"anchor &{event.anchor} is refused", self._at(event), "write the value out")
        if event.tag is not None:
            self._report("tag", f"tag {shown(event.tag)} is refused", self._at(event), "remove the tag")

    def _compose_sequence(self, mark: Mark, depth: int) -> tuple[Any, Places]:
        items: list[Any] = []
        inner: list[Places] = []
        while type(event := self._next()) is not SequenceEndEvent:
            item, place = self._compose_node(event, depth + 1)
            items.append(item)
            inner.append(place)
        return items, ListPlaces(mark, inner)

    def _compose_mapping(self, mark: Mark, depth: int) -> tuple[Any, Places]:
        mapping: dict[str, Any] = {}
        keys: dict[str, Mark] = {}
        inner: dict[str, Places] = {}
        while type(event := self._next()) is not MappingEndEvent:
            key = event.value if _is_plain(event) and event.value != "<<" else self._key(event, depth)
            if key in mapping:
                first, _ = self._position(keys[key])
                message = f"key {shown(key)} is already in line {first}"
                self._report("duplicate-key", message, self._at(event), "keep one")
            value_event = self._next()
            place: Places
            if _is_plain(value_event) and self._room > 0 and depth < DEEPEST_NESTING:
                # Fast path for the most frequent case.
                self._room -= 1
                start = value_event.start_mark
                value, place = _resolve(value_event.value, value_event.style), mark_of(start.line, start.column)
            else:
                value, place = self._compose_node(value_event, depth + 1)
            if key not in mapping:
                start = event.start_mark
                mapping[key], keys[key], inner[key] = value, mark_of(start.line, start.column), place
        return mapping, MappingPlaces(mark, keys, inner)

    def _key(self, event: Any, depth: int) -> str:
        if isinstance(event, ScalarEvent):
            self._refuse_extras(event)
            if event.value == "<<" and not event.style:
                self._report("merge-key", "merge key << is refused", self._at(event), "write the keys out")
            return self._text_of(event)
        if not isinstance(event, AliasEvent):
            self._report("key", "a key must be a text", self._at(event), "write one word or a quoted text")
        stand_in = f"<key at {self._at(event)}>"
        self._compose_node(event, depth + 1)
        return stand_in

    def _at(self, event: Event) -> Position:
        start: Any = event.start_mark
        return self._position(mark_of(start.line, start.column))

    def _position(self, mark: Mark) -> Position:
        return min(position_of(mark), self.end())

    def _report(self, rule: str, message: str, position: Position, hint: str = "") -> None:
        self._findings.append(refusal(self._label, rule, message, position, hint=hint))
        if len(self._findings) > MOST_PROBLEMS:
            raise self._error()

    def _error(self) -> DocumentError:
        return DocumentError(cut_short(self._label, self._findings))


def _is_plain(event: Any) -> bool:
    """True for a scalar without a tag, an anchor or an escape, which can be rejected only for its position."""
    return type(event) is ScalarEvent and event.style != '"' and event.anchor is None and event.tag is None


def _resolve(text: str, style: str | None) -> str | int | float | bool | None:
    if style:  # PyYAML's two parsers call the style of a plain scalar None and ""
        return text
    if text in _CONSTANTS:
        return _CONSTANTS[text]
    if text[0] not in _NUMBER_START:
        return text
    if _INTEGER.fullmatch(text):
        return int(text)
    if _FLOAT.fullmatch(text) and math.isfinite(float(text)):
        return float(text)
    return text
