"""Conversion of plain texts to XHTML of ReqIF and back; markup within a plain text is escaped."""

from __future__ import annotations

import re
from typing import Any

from rgss.errors import DefinitionError
from rgss.exchange.plain_forms import PlainText
from rgss.exchange.reqif.rich_text import plain_text

_NO_XML = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f\ud800-\udfff\ufffe\uffff]")
_BREAK = "<xhtml:br/>"
_OWN_ELEMENTS = frozenset({"div", "br"})


def escaped(text: str, where: str) -> str:
    """A text escaped for XML, between tags or in an attribute.

    Raises:
        DefinitionError: It has a character that XML cannot hold.
    """
    if _NO_XML.search(text):
        raise DefinitionError(f"{where} has a character that XML cannot hold", hint="remove it")
    for sign, entity in (("&", "&amp;"), ("<", "&lt;"), (">", "&gt;"), ('"', "&quot;"), ("\r", "&#13;")):
        text = text.replace(sign, entity)
    return text


def as_xhtml(text: str, where: str) -> str:
    """A text as XHTML; its line breaks are elements."""
    return f"<xhtml:div>{escaped(text, where).replace(chr(10), _BREAK)}</xhtml:div>"


def from_xhtml(node: Any, *, exact: bool) -> PlainText:
    """The text of an XHTML value.

    Args:
        node: The element around the XHTML, of lxml.
        exact: True if rgss wrote the file, so that a value with only its elements is inverted exactly;
            any other, such as one that another tool has edited, is laid out as by a browser.
    """
    inner = list(node.iterdescendants())
    if exact and all(_is_own(each) for each in inner):
        parts = [node.text or ""]
        for each in inner:
            if isinstance(each.tag, str):
                parts += ["\n" if _name(each) == "br" else "", each.text or ""]
            parts.append(each.tail or "")
        return PlainText(text="".join(parts).strip(), losses=())
    return plain_text(node)


def _is_own(node: Any) -> bool:
    """True for an element as rgss writes it: without attributes, which may strike out or shift its text."""
    return not isinstance(node.tag, str) or (_name(node) in _OWN_ELEMENTS and not node.attrib)


def _name(node: Any) -> str:
    return str(node.tag).rpartition("}")[2].rpartition(":")[2].lower()
