"""Grammar of ReqIF 1.2 (OMG formal/16-07-01): content and required attributes of each element."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from types import MappingProxyType

KINDS = ("BOOLEAN", "DATE", "ENUMERATION", "INTEGER", "REAL", "STRING", "XHTML")
"""The kinds of values."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Shape:
    """Content of one element.

    Attributes:
        one: Child elements that must occur exactly once.
        maybe: Child elements that may occur at most once.
        many: Child elements that may occur any number of times.
        attributes: The attributes that reading needs; none of them may be empty.
        formal: Further attributes and elements that the schema requires and reading does not need.
        is_open: True if it may contain anything, such as XHTML.
    """

    one: tuple[str, ...] = ()
    maybe: tuple[str, ...] = ()
    many: tuple[str, ...] = ()
    attributes: tuple[str, ...] = ()
    formal: tuple[str, ...] = ()
    is_open: bool = False


def shape_of(name: str, around: str) -> Shape | None:
    """The shape of an element.

    Args:
        name: Its name.
        around: The name of its parent; empty for the root.

    Returns:
        Its shape; None if ReqIF has no such element there.
    """
    return _SHAPES.get(f"{around}/{name}") or _SHAPES.get(name)


def _named(*also: str, one: tuple[str, ...] = (), maybe: tuple[str, ...] = ()) -> Shape:
    """An element with an identifier."""
    formal = () if "LAST-CHANGE" in also else ("LAST-CHANGE",)
    return Shape(attributes=("IDENTIFIER", *also), formal=formal, one=one, maybe=("ALTERNATIVE-ID", *maybe))


def _all(prefix: str, suffix: str = "") -> tuple[str, ...]:
    return tuple(f"{prefix}-{kind}{suffix}" for kind in KINDS)


def _of_kind(kind: str) -> Iterable[tuple[str, Shape]]:
    """The elements of one kind of values."""
    definition, value, data_type = (f"{what}-{kind}" for what in (_DEFINITION, _VALUE, _DATA_TYPE))
    values = ("SPECIFIED-VALUES",) if kind == "ENUMERATION" else ()
    yield data_type, _named(maybe=values)
    yield definition, _named(one=("TYPE",), maybe=("DEFAULT-VALUE",))
    yield f"{definition}/TYPE", Shape(one=(f"{data_type}-REF",))
    # It may be empty by the schema, which the library cannot read.
    yield f"{definition}/DEFAULT-VALUE", Shape(one=(value,))
    yield f"{value}/DEFINITION", Shape(one=(f"{definition}-REF",))
    if kind == "ENUMERATION":
        yield value, Shape(one=("DEFINITION",), maybe=("VALUES",))
        yield f"{value}/VALUES", Shape(many=("ENUM-VALUE-REF",))
    elif kind == "XHTML":
        yield value, Shape(one=("DEFINITION", "THE-VALUE"), maybe=("THE-ORIGINAL-VALUE",))
    else:
        yield value, Shape(one=("DEFINITION",), attributes=("THE-VALUE",))


_DEFINITION, _VALUE, _DATA_TYPE = "ATTRIBUTE-DEFINITION", "ATTRIBUTE-VALUE", "DATATYPE-DEFINITION"
_ENDS = ("SOURCE-SPECIFICATION", "TARGET-SPECIFICATION")
_TYPES = ("RELATION-GROUP-TYPE", "SPEC-OBJECT-TYPE", "SPEC-RELATION-TYPE", "SPECIFICATION-TYPE")
_TITLES = ("CREATION-TIME", "REQ-IF-TOOL-ID", "REQ-IF-VERSION", "SOURCE-TOOL-ID", "TITLE")
_CONTENT = ("DATATYPES", "SPEC-TYPES", "SPEC-OBJECTS", "SPEC-RELATIONS", "SPECIFICATIONS", "SPEC-RELATION-GROUPS")
_VALUED = ("SPEC-OBJECT", "SPEC-RELATION", "SPECIFICATION", "RELATION-GROUP")
_REFERENCES = (
    *(*_all(_DEFINITION, "-REF"), *_all(_DATA_TYPE, "-REF"), "ENUM-VALUE-REF", "SPEC-OBJECT-REF"),
    *("SPEC-RELATION-REF", "SPECIFICATION-REF", *(f"{name}-REF" for name in _TYPES)),
)

