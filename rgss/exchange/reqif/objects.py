"""Objects of a ReqIF file with their attributes as texts."""

from __future__ import annotations

import itertools
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from rgss.exchange.attributes import ATTRIBUTES, Form, Part
from rgss.exchange.reqif.identifiers import type_identifier
from rgss.exchange.reqif.prose import from_xhtml
from rgss.exchange.reqif.vocabulary import EXCHANGE_IDS, MEASURE, TOOL, TYPE_NAMES, attribute_name
from rgss.exchange.verification_records import RECORD_ATTRIBUTES
from rgss.findings import shown

_MOST_NAMED = 8
_OF_RECORDS = frozenset(attribute.name for attribute in RECORD_ATTRIBUTES)

_ESCAPES_BREAKS = "strictdoc"
r"""Line break in a string of StrictDoc: ``\n``, since XML would turn a real one into a blank."""


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

    def __init__(self, bundle: Any, known: Mapping[str, Part], part: Part | None) -> None:
        """Create a reader of a file.

        Args:
            bundle: The file as read by the library.
            known: Part of each element of the project, by id.
            part: Part of elements whose part neither the file nor the project states.
        """
        core = bundle.core_content.req_if_content
        tool = getattr(bundle.req_if_header, "req_if_tool_id", None) or ""
        self._exact = tool == TOOL
        self._escapes_breaks = tool.lower() == _ESCAPES_BREAKS
        self._known, self._part = known, part
        self._types = {each.identifier: each for each in core.spec_types or []}
        self._choices = {
            value.identifier: value.long_name or value.key or ""
            for each in core.data_types or []
            for value in getattr(each, "values", None) or ()
        }
        self._parts = {name.lower(): kind for kind, name in TYPE_NAMES.items()}
        self._nameless: Counter[str] = Counter()
        self._attributes: dict[str, dict[str, None]] = {}
        """The attributes of the objects that are not imported, by the name of their type."""
        self._unused: dict[str, None] = {}
        self.lost: list[tuple[int, str]] = []
        """Line and message of all content that texts lose with their markup."""
        self.records: dict[str, dict[str, str]] = {}
        """Attributes of the verification record of each requirement that has one."""
        self.own_parts = [kind for kind in Part if type_identifier(kind.value) in self._types]

    def read(self, objects: Sequence[Any]) -> dict[str, ForeignObject]:
        """The objects that have an id, by their identifiers in the file.

        Args:
            objects: The objects as read by the library.

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

    def notes(self) -> Iterator[str]:
        """Notes on content that was not imported."""
        for name, count in sorted(self._nameless.items()):
            had = ", ".join(map(shown, itertools.islice(self._attributes[name], _MOST_NAMED)))
            has = f" among their attributes {had}" if had else ""
            yield f"{count} objects of type {shown(name)} are not imported: they have no id or no text{has}"
        for name in self._unused:
            yield f"the attribute {name!r} is not imported: rgss has none of that name"

    def _object(self, each: Any) -> ForeignObject | None:
        kind = self._types.get(each.spec_object_type)
        if kind is None:
            raise UnsoundObjectError(f"the object {each.identifier!r} is of no type")
        type_name = kind.long_name or kind.identifier
        is_ours = kind.identifier in {type_identifier(own) for own in (*[part.value for part in Part], MEASURE)}
        stated = {definition.identifier: definition for definition in kind.attribute_definitions or ()}
        values: dict[str, str] = {}
        losses: dict[str, tuple[int, tuple[str, ...]]] = {}
        line = int(getattr(each.xml_node, "sourceline", None) or 1)
        for value in each.attributes:
            definition = stated.get(value.definition_ref)
            if definition is None:
                raise UnsoundObjectError(f"the object {each.identifier!r} has a value of no attribute of its type")
            long = definition.long_name or definition.identifier
            if value.attribute_type.name == "XHTML":
                rich = from_xhtml(value.xml_node.find("THE-VALUE"), exact=self._exact)
                values[long] = rich.text
                losses[long] = (int(getattr(value.xml_node, "sourceline", None) or line), rich.losses)
            else:
                values[long] = self._text(value)
        for definition in stated.values():
            # The value of an object that has none of its own.
            long = definition.long_name or definition.identifier
            if long not in values and (default := self._default(definition)) is not None:
                values[long] = default
        by_name = {attribute_name(long): text for long, text in values.items()}
        element_id = _id_in(by_name, is_ours=is_ours)
        if not is_ours and not (element_id and by_name.get("text", "").strip()):
            self._nameless[type_name] += 1
            self._attributes.setdefault(type_name, {}).update(dict.fromkeys(values))
            return None
        is_measure = is_ours and kind.identifier == type_identifier(MEASURE)
        part = None if is_measure else self._parts.get(type_name.lower()) or self._known.get(element_id) or self._part
        names = {attribute.name: attribute for attribute in ATTRIBUTES[part]} if part is not None else {}
        cells = {} if is_ours else {"id": element_id}
        for definition in stated.values():
            long = definition.long_name or definition.identifier
            name = attribute_name(long)
            if (name in names and not names[name].holds_ids) or (part is None and name in ("id", "text")):
                cells[name] = element_id if name == "id" else values.get(long, "")
                where, phrases = losses.get(long, (line, ()))
                self.lost += [(where, f"{element_id}: {long}: {phrase}") for phrase in phrases]
                if names and names[name].form is Form.FLAG and cells[name] == "false":
                    cells[name] = ""
            elif is_ours and part is Part.SYSTEM and name in _OF_RECORDS:
                if values.get(long, ""):
                    self.records.setdefault(element_id, {})[name] = values[long]
            elif values.get(long, "").strip() and not (name in EXCHANGE_IDS and values[long].strip() == element_id):
                self._unused.setdefault(long)
        return ForeignObject(
            identifier=each.identifier,
            type_name=MEASURE if is_measure else type_name,
            part=part,
            is_ours=is_ours,
            id=element_id,
            cells=cells,
            line=line,
        )

    def _default(self, definition: Any) -> str | None:
        """Default value of an attribute as text; None if it has none."""
        stated = None if definition.xml_node is None else definition.xml_node.find("DEFAULT-VALUE")
        if stated is None or not len(stated):
            return None
        value = stated[0]
        if value.tag == "ATTRIBUTE-VALUE-XHTML":
            return from_xhtml(value.find("THE-VALUE"), exact=self._exact).text
        if value.tag == "ATTRIBUTE-VALUE-ENUMERATION":
            return self._chosen([each.text for each in value.iterfind("VALUES/ENUM-VALUE-REF")])
        return self._plain(value.get("THE-VALUE", ""))

    def _text(self, value: Any) -> str:
        return self._chosen(value.value) if isinstance(value.value, list) else self._plain(str(value.value))

    def _chosen(self, choices: Sequence[str]) -> str:
        unknown = next((each for each in choices if each not in self._choices), None)
        if unknown is not None:
            raise UnsoundObjectError(f"there is no choice {unknown!r}")
        return "; ".join(self._choices[each] for each in choices)

    def _plain(self, text: str) -> str:
        return text.replace("\\n", "\n") if self._escapes_breaks else text
