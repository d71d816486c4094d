"""Where XML departs from the structure of ReqIF: what to say of a file that its reader gave up on."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from types import MappingProxyType
from xml.parsers import expat

from rgss.exchange.files import problem
from rgss.findings import Finding, shown

NAMESPACE = "http://www.omg.org/spec/ReqIF/20110401/reqif.xsd"

_SEPARATOR = " "
_ROOT_PARTS = ("THE-HEADER", "REQ-IF-HEADER", "CORE-CONTENT", "REQ-IF-CONTENT")
_REFERENCES: Mapping[str, tuple[str, ...]] = MappingProxyType(
    {
        "SPEC-OBJECT": ("SPEC-OBJECT-TYPE-REF",),
        "SPEC-RELATION": ("SPEC-RELATION-TYPE-REF", "SOURCE", "TARGET"),
        "SPEC-HIERARCHY": ("SPEC-OBJECT-REF",),
        "SPECIFICATION": ("SPECIFICATION-TYPE-REF",),
    }
)
"""What must stand in an element."""
_KINDS = ("BOOLEAN", "DATE", "ENUMERATION", "INTEGER", "REAL", "STRING", "XHTML")
_SIMPLE_VALUES = frozenset(f"ATTRIBUTE-VALUE-{kind}" for kind in _KINDS if kind not in ("ENUMERATION", "XHTML"))
_NAMED = frozenset(
    {"SPEC-OBJECT", "SPEC-RELATION", "SPEC-HIERARCHY", "SPECIFICATION", "ENUM-VALUE", "RELATION-GROUP"}
    | {"SPEC-OBJECT-TYPE", "SPEC-RELATION-TYPE", "SPECIFICATION-TYPE", "RELATION-GROUP-TYPE", "REQ-IF-HEADER"}
    | {f"{what}-DEFINITION-{kind}" for what in ("ATTRIBUTE", "DATATYPE") for kind in _KINDS}
)
"""What has an identifier."""
_CHILDREN: Mapping[str, frozenset[str]] = MappingProxyType(
    {
        "DATATYPES": frozenset(f"DATATYPE-DEFINITION-{kind}" for kind in _KINDS),
        "SPEC-TYPES": frozenset(
            {"SPEC-OBJECT-TYPE", "SPEC-RELATION-TYPE", "SPECIFICATION-TYPE", "RELATION-GROUP-TYPE"}
        ),
        "SPEC-ATTRIBUTES": frozenset(f"ATTRIBUTE-DEFINITION-{kind}" for kind in _KINDS),
        "SPECIFIED-VALUES": frozenset({"ENUM-VALUE"}),
        "SPEC-OBJECTS": frozenset({"SPEC-OBJECT"}),
        "SPEC-RELATIONS": frozenset({"SPEC-RELATION"}),
        "SPECIFICATIONS": frozenset({"SPECIFICATION"}),
        "CHILDREN": frozenset({"SPEC-HIERARCHY"}),
        "VALUES": frozenset(f"ATTRIBUTE-VALUE-{kind}" for kind in _KINDS) | {"ENUM-VALUE-REF"},
    }
)
"""What may stand in an element that holds many of a kind."""


def structure_problems(content: bytes, file: str) -> tuple[Finding, ...]:
    """Elements that lack what ReqIF wants of them, and references to what is not there; empty if none is known.

    Args:
        content: Well-formed XML.
        file: Its name in messages.
    """
    reader = _Reader(file)
    parser = expat.ParserCreate(namespace_separator=_SEPARATOR)
    parser.StartElementHandler = lambda name, attributes: reader.started(name, attributes, parser.CurrentLineNumber)
    parser.EndElementHandler = lambda _: reader.ended()
    parser.CharacterDataHandler = reader.said
    parser.Parse(content, True)  # noqa: FBT003 - expat takes no keyword here
    return tuple(reader.problems())


class _Reader:
    def __init__(self, file: str) -> None:
        self._file = file
        self._open: list[tuple[str, str, int, set[str]]] = []
        """Name, identifier, line and inner names of each element around."""
        self._found: list[Finding] = []
        self._identifiers: dict[str, int] = {}
        self._named: list[tuple[str, str, int]] = []
        self._seen: set[str] = set()
        self._text = ""
        self._root = ""

    def started(self, qualified: str, attributes: Mapping[str, str], line: int) -> None:
        namespace, _, name = qualified.rpartition(_SEPARATOR)
        if not self._open:
            if name != "REQ-IF":
                self._root = f"its root is {shown(name)}, not 'REQ-IF'"
            elif namespace != NAMESPACE:
                self._root = f"its root has the namespace {shown(namespace)}, not {NAMESPACE!r}"
        identifier = attributes.get("IDENTIFIER", "")
        if name in _NAMED:
            if not identifier:
                self._report(line, f"an element {name} has no IDENTIFIER")
            elif identifier in self._identifiers:
                before = self._identifiers[identifier]
                self._report(line, f"the identifier {shown(identifier)} stands already in line {before}")
            else:
                self._identifiers[identifier] = line
        around = self._open[-1][0] if self._open else ""
        if around in _CHILDREN and name not in _CHILDREN[around]:
            self._report(line, f"an element {shown(name)} stands in {around}, where it does not belong")
        if name == "EMBEDDED-VALUE" and "KEY" not in attributes:
            self._report(line, "an element EMBEDDED-VALUE has no KEY")
        if name in _SIMPLE_VALUES and "THE-VALUE" not in attributes:
            self._report(line, f"an element {name} has no THE-VALUE")
        for *_, names in self._open[-3:]:
            names.add(name)
        self._seen.add(name)
        self._open.append((name, identifier, line, set()))
        self._text = ""

    def said(self, text: str) -> None:
        if self._open and self._open[-1][0].endswith("-REF"):
            self._text += text

    def ended(self) -> None:
        name, identifier, line, inner = self._open.pop()
        if name.endswith("-REF"):
            self._named.append((name, self._text.strip(), line))
        for wanted in _REFERENCES.get(name, ()):
            if wanted not in inner:
                self._report(line, f"the {name} {shown(identifier)} has no {wanted}")
        if (
            name.startswith("ATTRIBUTE-DEFINITION-")
            and not name.endswith("-REF")
            and not any(each.startswith("DATATYPE-DEFINITION-") for each in inner)
        ):
            self._report(line, f"the {name} {shown(identifier)} has no data type")
        if name.startswith("ATTRIBUTE-VALUE-") and f"{name.replace('VALUE', 'DEFINITION')}-REF" not in inner:
            self._report(line, f"an element {name} does not say of which attribute it is the value")
        if name == "ATTRIBUTE-VALUE-XHTML" and "THE-VALUE" not in inner:
            self._report(line, f"an element {name} has no THE-VALUE")
        if name in ("SOURCE", "TARGET") and "SPEC-OBJECT-REF" not in inner:
            self._report(line, f"a {name} of a relation names no object")

    def problems(self) -> Iterator[Finding]:
        if self._root:
            yield self._problem(1, self._root)
            return
        missing = next((part for part in _ROOT_PARTS if part not in self._seen), None)
        if missing is not None:
            yield self._problem(1, f"it has no {missing}")
        yield from self._found
        for name, identifier, line in self._named:
            if identifier not in self._identifiers:
                yield self._problem(line, f"the {name} {shown(identifier)} names what is not there")

    def _report(self, line: int, message: str) -> None:
        self._found.append(self._problem(line, message))

    def _problem(self, line: int, message: str) -> Finding:
        return problem(
            self._file, "structure", f"is XML, but not ReqIF that can be read: {message}", line=line, hint="mend it"
        )
