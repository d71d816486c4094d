"""Conversion of rich text to plain text of the same meaning, with a list of what is lost.

Exponents and indices, lists and tables have a plain form; struck-out text is deleted text and is
omitted; attachments and markup of other languages are lost. Emphasis, fonts and colours count as
decoration.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from typing import Any

from rgss.exchange.plain_forms import PlainText, omitted, shifted_text
from rgss.findings import shown

_BLOCKS = frozenset(
    {"address", "blockquote", "center", "dd", "div", "dl", "dt", "fieldset", "form", "hr", "li", "ol", "p", "pre"}
    | {"table", "tbody", "tfoot", "thead", "tr", "ul"}
) | {f"h{level}" for level in range(1, 7)}
_DELETED = frozenset({"del", "s", "strike"})
_FOREIGN = frozenset({"applet", "audio", "canvas", "iframe", "img", "input", "math", "svg", "video"})
_HIDDEN = frozenset({"head", "script", "style", "template", "title"})
_CELLS = frozenset({"td", "th"})
_STRUCK = re.compile(r"text-decoration[^;]*:[^;]*line-through", re.IGNORECASE)
_SHIFTED = re.compile(r"vertical-align\s*:\s*(super|sub)\b", re.IGNORECASE)
_GONE = re.compile(r"display\s*:\s*none|visibility\s*:\s*hidden", re.IGNORECASE)
_BETWEEN_CELLS = " | "
_LETTERED = re.compile(r"list-style(?:-type)?\s*:[^;]*\b(lower|upper)-(?:alpha|latin)", re.IGNORECASE)
_LETTERS = "abcdefghijklmnopqrstuvwxyz"


def plain_text(node: Any) -> PlainText:
    """The plain text of an XHTML value.

    Args:
        node: The element around the XHTML, of lxml.
    """
    reader = _Reader()
    reader.children(node)
    lines = [line.rstrip() for line in "".join(reader.parts).replace(_INDENT, "  ").split("\n")]
    return PlainText(
        text=re.sub(r"\n{3,}", "\n\n", "\n".join(lines)).strip(), losses=tuple(dict.fromkeys(reader.losses))
    )


_INDENT = "\ue000"
"""Placeholder of the indentation of an inner list until blanks are laid out, from the private use area."""


@dataclass(slots=True)
class _Reader:
    parts: list[str] = field(default_factory=list)
    losses: list[str] = field(default_factory=list)
    counters: list[int | None] = field(default_factory=list)
    """Number of the last item of each enclosing list; None for unnumbered lists."""
    letters: list[str] = field(default_factory=list)
    """Letters that number each enclosing list; empty for numbers."""
    literal: bool = False
    bulleted: int = 0
    """Number of the parts up to the last bullet, behind which the first paragraph of its item continues the line."""

    def children(self, node: Any) -> None:
        self.say(node.text)
        for child in node:
            if isinstance(child.tag, str):
                self.element(child)
            self.say(child.tail)

    def say(self, text: str | None) -> None:
        if not text:
            return
        said = text.replace("\u00a0", " ").replace(_INDENT, "\ufffd")
        if not self.literal:
            said = re.sub(r"\s+", " ", said)
            if self.at_line_start() or (self.parts and self.parts[-1].endswith(" ")):
                said = said.lstrip(" ")
        if said:
            self.parts.append(said)

    def at_line_start(self) -> bool:
        return len(self.parts) == self.bulleted or self.parts[-1].endswith("\n")

    def break_line(self, *, of_list: bool = False) -> None:
        if not self.at_line_start() or (of_list and self.parts and not self.parts[-1].endswith("\n")):
            self.parts.append("\n")

    def element(self, node: Any) -> None:
        name = node.tag.rpartition("}")[2].rpartition(":")[2].lower()
        style = node.get("style") or ""
        if name in _HIDDEN:
            return
        if name in _DELETED or _STRUCK.search(style) or _GONE.search(style):
            loss = omitted("".join(node.itertext()), "hidden" if _GONE.search(style) else "struck-out")
            self.losses += [loss] if loss else []
            return
        shift = _SHIFTED.search(style)
        raised = name == "sup" or (shift is not None and shift[1].lower() == "super")
        if raised or name == "sub" or shift is not None:
            self.parts.append(shifted_text(self.apart(node), raised=raised))
        elif name == "br":
            self.parts.append("\n")
        elif name == "object" or name in _FOREIGN:
            self.attachment(node, name)
        elif name == "a":
            self.link(node)
        elif name == "q":
            self.parts.append("“")
            self.children(node)
            self.parts.append("”")
        elif name == "table":
            self.break_line()
            self.table(node)
            self.break_line()
        elif name in _BLOCKS:
            self.block(node, name)
        else:
            self.children(node)

    def block(self, node: Any, name: str) -> None:
        of_list = name in ("ul", "ol", "li")
        self.break_line(of_list=of_list)
        if name in ("ul", "ol"):
            start = node.get("start") or "1"
            first = int(start) if re.fullmatch(r"-?\d{1,6}", start) else 1
            self.counters.append(first - 1 if name == "ol" else None)
            self.letters.append(_letters_of(node))
            self.children(node)
            self.counters.pop()
            self.letters.pop()
        elif name == "li":
            self.parts.append(_INDENT * max(0, len(self.counters) - 1) + self.bullet(node.get("value") or ""))
            self.bulleted = len(self.parts)
            self.children(node)
        else:
            before, self.literal = self.literal, self.literal or name == "pre"
            self.children(node)
            self.literal = before
        self.break_line(of_list=of_list)

    def bullet(self, value: str) -> str:
        if not self.counters or self.counters[-1] is None:
            return "- "
        number = int(value) if re.fullmatch(r"-?\d{1,6}", value) else self.counters[-1] + 1
        self.counters[-1] = number
        letters = self.letters[-1]
        return f"{letters[number - 1] if 0 < number <= len(letters) else number}. "

    def table(self, node: Any) -> None:
        for row in node.iter("{*}tr"):
            # A table within a cell is part of the text of the cell.
            if next(row.iterancestors("{*}table"), None) is not node:
                continue
            cells = [each for each in row if isinstance(each.tag, str) and each.tag.rpartition("}")[2] in _CELLS]
            self.parts.append(_BETWEEN_CELLS.join(self.apart(each).replace("\n", "; ") for each in cells) + "\n")
            if any((each.get(span) or "1") != "1" for each in cells for span in ("rowspan", "colspan")):
                self.losses.append("the table has merged cells, whose text occurs once")
        caption = next(iter(node.iter("{*}caption")), None)
        if caption is not None:
            self.parts.append(self.apart(caption) + "\n")

    def apart(self, node: Any) -> str:
        """Content of an element, as a text of its own."""
        inner = _Reader(losses=self.losses)
        inner.children(node)
        return "".join(inner.parts).strip()

    def link(self, node: Any) -> None:
        text, target = self.apart(node), (node.get("href") or "").strip()
        self.parts.append(text)
        if target and not target.startswith("#") and target.removeprefix("mailto:") != text:
            self.parts.append(f" ({target})" if text else target)

    def attachment(self, node: Any, name: str) -> None:
        named = node.get("data") or node.get("src") or node.get("name") or ""
        what = "attachment" if name == "object" else f"element '{name}'"
        self.losses.append(f"the {what} {shown(named)} is omitted" if named else f"the {what} is omitted")
        if name == "object":
            # Its content is the alternative shown in place of the attachment.
            self.children(node)


def _letters_of(node: Any) -> str:
    """Letters that number a list, since other texts refer to its items by them; empty for numbers."""
    styled = _LETTERED.search(node.get("style") or "")
    kind = node.get("type") or ""
    if kind == "A" or (styled and styled[1].lower() == "upper"):
        return _LETTERS.upper()
    return _LETTERS if kind == "a" or styled else ""
