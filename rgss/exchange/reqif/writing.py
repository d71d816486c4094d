"""Writer of ReqIF: the same content gives the same bytes."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Sequence
from typing import Any

from rgss.errors import DefinitionError
from rgss.exchange.attributes import ATTRIBUTES, Attribute, Form, Part
from rgss.exchange.cells import ids_in
from rgss.exchange.content import Content, Row
from rgss.exchange.reqif.hierarchy import hierarchies
from rgss.exchange.reqif.identifiers import (
    FLAG,
    STRING,
    XHTML,
    choice_identifier,
    data_type_identifier,
    object_identifier,
    relation_type_identifier,
    type_identifier,
)
from rgss.exchange.reqif.prose import as_xhtml, escaped
from rgss.exchange.reqif.vocabulary import (
    ACTOR,
    INCLUDE,
    MEASURE,
    NO_TIME,
    RELATIONS,
    TOOL,
    TYPE_NAMES,
    identifier,
    is_relation,
    is_string,
    long_name,
)
from rgss.exchange.verification_records import RECORD_ATTRIBUTES
from rgss.requirements import LinkKind

# A quarter of the file is indentation. Texts have no line break before a "<", see `as_xhtml`.
_INDENTATION = re.compile(r">\n +<")
_LONGEST_STRING = "100000"
_MEASURE_ATTRIBUTES = (
    Attribute(name="id", path=("id",), form=Form.LINE),
    Attribute(name="text", path=("text",), form=Form.PROSE),
)


def reqif_text(content: Content, *, title: str) -> str:
    """Write requirements, architecture and measures as ReqIF.

    Attributes are attributes, containment is the hierarchy, and every other relation is one of
    ReqIF. Identifiers follow from ids; there are no times.

    Args:
        content: The project.
        title: The title in the header.

    Raises:
        DefinitionError: The package reqif is not installed, a text has a character that XML does not allow, or
            elements are nested deeper than an import reads.
    """
    models = _library()
    measures = dict(content.measures)
    for row in content.rows:
        measures |= dict.fromkeys(ids_in(row.cells.get("measure", "")), "") | measures
    objects = [
        (_part(row).value, row.id, _attributes_of(_part(row)), {**row.cells, **content.records.get(row.id, {})})
        for row in content.rows
    ]
    objects += [(MEASURE, name, _MEASURE_ATTRIBUTES, {"id": name, "text": text}) for name, text in measures.items()]
    bundle = models.ReqIFBundle(
        namespace_info=models.ReqIFNamespaceInfo(
            original_reqif_tag_dump=None,
            doctype_is_present=True,
            encoding="UTF-8",
            namespace=models.ReqIFNamespaceInfo.REQIF_XSD,
            configuration=None,
            namespace_id=None,
            namespace_xhtml="http://www.w3.org/1999/xhtml",
            schema_namespace=None,
            schema_location=None,
            language=None,
        ),
        req_if_header=models.ReqIFReqIFHeader(
            identifier=identifier("header"),
            comment="Requirements and architecture; containment is the hierarchy.",
            creation_time=NO_TIME,
            req_if_tool_id=TOOL,
            req_if_version="1.0",
            source_tool_id=TOOL,
            title=_title(title),
        ),
        core_content=models.ReqIFCoreContent(
            models.ReqIFReqIFContent(
                data_types=list(_data_types(models)),
                spec_types=list(_spec_types(models)),
                spec_objects=[_object(models, *each) for each in objects],
                spec_relations=list(_relations(models, content.rows)),
                specifications=list(_specifications(models, content.rows, list(measures))),
            )
        ),
        tool_extensions_tag_exists=False,
        lookup=models.ReqIFObjectLookup.empty(),
        exceptions=[],
    )
    return _INDENTATION.sub(">\n<", str(models.ReqIFUnparser.unparse(bundle)))


def _title(text: str) -> str:
    """A title for the library, which escapes ampersands only."""
    escaped(text, "the title")
    return text.replace("<", "‹").replace(">", "›")


def _library() -> Any:
    try:
        from rgss.exchange.reqif import library
    except ImportError as error:
        raise DefinitionError(
            "ReqIF needs the package reqif, which is not installed", hint="pip install 'rgss[exchange]'"
        ) from error
    return library


def _part(row: Row) -> Part:
    if row.part is None:
        raise ValueError("an element of the project has a part")
    return row.part


def _attributes_of(part: Part) -> tuple[Attribute, ...]:
    """The attributes of a type of objects; system requirements have those of their verification records too."""
    return (*ATTRIBUTES[part], *(RECORD_ATTRIBUTES if part is Part.SYSTEM else ()))


def _data_types(models: Any) -> Iterator[Any]:
    yield models.ReqIFDataTypeDefinitionString(
        identifier=identifier(*STRING), last_change=NO_TIME, long_name="String", max_length=_LONGEST_STRING
    )
    yield models.ReqIFDataTypeDefinitionXHTML(
        identifier=identifier(*XHTML), last_change=NO_TIME, long_name="XHTML", is_self_closed=True
    )
    yield models.ReqIFDataTypeDefinitionBoolean(identifier=identifier(*FLAG), last_change=NO_TIME, long_name="Boolean")
    for part in ATTRIBUTES:
        for attribute in _attributes_of(part):
            if attribute.form is Form.CHOICE:
                yield models.ReqIFDataTypeDefinitionEnumeration(
                    identifier=identifier("data", part.value, attribute.name),
                    last_change=NO_TIME,
                    long_name=f"{TYPE_NAMES[part]}: {attribute.name}",
                    values=[
                        models.ReqIFEnumValue(
                            identifier=choice_identifier(part.value, attribute, choice),
                            key=str(number),
                            last_change=NO_TIME,
                            long_name=choice,
                            other_content="",
                        )
                        for number, choice in enumerate(attribute.choices)
                    ],
                )


def _spec_types(models: Any) -> Iterator[Any]:
    for part, name in TYPE_NAMES.items():
        yield _object_type(models, part.value, name, _attributes_of(part))
    yield _object_type(models, MEASURE, MEASURE, _MEASURE_ATTRIBUTES)
    for relation in RELATIONS:
        yield models.ReqIFSpecRelationType(
            identifier=relation_type_identifier(relation), last_change=NO_TIME, long_name=relation
        )
    yield models.ReqIFSpecificationType(
        identifier=identifier("specification type"),
        last_change=NO_TIME,
        long_name="Hierarchy",
        is_self_closed=True,
    )


def _object_type(models: Any, type_name: str, name: str, attributes: Sequence[Attribute]) -> Any:
    return models.ReqIFSpecObjectType(
        identifier=type_identifier(type_name),
        last_change=NO_TIME,
        long_name=name,
        attribute_definitions=[
            models.SpecAttributeDefinition(
                attribute_type=_kind(models, attribute),
                identifier=identifier("attribute", type_name, attribute.name),
                datatype_definition=data_type_identifier(type_name, attribute),
                last_change=NO_TIME,
                long_name=long_name(attribute),
                multi_valued=False if attribute.form is Form.CHOICE else None,
            )
            for attribute in attributes
            if not is_relation(attribute)
        ],
    )


def _kind(models: Any, attribute: Attribute) -> Any:
    kinds = models.SpecObjectAttributeType
    if attribute.form is Form.CHOICE:
        return kinds.ENUMERATION
    if attribute.form is Form.FLAG:
        return kinds.BOOLEAN
    return kinds.STRING if is_string(attribute) else kinds.XHTML


def _object(models: Any, type_name: str, name: str, attributes: Sequence[Attribute], cells: Any) -> Any:
    return models.ReqIFSpecObject(
        identifier=object_identifier(name),
        last_change=NO_TIME,
        spec_object_type=type_identifier(type_name),
        attributes=[
            models.SpecObjectAttribute(
                attribute_type=_kind(models, attribute),
                definition_ref=identifier("attribute", type_name, attribute.name),
                value=_value(type_name, attribute, cells[attribute.name], f"{name}: {attribute.name}"),
            )
            for attribute in attributes
            if not is_relation(attribute) and cells.get(attribute.name)
        ],
    )


def _value(type_name: str, attribute: Attribute, cell: str, where: str) -> str | list[str]:
    if attribute.form is Form.CHOICE:
        return [choice_identifier(type_name, attribute, cell)]
    if attribute.form is Form.FLAG or is_string(attribute):
        escaped(cell, where)  # the library escapes strings itself
        return cell
    return as_xhtml(cell, where)


def _relations(models: Any, rows: Sequence[Row]) -> Iterator[Any]:
    seen: set[tuple[str, str, str]] = set()
    for row in rows:
        for relation in _relations_of(row):
            if relation in seen:
                continue
            seen.add(relation)
            kind, source, target = relation
            yield models.ReqIFSpecRelation(
                identifier=identifier("relation", kind, source, target),
                last_change=NO_TIME,
                relation_type_ref=relation_type_identifier(kind),
                source=object_identifier(source),
                target=object_identifier(target),
            )


def _relations_of(row: Row) -> Iterator[tuple[str, str, str]]:
    """Kind, source and target of the relations of a row."""
    for attribute in ATTRIBUTES[_part(row)]:
        if not is_relation(attribute) or attribute.link is LinkKind.CONTAINMENT:
            continue
        kind = {"includes": INCLUDE, "actors": ACTOR}.get(attribute.name) or (
            attribute.link.value if attribute.link is not None else attribute.name
        )
        for other in ids_in(row.cells[attribute.name]):
            turned = attribute.link in (LinkKind.SATISFY, LinkKind.VERIFY)
            yield (kind, other, row.id) if turned else (kind, row.id, other)
    if row.cells.get("interaction"):
        # A sequence traces to the requirements whose criteria bound its times.
        for timing in json.loads(row.cells["interaction"])["timings"]:
            yield LinkKind.TRACE.value, row.id, timing["criterion_of"]


def _specifications(models: Any, rows: Sequence[Row], measures: Sequence[str]) -> Iterator[Any]:
    for part, title in TYPE_NAMES.items():
        mine = [row for row in rows if row.part is part]
        inner: dict[str, list[str]] = {}
        for row in mine:
            inner.setdefault(row.cells.get("parent", ""), []).append(row.id)
        yield _specification(models, part.value, title, hierarchies(models, part.value, inner))
    yield _specification(models, MEASURE, MEASURE, hierarchies(models, MEASURE, {"": list(measures)}))


def _specification(models: Any, name: str, title: str, children: list[Any]) -> Any:
    return models.ReqIFSpecification(
        identifier=identifier("specification", name),
        last_change=NO_TIME,
        long_name=f"{title}s",
        specification_type=identifier("specification type"),
        children=children,
    )
