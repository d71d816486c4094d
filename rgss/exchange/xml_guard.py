"""Refusal of unsafe XML before any other parser reads it: document types, entities, unbounded nesting."""

from __future__ import annotations

import codecs
import re
from xml.parsers import expat

from rgss.errors import DocumentError
from rgss.exchange.files import problem
from rgss.findings import Finding

DEEPEST_NESTING = 250
MOST_ELEMENTS = 4_000_000


_UTF16 = (codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)
_LATIN = ("iso-8859-1", "iso-8859-15", "latin1", "windows-1252")
_DECLARED = re.compile(rb"""\s*<\?xml\s[^>]*?\bencoding\s*=\s*["']([A-Za-z0-9._-]+)["']""")
_ENCODING = re.compile(r"""(<\?xml\s[^>]*?\bencoding\s*=\s*["'])[A-Za-z0-9._-]+(?=["'])""")


class _RefusedError(Exception):
    """The XML has a refused construct."""


def in_utf8(content: bytes, file: str) -> bytes:
    """XML in UTF-8, from one in UTF-16 or in a Latin encoding that it declares; any other content is unchanged.

    Args:
        content: The whole file.
        file: Its name in messages.

    Raises:
        DocumentError: It is not in its encoding.
    """
    declared = _DECLARED.match(content)
    name = "utf-16" if content.startswith(_UTF16) else declared[1].decode("ascii").lower() if declared else ""
    if name != "utf-16" and name not in _LATIN:
        return content
    try:
        text = content.decode(name)
    except UnicodeDecodeError:
        raise DocumentError([problem(file, "encoding", f"is not in its encoding {name!r}")]) from None
    return _ENCODING.sub(r"\g<1>UTF-8", text, count=1).encode("utf-8", "surrogatepass")


def require_plain_xml(content: bytes, file: str) -> None:
    """Require well-formed XML in UTF-8 without document type, entities and deep nesting.

    Nothing is expanded, fetched or built.

    Args:
        content: The whole file.
        file: Its name in messages.

    Raises:
        DocumentError: It violates one of these conditions.
    """
    parser = expat.ParserCreate()
    depth = count = 0

    def started(*_: object) -> None:
        nonlocal depth, count
        depth, count = depth + 1, count + 1
        if depth > DEEPEST_NESTING:
            raise _RefusedError(f"is nested more than {DEEPEST_NESTING} deep")
        if count > MOST_ELEMENTS:
            raise _RefusedError(f"has more than {MOST_ELEMENTS} elements")

    def ended(*_: object) -> None:
        nonlocal depth
        depth -= 1

    def declared(_version: str, encoding: str | None, _standalone: int) -> None:
        if encoding is not None and encoding.lower() not in ("utf-8", "us-ascii"):
            raise _RefusedError(f"is in the encoding {encoding!r}, not UTF-8")

    def typed(*_: object) -> None:
        raise _RefusedError("has a document type (DTD), which may declare entities, and is refused")

    parser.StartElementHandler = started
    parser.EndElementHandler = ended
    parser.XmlDeclHandler = declared
    parser.StartDoctypeDeclHandler = typed
    try:
        if content.startswith((b"\xff\xfe", b"\xfe\xff")):
            raise _RefusedError("is in UTF-16, not UTF-8")
        parser.Parse(content, True)  # noqa: FBT003 - expat takes no keyword here
    except _RefusedError as error:
        raise DocumentError([_problem(file, "refused", str(error), parser)]) from None
    except expat.ExpatError as error:
        message = f"not well-formed XML: {expat.ErrorString(error.code)}"
        raise DocumentError([_problem(file, "syntax", message, parser)]) from None


def _problem(file: str, rule: str, message: str, parser: expat.XMLParserType) -> Finding:
    line, column = parser.CurrentLineNumber, parser.CurrentColumnNumber + 1
    return problem(file, rule, message, line=max(line, 1), column=max(column, 1))
