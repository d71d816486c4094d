"""Refusal of unsafe XML before any other parser reads it: document types, entities, unbounded nesting."""

from __future__ import annotations

from xml.parsers import expat

from rgss.errors import DocumentError
from rgss.exchange.files import problem
from rgss.findings import Finding

DEEPEST_NESTING = 250
MOST_ELEMENTS = 4_000_000


class _RefusedError(Exception):
    """The XML has a refused construct."""


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
