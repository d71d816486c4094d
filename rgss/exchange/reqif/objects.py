"""Objects of a ReqIF file with their attributes as texts."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from rgss.exchange.attributes import ATTRIBUTES, Form, Part
from rgss.exchange.foreign_names import PART, ForeignNames
from rgss.exchange.plain_forms import PlainText
from rgss.exchange.reqif.identifiers import type_identifier
from rgss.exchange.reqif.omissions import ObjectValues, Omissions
from rgss.exchange.reqif.prose import from_xhtml
from rgss.exchange.reqif.vocabulary import EXCHANGE_IDS, MEASURE, TOOL, TYPE_NAMES
from rgss.exchange.verification_records import RECORD_ATTRIBUTES

_OF_RECORDS = frozenset(attribute.name for attribute in RECORD_ATTRIBUTES)

_ESCAPES_BREAKS = "strictdoc"
r"""Line break in a string of StrictDoc: ``\n``, since XML would turn a real one into a blank."""


_IDENTIFIER = "IDENTIFIER"
"""Identifier of an object in the file, which is an id only if it is mapped to it."""
_DELETED = "reqif.foreigndeleted"
"""Attribute of the ReqIF Implementation Guide, true for an object that the other tool has deleted."""


class UnsoundObjectError(ValueError):
    """An object of a file contradicts the types of the file."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ForeignObject:
    """One object.

    Attributes:
        identifier: Its identifier in the file.
        type_name: The name of its type.
        part: Its part here; None if that is open, or it is a measure.
        is_ours: True if rgss has written its type.
        id: Its id.
        cells: Its attributes as texts, by the names of rgss.
        line: Its first line.
    """

    identifier: str
    type_name: str
    part: Part | None
    is_ours: bool
    id: str
    cells: Mapping[str, str]
    line: int


def _id_in(values: Mapping[str, str], *, is_ours: bool) -> str:
    """The id of an object by the values of its attributes; empty if it has none."""
    names = ("id",) if is_ours else ("id", *EXCHANGE_IDS)
    return next((found for name in names if (found := values.get(name, "").strip())), "")


