"""Texts as XHTML of ReqIF, and back; markup in a text of ours is text, and never markup."""

from __future__ import annotations

import re
from typing import Any

from rgss.errors import DefinitionError

_BLOCKS = frozenset({"div", "p", "li", "ul", "ol", "dl", "dt", "dd", "table", "tr", "pre", "blockquote"}) | {
    f"h{level}" for level in range(1, 7)
}
_NO_XML = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f\ud800-\udfff\ufffe\uffff]")
_BREAK = "<xhtml:br/>"


def escaped(text: str, where: str) -> str:
    """A text for XML, between tags or in an attribute.

    Raises:
        DefinitionError: It has a character that XML cannot hold.
    """
    if _NO_XML.search(text):
        raise DefinitionError(f"{where} has a character that XML cannot hold", hint="remove it")
    for sign, entity in (("&", "&amp;"), ("<", "&lt;"), (">", "&gt;"), ('"', "&quot;"), ("\r", "&#13;")):
        text = text.replace(sign, entity)
    return text


def as_xhtml(text: str, where: str) -> str:
    """A text as XHTML; its breaks of lines are elements."""
    return f"<xhtml:div>{escaped(text, where).replace(chr(10), _BREAK)}</xhtml:div>"


def from_xhtml(node: Any, *, exact: bool) -> str:
    """The text of an XHTML value.

    Args:
        node: The element around the XHTML, of lxml.
        exact: It is `as_xhtml` of a text; else blanks and breaks are laid out as a browser does.
    """
    parts: list[str] = []
    _collect(node, parts, exact=exact)
    text = "".join(parts)
    if exact:
        return text.strip()
    lines = [" ".join(line.split(" ")).strip() for line in re.sub(r"[ \t\u00a0]+", " ", text).split("\n")]
    return re.sub(r"\n{3,}", "\n\n", "\n".join(lines)).strip()


def _collect(node: Any, parts: list[str], *, exact: bool) -> None:
    name = node.tag.rpartition("}")[2].rpartition(":")[2].lower() if isinstance(node.tag, str) else ""
    if name == "br":
        parts.append("\n")
    if name:
        parts.append(_laid_out(node.text, exact=exact))
        for child in node:
            block = not exact and isinstance(child.tag, str) and child.tag.rpartition("}")[2].lower() in _BLOCKS
            if block and parts and not parts[-1].endswith("\n"):
                parts.append("\n")
            _collect(child, parts, exact=exact)
            if block:
                parts.append("\n")
            parts.append(_laid_out(child.tail, exact=exact))


def _laid_out(text: str | None, *, exact: bool) -> str:
    return (text or "") if exact else re.sub(r"\s+", " ", text or "")
