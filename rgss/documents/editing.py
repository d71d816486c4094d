"""Edits of a YAML file that preserve the rest of its text and its comments."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from yaml.nodes import MappingNode, Node, ScalarNode, SequenceNode

from rgss.documents.positions import Location
from rgss.documents.yaml_parsers import composed
from rgss.documents.yaml_text import entry_lines, inline_text, value_lines
from rgss.errors import DefinitionError


@dataclass(frozen=True, slots=True, kw_only=True)
class SetKey:
    """Edit: set a new or existing key of a mapping.

    Attributes:
        location: The mapping.
        key: The key.
        value: Its value.
        before: Keys after which a new key is inserted, if the mapping has them.
    """

    location: Location
    key: str
    value: Any
    before: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class RemoveKey:
    """Edit: remove a key with its value from a mapping."""

    location: Location
    key: str


@dataclass(frozen=True, slots=True, kw_only=True)
class AppendEntry:
    """Edit: append an entry to a new or existing list of the file's top mapping."""

    key: str
    entry: Any


@dataclass(frozen=True, slots=True, kw_only=True)
class RemoveEntry:
    """Edit: remove an entry from a list."""

    location: Location
    index: int


Edit = SetKey | RemoveKey | AppendEntry | RemoveEntry


@dataclass(frozen=True, slots=True)
class _Splice:
    start: int
    end: int
    text: str


def edited(text: str, edits: Sequence[Edit]) -> str:
    """Text of a YAML file after edits.

    Comments are preserved, except those within a replaced or removed value.

    Args:
        text: The text of a valid file, without a byte order mark.
        edits: The edits, at distinct locations.

    Raises:
        DefinitionError: A location is not in the file.
    """
    editor = _Editor(text, edits)
    splices = sorted((*map(editor.splice, edits), *editor.emptied()), key=lambda splice: (splice.start, splice.end))
    parts, done = [], 0
    for splice in splices:
        if splice.start < done:
            raise DefinitionError("the edits of a file must not overlap", hint="apply them in sequence")
        parts += [text[done : splice.start], splice.text]
        done = splice.end
    return "".join([*parts, text[done:]])


_COMMENT = re.compile(r"(?:[ \t]*\r?\n)*([ \t]*)#[^\r\n]*(?:\r?\n|\Z)")
"""A line with a comment alone, and the empty lines before it."""