class ObjectReader:
    """Reader of objects, with a list of what could not be imported."""

    def __init__(
        self, bundle: Any, known: Mapping[str, Part], part: Part | None, names: ForeignNames | None = None
    ) -> None:
        """Create a reader of a file.

        Args:
            bundle: The file as read by the library.
            known: Part of each element of the project, by id.
            part: Part of elements whose part neither the file nor the project states.
            names: The mapped names of the file.
        """
        core = bundle.core_content.req_if_content
        tool = getattr(bundle.req_if_header, "req_if_tool_id", None) or ""
        self._exact = tool == TOOL
        self._escapes_breaks = tool.lower() == _ESCAPES_BREAKS
        self._known, self._part, self._mapped = known, part, names or ForeignNames()
        self._types = {each.identifier: each for each in core.spec_types or []}
        self._choices = {
            value.identifier: value.long_name or value.key or ""
            for each in core.data_types or []
            for value in getattr(each, "values", None) or ()
        }
        self._parts = {name.lower(): kind for kind, name in TYPE_NAMES.items()}
        self.omissions = Omissions(self._mapped)
        """Findings on what is not imported."""
        self.names: dict[str, None] = {}
        """The names of all attributes."""
        self.records: dict[str, dict[str, str]] = {}
        """Attributes of the verification record of each requirement that has one."""
        self.own_parts = [kind for kind in Part if type_identifier(kind.value) in self._types]

    def read(self, objects: Sequence[Any]) -> dict[str, ForeignObject]:
        """The objects that have an id, by their identifiers in the file.

        Raises:
            UnsoundObjectError: Two objects have one identifier, or one is of no type.
        """
        found: dict[str, ForeignObject] = {}
        for each in objects:
            if each.identifier in found:
                raise UnsoundObjectError(f"two objects have the identifier {each.identifier!r}")
            made = self._object(each)
            if made is not None:
                found[each.identifier] = made
        return found

    def _object(self, each: Any) -> ForeignObject | None:
        kind = self._types.get(each.spec_object_type)
        if kind is None:
            raise UnsoundObjectError(f"the object {each.identifier!r} is of no type")
        read = self._values(each, kind)
        self.names.update(dict.fromkeys((*read.stated, _IDENTIFIER)))
        if any(long.lower() == _DELETED and value in ("true", "1") for long, value in read.values.items()):
            self.omissions.deleted(read.type_name)
            return None
        sources = self._mapped.sources(read.stated, read.values)
        by_name = {name: read.values.get(long, "") for name, long in sources.items()}
        element_id = self._mapped.own_id(_id_in(by_name, is_ours=read.is_ours))
        has = {"id": element_id, "text": by_name.get("text", "").strip()}
        lacks = tuple(name for name, value in has.items() if not value)
        if not read.is_ours and lacks:
            self.omissions.lacking(read.type_name, lacks, read.values)
            return None
        is_measure = read.is_ours and kind.identifier == type_identifier(MEASURE)
        said = by_name[PART].strip() if self._mapped.target(sources.get(PART, "")) == PART else ""
        stated = self._mapped.stated_part(said)
        if said and stated is None:
            self.omissions.of_no_part(sources[PART], said)
            return None
        part = None if is_measure else stated or self._part_of(read.type_name, element_id)
        return ForeignObject(
            identifier=each.identifier,
            type_name=MEASURE if is_measure else read.type_name,
            part=part,
            is_ours=read.is_ours,
            id=element_id,
            cells=self._cells(read, part, element_id, sources),
            line=read.line,
        )

    def _values(self, each: Any, kind: Any) -> ObjectValues:
        """The values of an object by the file's names of its attributes, with the default values of its type."""
        stated = {definition.identifier: definition for definition in kind.attribute_definitions or ()}
        line = int(getattr(each.xml_node, "sourceline", None) or 1)
        is_ours = kind.identifier in {type_identifier(own) for own in (*[part.value for part in Part], MEASURE)}
        beside = {} if is_ours else self._of_object(each)
        read = ObjectValues(
            type_name=kind.long_name or kind.identifier,
            is_ours=is_ours,
            stated=tuple(dict.fromkeys((*(each.long_name or each.identifier for each in stated.values()), *beside))),
            line=line,
            values=beside,
        )
        texts: dict[str, PlainText] = {}
        for value in each.attributes:
            if value.definition_ref not in stated:
                if is_ours:
                    # Its absence would empty the attribute.
                    raise UnsoundObjectError(f"the object {each.identifier!r} has a value of no attribute of its type")
                message = f"a value of the object {each.identifier!r} is of no attribute of its type, and not imported"
                where = int(getattr(value.xml_node, "sourceline", None) or line)
                self.omissions.lost.append((where, message))
                continue
            if value.definition_ref in texts:
                raise UnsoundObjectError(f"the object {each.identifier!r} has two values of one attribute")
            texts[value.definition_ref] = self._text(value)
            read.lines[value.definition_ref] = int(getattr(value.xml_node, "sourceline", None) or line)
        for definition in stated.values():
            text = texts.get(definition.identifier) or self._default(definition)
            if text is not None:
                read.add(definition.long_name or definition.identifier, definition.identifier, text)
        return read

    def _of_object(self, each: Any) -> dict[str, str]:
        """What an object states beside its attributes: name, description, and its identifier if that is mapped."""
        named = {"LONG-NAME": each.long_name, "DESC": each.description}
        if self._mapped.target(_IDENTIFIER):
            named[_IDENTIFIER] = each.identifier
        return {long: value for long, value in named.items() if value and value.strip()}

    def _part_of(self, type_name: str, element_id: str) -> Part | None:
        """The part of an object by its type or its id; None if nothing states it."""
        of_type = self._mapped.part_of_type(type_name) or self._parts.get(type_name.lower())
        return of_type or self._known.get(element_id) or self._part

    def _cells(
        self, read: ObjectValues, part: Part | None, element_id: str, sources: Mapping[str, str]
    ) -> Mapping[str, str]:
        """The attributes of an element by the names of rgss; what has none is noted."""
        names = {attribute.name: attribute for attribute in ATTRIBUTES[part]} if part is not None else {}
        cells = {} if read.is_ours else {"id": element_id}
        taken = {long: name for name, long in sources.items()}
        for long in read.stated:
            name, value = taken.get(long, ""), read.values.get(long, "")
            attribute = names.get(name)
            if (attribute is None and part is None and name in ("id", "text")) or (
                attribute is not None and not attribute.holds_ids
            ):
                cells[name] = element_id if name == "id" else value
                where, phrases = read.losses.get(long, (read.line, ()))
                self.omissions.lost += [(where, f"{element_id}: {long}: {phrase}") for phrase in phrases]
                if attribute is not None and attribute.form is Form.FLAG and cells[name] == "false":
                    cells[name] = ""
            elif attribute is not None and self._mapped.target(long) == name:
                cells[name] = self._mapped.own_ids(name, value)
            elif read.is_ours and part is Part.SYSTEM and name in _OF_RECORDS:
                if value:
                    self.records.setdefault(element_id, {})[name] = value
            elif value.strip() and not (name == PART and self._mapped.target(long) == PART):
                self.omissions.attribute(long, read, element_id, part, sources)
        return cells

    def _default(self, definition: Any) -> PlainText | None:
        """Default value of an attribute; None if it has none."""
        stated = None if definition.xml_node is None else definition.xml_node.find("DEFAULT-VALUE")
        if stated is None or not len(stated):
            return None
        value = stated[0]
        if value.tag == "ATTRIBUTE-VALUE-XHTML":
            return PlainText(text=from_xhtml(value.find("THE-VALUE"), exact=self._exact).text, losses=())
        if value.tag == "ATTRIBUTE-VALUE-ENUMERATION":
            return self._chosen([each.text for each in value.iterfind("VALUES/ENUM-VALUE-REF")])
        return self._plain(value.get("THE-VALUE", ""))

    def _text(self, value: Any) -> PlainText:
        if value.attribute_type.name == "XHTML":
            return from_xhtml(value.xml_node.find("THE-VALUE"), exact=self._exact)
        return self._chosen(value.value) if isinstance(value.value, list) else self._plain(str(value.value))

    def _chosen(self, choices: Sequence[str]) -> PlainText:
        unknown = next((each for each in choices if each not in self._choices), None)
        if unknown is not None:
            raise UnsoundObjectError(f"there is no choice {unknown!r}")
        return PlainText(text="; ".join(self._choices[each] for each in choices), losses=())

    def _plain(self, text: str) -> PlainText:
        return PlainText(text=text.replace("\\n", "\n") if self._escapes_breaks else text, losses=())
