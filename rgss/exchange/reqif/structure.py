"""Structural errors of ReqIF in an XML file, for files that the reader of the library cannot read."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from xml.parsers import expat

from rgss.exchange.files import problem
from rgss.exchange.reqif.grammar import Shape, shape_of
from rgss.findings import Finding, shown

NAMESPACE = "http://www.omg.org/spec/ReqIF/20110401/reqif.xsd"

_SEPARATOR = " "
_REFERENCE = "-REF"
_MAY_BE_EMPTY = ("THE-VALUE", "KEY")
_WHOLE_NUMBERS = ("ACCURACY",)


def structure_problems(content: bytes, file: str) -> tuple[Finding, ...]:
    """Elements that lack required parts of ReqIF, and dangling references; empty if none is known.

    Problems that prevent reading come first; violations of the schema alone are reported if there are no others.

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


@dataclass(slots=True, kw_only=True)
class _Element:
    """An element whose end tag is not read yet."""

    name: str
    identifier: str
    line: int
    shape: Shape
    inner: Counter[str] = field(default_factory=Counter)
    text: str = ""

    def __str__(self) -> str:
        return f"the {self.name} {shown(self.identifier)}" if self.identifier else f"an element {self.name}"


class _Reader:
    def __init__(self, file: str) -> None:
        self._file = file
        self._open: list[_Element] = []
        self._passed_over = 0
        """Depth within an element that may contain anything, or that is misplaced."""
        self._found: list[Finding] = []
        self._formal: list[Finding] = []
        self._identifiers: dict[str, tuple[str, int]] = {}
        """Name and line of the element with each identifier."""
        self._references: list[tuple[str, str, int]] = []
        self._root = ""

    def started(self, qualified: str, attributes: Mapping[str, str], line: int) -> None:
        if self._passed_over or (self._open and self._open[-1].shape.is_open):
            self._passed_over += 1
            return
        namespace, _, name = qualified.rpartition(_SEPARATOR)
        around = self._open[-1] if self._open else None
        if around is None:
            if name != "REQ-IF":
                self._root = f"its root is {shown(name)}, not 'REQ-IF'"
            elif namespace != NAMESPACE:
                self._root = f"its root has the namespace {shown(namespace)}, not {NAMESPACE!r}"
        elif not self._belongs(name, namespace, around, line):
            self._passed_over = 1
            return
        shape = shape_of(name, "" if around is None else around.name)
        if shape is None:  # a wrong root is reported alone
            self._passed_over = 1
            return
        element = _Element(name=name, identifier=attributes.get("IDENTIFIER", ""), line=line, shape=shape)
        self._check_attributes(element, attributes)
        self._open.append(element)

    def said(self, text: str) -> None:
        if not self._passed_over and self._open and self._open[-1].name.endswith(_REFERENCE):
            self._open[-1].text += text

    def ended(self) -> None:
        if self._passed_over:
            self._passed_over -= 1
            return
        element = self._open.pop()
        if element.name.endswith(_REFERENCE):
            self._references.append((element.name, element.text.strip(), element.line))
        around = f" in {self._open[-1]}" if self._open and not element.identifier else ""
        for wanted in element.shape.one:
            if not element.inner[wanted]:
                self._report(element.line, f"{element}{around} has no {wanted}")
        for wanted in element.shape.formal:
            if wanted in element.shape.maybe and not element.inner[wanted]:
                self._report(element.line, f"{element} has no {wanted}", is_formal=True)

    def problems(self) -> Iterator[Finding]:
        if self._root:
            yield self._problem(1, self._root)
            return
        found = [*self._found, *self._broken_references()]
        yield from found or self._formal

    def _belongs(self, name: str, namespace: str, around: _Element, line: int) -> bool:
        shape = around.shape
        if namespace != NAMESPACE or name not in (*shape.one, *shape.maybe, *shape.many):
            self._report(line, f"{around.name} must not contain an element {shown(name)}")
            return False
        around.inner[name] += 1
        if around.inner[name] == 2 and name not in shape.many:
            self._report(line, f"{around} has more than one {name}")
        return True

    def _check_attributes(self, element: _Element, attributes: Mapping[str, str]) -> None:
        line, name, shape = element.line, element.name, element.shape
        for wanted in shape.attributes:
            if not (wanted in attributes if wanted in _MAY_BE_EMPTY else attributes.get(wanted)):
                what = f"an element {name}" if wanted == "IDENTIFIER" else str(element)
                self._report(line, f"{what} has no {wanted}")
        for wanted in shape.formal:
            if wanted not in shape.maybe and wanted not in attributes:
                self._report(line, f"{element} has no {wanted}", is_formal=True)
        for wanted in _WHOLE_NUMBERS:
            if wanted in attributes and not attributes[wanted].strip().lstrip("+-").isdecimal():
                self._report(line, f"{wanted} of {element} must be a whole number, got {shown(attributes[wanted])}")
        # An alternative identifier is one of another tool, to which nothing refers.
        if element.identifier and name != "ALTERNATIVE-ID":
            _, before = self._identifiers.setdefault(element.identifier, (name, line))
            if self._identifiers[element.identifier] != (name, line):
                self._report(line, f"the identifier {shown(element.identifier)} is already in line {before}")

    def _broken_references(self) -> Iterator[Finding]:
        for name, identifier, line in self._references:
            kind, where = self._identifiers.get(identifier, ("", 0))
            if not identifier:
                yield self._problem(line, f"an element {name} is empty and names nothing")
            elif not kind:
                yield self._problem(line, f"the {name} {shown(identifier)} names a missing element")
            elif f"{kind}{_REFERENCE}" != name:
                yield self._problem(line, f"the {name} {shown(identifier)} names a {kind}, that of line {where}")

    def _report(self, line: int, message: str, *, is_formal: bool = False) -> None:
        (self._formal if is_formal else self._found).append(self._problem(line, message))

    def _problem(self, line: int, message: str) -> Finding:
        return problem(
            self._file, "structure", f"is XML, but not ReqIF that can be read: {message}", line=line, hint="correct it"
        )