class _Editor:
    def __init__(self, text: str, edits: Sequence[Edit]) -> None:
        self._text = text
        self._removed: dict[Location, set[int]] = {}
        for edit in edits:
            if isinstance(edit, RemoveEntry):
                self._removed.setdefault(edit.location, set()).add(edit.index)
        self._appended = {(edit.key,) for edit in edits if isinstance(edit, AppendEntry)}
        root = composed(text)
        if root is None:
            raise _missing(())
        self._root: Node = root
        self._begun: set[str] = set()
        self._newline = "\r\n" if "\r\n" in text else "\n"

    def splice(self, edit: Edit) -> _Splice:
        if isinstance(edit, AppendEntry):
            return self._append(edit)
        around = self._at(edit.location)
        if isinstance(edit, RemoveEntry):
            return self._remove_entry(around, edit)
        if not isinstance(around, MappingNode):
            raise _missing(edit.location)
        keys = [key.value for key, _ in around.value]
        if isinstance(edit, RemoveKey):
            return self._remove_key(around, keys.index(edit.key))
        if edit.key in keys:
            return self._replace(around, keys.index(edit.key), edit.value)
        behind = max((index for index, key in enumerate(keys) if key in edit.before), default=len(keys) - 1)
        return self._insert(around, behind, edit)

    def emptied(self) -> Iterator[_Splice]:
        """Empty lists in place of lists whose entries are all removed; the key alone would mean null."""
        for location, removed in self._removed.items():
            node = self._at(location)
            if not isinstance(node, SequenceNode) or node.flow_style or location in self._appended:
                continue
            around = self._at(location[:-1])
            if len(removed) == len(node.value) and isinstance(around, MappingNode):
                key = next(key for key, value in around.value if value is node)
                colon = self._text.index(":", key.end_mark.index) + 1
                yield _Splice(colon, colon, " []")

    def _at(self, location: Location) -> Node:
        node = self._root
        for part in location:
            found: Node | None = None
            if isinstance(node, MappingNode):
                found = next((value for key, value in node.value if key.value == part), None)
            elif isinstance(node, SequenceNode) and isinstance(part, int) and part < len(node.value):
                found = node.value[part]
            if found is None:
                raise _missing(location)
            node = found
        return node

    def _end(self, node: Node) -> int:
        """End of the last character of a node; the parser's end mark may be after comments."""
        if isinstance(node, ScalarNode):
            start, end = node.start_mark.index, node.end_mark.index
            return start + len(self._text[start:end].rstrip()) if node.style in ("|", ">") else end
        if not isinstance(node, (MappingNode, SequenceNode)) or node.flow_style or not node.value:
            return node.end_mark.index
        last = node.value[-1]
        return self._end(last[1] if isinstance(node, MappingNode) else last)

    def _line_end(self, index: int) -> int:
        """End of the line of an index, before its line break."""
        found = re.compile(r"\r?\n|\Z").search(self._text, index)
        return len(self._text) if found is None else found.start()

    def _next_line(self, index: int) -> int:
        end = self._text.find("\n", index)
        return len(self._text) if end < 0 else end + 1

    def _line_start(self, index: int) -> int:
        return self._text.rfind("\n", 0, index) + 1

    def _joined(self, lines: Sequence[str]) -> str:
        return self._newline.join(lines)

    def _replace(self, around: MappingNode, index: int, value: Any) -> _Splice:
        key, old = around.value[index]
        start, end = old.start_mark.index, self._end(old)
        if around.flow_style:
            # Without a blank an omitted value would become a part of the key.
            gap = " " if self._text[:start].endswith(":") else ""
            return _Splice(start, end, f"{gap}{inline_text(value)}")
        colon = self._text.index(":", key.end_mark.index) + 1
        comment = re.match(r"[ \t]*(#[^\r\n]*)", self._text[colon:start])
        stop = self._line_end(end)
        rest = self._text[end:stop] if comment is None else f" {comment[1]}"
        first, *more = value_lines(value, key.start_mark.column, key.end_mark.column + 1)
        head = f" {first}{rest}" if first else rest
        if more and (past := self._past_comments(end, key.start_mark.column)) > self._next_line(end):
            stop = self._line_end(self._line_start(past - 1))
        return _Splice(colon, stop, self._joined([head.rstrip(), *more]))

    def _insert(self, around: MappingNode, behind: int, edit: SetKey) -> _Splice:
        end = self._end(around.value[behind][1])
        if around.flow_style:
            return _Splice(end, end, f", {edit.key}: {inline_text(edit.value)}")
        column = around.value[behind][0].start_mark.column
        head = f"{' ' * column}{edit.key}:"
        first, *more = value_lines(edit.value, column, len(head))
        return self._lines_behind(end, column, [f"{head} {first}" if first else head, *more])

    def _remove_key(self, around: MappingNode, index: int) -> _Splice:
        key, value = around.value[index]
        start = key.start_mark.index
        if around.flow_style and index:
            return _Splice(self._end(around.value[index - 1][1]), self._end(value), "")
        if index:
            return _Splice(self._line_start(start), self._past_comments(self._end(value), key.start_mark.column), "")
        # The first key of a mapping follows a dash or a brace, which is kept.
        stop = self._end(value) if len(around.value) == 1 else around.value[1][0].start_mark.index
        return _Splice(start, stop, "")

    def _append(self, edit: AppendEntry) -> _Splice:
        try:
            node = self._at((edit.key,))
        except DefinitionError:
            stop = len(self._text)
            gap = "" if self._text.endswith("\n") else self._newline
            head = [gap, f"{edit.key}:"] if edit.key not in self._begun else []
            self._begun.add(edit.key)
            return _Splice(stop, stop, self._joined([*head, *entry_lines(edit.entry, 2), ""]))
        if not isinstance(node, SequenceNode):
            raise _missing((edit.key,))
        end = self._end(node)
        if node.flow_style or not node.value:
            return _Splice(end - 1, end - 1, f"{', ' if node.value else ''}{inline_text(edit.entry)}")
        apart = [""] if self._entries_stand_apart(node) else []
        column = node.start_mark.column
        return self._lines_behind(end, column, [*apart, *entry_lines(edit.entry, column)])

    def _past_comments(self, end: int, column: int) -> int:
        """Start of the first line behind a value and the comments that are indented as parts of it.

        Such a comment behind a block scalar of fewer lines would become a part of its text.

        Args:
            end: The end of the value.
            column: The column of its key, or of the dash before it.
        """
        place = self._next_line(end)
        while (comment := _COMMENT.match(self._text, place)) and len(comment[1]) > column:
            place = comment.end()
        return place

    def _lines_behind(self, end: int, column: int, lines: Sequence[str]) -> _Splice:
        """Edit that inserts whole lines behind a value."""
        place = self._past_comments(end, column)
        if self._text[:place].endswith("\n"):
            return _Splice(place, place, self._joined([*lines, ""]))
        return _Splice(place, place, self._joined(["", *lines]))

    def _entries_stand_apart(self, node: SequenceNode) -> bool:
        if len(node.value) == 1:
            return not node.value[0].flow_style
        between = self._text[self._end(node.value[-2]) : node.value[-1].start_mark.index]
        return re.search(r"\n[ \t]*\r?\n", between) is not None

    def _remove_entry(self, node: Node, edit: RemoveEntry) -> _Splice:
        if not isinstance(node, SequenceNode) or edit.index >= len(node.value):
            raise _missing((*edit.location, edit.index))
        items, index = node.value, edit.index
        if node.flow_style:
            removed = self._removed[edit.location]
            if not removed.issuperset(range(index)):
                return _Splice(self._end(items[index - 1]), self._end(items[index]), "")
            # No entry is before it; the last of all is removed with the comma after it.
            last = index + 1 == len(items)
            stop = node.end_mark.index - 1 if last else items[index + 1].start_mark.index
            return _Splice(items[index].start_mark.index, stop, "")
        dash = self._text.rindex("-", 0, items[index].start_mark.index)
        start = self._line_start(dash)
        stop = self._past_comments(self._end(items[index]), dash - start)
        while self._is_blank(stop) and start and self._is_blank(self._line_start(start - 1)):
            start = self._line_start(start - 1)
        return _Splice(start, stop, "")

    def _is_blank(self, start: int) -> bool:
        """True if a line is empty, or the file ends there."""
        return not self._text[start : self._line_end(start)].strip()


def _missing(location: Sequence[str | int]) -> DefinitionError:
    return DefinitionError(f"the file has no value at {'.'.join(map(str, location))}", hint="read it again")