_SHAPES: Mapping[str, Shape] = MappingProxyType(
    {
        "REQ-IF": Shape(one=("THE-HEADER", "CORE-CONTENT"), maybe=("TOOL-EXTENSIONS",)),
        "TOOL-EXTENSIONS": Shape(is_open=True),
        "THE-HEADER": Shape(one=("REQ-IF-HEADER",)),
        "REQ-IF-HEADER": Shape(
            attributes=("IDENTIFIER",), maybe=("COMMENT", "REPOSITORY-ID", *_TITLES), formal=_TITLES
        ),
        **{name: Shape() for name in ("COMMENT", "REPOSITORY-ID", *_TITLES, *_REFERENCES)},
        "CORE-CONTENT": Shape(one=("REQ-IF-CONTENT",)),
        "REQ-IF-CONTENT": Shape(maybe=_CONTENT),
        "DATATYPES": Shape(many=_all(_DATA_TYPE)),
        "SPEC-TYPES": Shape(many=_TYPES),
        "SPEC-OBJECTS": Shape(many=("SPEC-OBJECT",)),
        "SPEC-RELATIONS": Shape(many=("SPEC-RELATION",)),
        "RELATION-GROUP/SPEC-RELATIONS": Shape(many=("SPEC-RELATION-REF",)),
        "SPECIFICATIONS": Shape(many=("SPECIFICATION",)),
        "SPEC-RELATION-GROUPS": Shape(many=("RELATION-GROUP",)),
        "ALTERNATIVE-ID": Shape(one=("ALTERNATIVE-ID",)),
        "ALTERNATIVE-ID/ALTERNATIVE-ID": Shape(attributes=("IDENTIFIER",)),
        "SPECIFIED-VALUES": Shape(many=("ENUM-VALUE",)),
        "ENUM-VALUE": _named(maybe=("PROPERTIES",)),
        "PROPERTIES": Shape(one=("EMBEDDED-VALUE",)),
        "EMBEDDED-VALUE": Shape(attributes=("KEY",), formal=("OTHER-CONTENT",)),
        "SPEC-ATTRIBUTES": Shape(many=_all(_DEFINITION)),
        "RELATION-GROUP-TYPE": _named(maybe=("SPEC-ATTRIBUTES",)),
        "SPEC-OBJECT-TYPE": _named(maybe=("SPEC-ATTRIBUTES",)),
        # The library cannot read a relation type without a name, or a specification type without a time.
        "SPEC-RELATION-TYPE": _named("LONG-NAME", maybe=("SPEC-ATTRIBUTES",)),
        "SPECIFICATION-TYPE": _named("LAST-CHANGE", maybe=("SPEC-ATTRIBUTES",)),
        "VALUES": Shape(many=_all(_VALUE)),
        "THE-VALUE": Shape(is_open=True),
        "THE-ORIGINAL-VALUE": Shape(is_open=True),
        "SPEC-OBJECT": _named(one=("TYPE",), maybe=("VALUES",)),
        "SPEC-RELATION": _named(one=("SOURCE", "TARGET", "TYPE"), maybe=("VALUES",)),
        "SOURCE": Shape(one=("SPEC-OBJECT-REF",)),
        "TARGET": Shape(one=("SPEC-OBJECT-REF",)),
        "SPECIFICATION": _named(one=("TYPE",), maybe=("VALUES", "CHILDREN")),
        "CHILDREN": Shape(many=("SPEC-HIERARCHY",)),
        "SPEC-HIERARCHY": _named(one=("OBJECT",), maybe=("CHILDREN", "EDITABLE-ATTS")),
        "EDITABLE-ATTS": Shape(many=_all(_DEFINITION, "-REF")),
        "OBJECT": Shape(one=("SPEC-OBJECT-REF",)),
        "RELATION-GROUP": _named(one=("TYPE", *_ENDS), maybe=("SPEC-RELATIONS", "VALUES")),
        **{name: Shape(one=("SPECIFICATION-REF",)) for name in _ENDS},
        **{f"{name}/TYPE": Shape(one=(f"{name}-TYPE-REF",)) for name in _VALUED},
        **dict(shape for kind in KINDS for shape in _of_kind(kind)),
    }
)
