"""Reader of ReqIF files of any tool."""

from __future__ import annotations

import re
from collections import ChainMap
from collections.abc import Collection, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from rgss.errors import DefinitionError, DocumentError
from rgss.exchange.attributes import ATTRIBUTES, Part
from rgss.exchange.cells import ids_in, joined
from rgss.exchange.content import Content, Row
from rgss.exchange.files import LARGEST_REQIF_BYTES, problem, read_bytes, refusal_of
from rgss.exchange.foreign_names import ForeignNames
from rgss.exchange.reqif.archive import is_archive, reqif_members
from rgss.exchange.reqif.objects import ForeignObject, ObjectReader, UnsoundObjectError
from rgss.exchange.reqif.relations import Parent, RelationReader, parent_of
from rgss.exchange.reqif.structure import structure_problems
from rgss.exchange.reqif.unread import unread_notes
from rgss.exchange.reqif.vocabulary import MEASURE
from rgss.exchange.xml_guard import in_utf8, require_plain_xml
from rgss.findings import Severity

_PREFIXED_ROOT = re.compile(r"\s*(?:<\?xml\s.*?\?>)?\s*<(?P<prefix>[A-Za-z_][\w.-]*):REQ-IF\b[^>]*>", re.DOTALL)
_NO_CONTENT = re.compile(r"(<!\[CDATA\[.*?\]\]>|<\?xml\s.*?\?>)|<!--.*?-->|<\?.*?\?>", re.DOTALL)

_SPACED_REFERENCE = re.compile(r"(-REF>)(\s*)([^<\s]+)(\s*)(</[^>]*-REF>)")


def read_reqif(
    path: Path,
    *,
    known: Mapping[str, Part] | None = None,
    part: Part | None = None,
    names: ForeignNames | None = None,
) -> Content:
    """Read requirements, architecture and measures from ReqIF.

    Attributes and relations of other tools are recognised by their names, or mapped; what is not
    recognised is reported in the notes.

    Args:
        path: The file.
        known: Part of each element of the project, by id, for types of other tools.
        part: Part of elements that are neither known nor of a type of rgss.
        names: The mapped names of the file.

    Raises:
        DefinitionError: The package reqif is not installed.
        DocumentError: The file cannot be read, is not ReqIF, or has a document type, an entity or
            a relation to a missing object.
    """
    file = str(path)
    content = read_bytes(path, limit=LARGEST_REQIF_BYTES)
    members = list(reqif_members(content, file)) if is_archive(content) else [("", content)]
    context = _Context(known=known or {}, part=part, names=names or ForeignNames())
    opened = [_opened(inner, f"{file} ({name})" if name else file, context) for name, inner in members]
    contents = _contents(opened, context.names)
    if not is_archive(content):
        return contents[0]
    read = list(zip((name for name, _ in members), contents, strict=True))
    return Content(
        rows=tuple(replace(row, file=each.file) for _, each in read for row in each.rows),
        measures=tuple({measure[0]: measure for _, each in read for measure in each.measures}.values()),
        records=ChainMap({}, *(dict(each.records) for _, each in read)),
        whole=frozenset(kind for _, each in read for kind in each.whole),
        notes=tuple(f"{name}: {note}" if len(read) > 1 else note for name, each in read for note in each.notes),
        losses=tuple(loss for _, each in read for loss in each.losses),
        names=tuple(dict.fromkeys(name for _, each in read for name in each.names)),
        relations=tuple(dict.fromkeys(name for _, each in read for name in each.relations)),
        file=file,
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class _Context:
    """Statements of the project and the user about the objects of a file."""

    known: Mapping[str, Part]
    part: Part | None
    names: ForeignNames


@dataclass(frozen=True, slots=True, kw_only=True)
class _OpenFile:
    """A file whose objects are read, and whose relations may name objects of the other files of its archive."""

    file: str
    content: bytes
    core: Any
    reader: ObjectReader
    objects: dict[str, ForeignObject]


def _contents(opened: Sequence[_OpenFile], names: ForeignNames) -> list[Content]:
    """The contents of files that belong together."""
    objects = {name: each for one in opened for name, each in one.objects.items()}
    identifiers = frozenset(each.identifier for one in opened for each in one.core.spec_objects or [])
    relations = [RelationReader(one.core, ChainMap(one.objects, objects), identifiers, names) for one in opened]
    parents: dict[str, str] = {}
    links: dict[tuple[str, str], list[str]] = {}
    for one, reader in zip(opened, relations, strict=True):
        with _described(one.content, one.file):
            parents = {**reader.containment(), **parents}
            for place, others in reader.links().items():
                links[place] = list(dict.fromkeys((*links.get(place, ()), *others)))
    return [_content(one, reader, parents, links) for one, reader in zip(opened, relations, strict=True)]


def _opened(content: bytes, file: str, context: _Context) -> _OpenFile:
    content = in_utf8(content, file)
    require_plain_xml(content, file)
    bundle = _parsed(content, file)
    core = getattr(bundle.core_content, "req_if_content", None)
    if core is None:
        raise DocumentError([problem(file, "empty", "has no content of ReqIF")])
    with _described(content, file):
        reader = ObjectReader(bundle, context.known, context.part, context.names)
        objects = reader.read(core.spec_objects or [])
    return _OpenFile(file=file, content=content, core=core, reader=reader, objects=objects)


@contextmanager
def _described(content: bytes, file: str) -> Iterator[None]:
    """Turns the errors of the library, on a file that departs from the schema, into one that describes the file."""
    try:
        yield
    except (AttributeError, IndexError, KeyError, TypeError, ValueError) as error:
        raise _unreadable(content, file, error) from None


def _content(
    one: _OpenFile,
    relations: RelationReader,
    parents: Mapping[str, str],
    links: Mapping[tuple[str, str], Sequence[str]],
) -> Content:
    found = one.objects.values()
    elements = [each for each in found if each.part is not None or each.type_name != MEASURE]
    stated = relations.stated
    rows = [_row(each, links, parents, stated) for each in elements]
    elsewhere = sum(parent.is_elsewhere for _, parent in rows)
    return Content(
        rows=tuple(row for row, _ in rows),
        measures=tuple((each.id, each.cells.get("text", "")) for each in found if each.type_name == MEASURE),
        records=one.reader.records,
        whole=frozenset(one.reader.own_parts),
        notes=(*one.reader.omissions.notes(), *relations.notes(), *_elsewhere(elsewhere), *unread_notes(one.core)),
        losses=tuple(
            problem(one.file, "loss", message, line=line, severity=Severity.WARNING)
            for line, message in sorted((*one.reader.omissions.lost, *relations.lost, *_of_parents(rows)))
        ),
        names=tuple(one.reader.names),
        relations=relations.type_names,
        file=one.file,
    )


def _parsed(content: bytes, file: str) -> Any:
    try:
        from rgss.exchange.reqif import library
    except ImportError as error:
        raise DefinitionError(
            "ReqIF needs the package reqif, which is not installed", hint="pip install 'rgss[exchange]'"
        ) from error
    try:
        bundle = library.ReqIFParser.parse_from_string(_content_alone(content.decode("utf-8-sig")))
    # On a file that is not ReqIF the library raises many undocumented exceptions.
    except Exception as error:
        raise _unreadable(content, file, error) from None
    if bundle.exceptions:
        raise _unreadable(content, file, None, line=_line(bundle.exceptions[0]))
    return bundle


def _content_alone(text: str) -> str:
    """The XML without comments and processing instructions, which the library takes for elements.

    The blanks around a reference follow it, outside of its element: by the schema they are no part of it.
    """
    # Well-formed XML has none of them within a tag, so that only CDATA sections could look like one.
    content = _NO_CONTENT.sub(lambda match: match[1] or "\n" * match[0].count("\n"), text)
    return _without_prefix(_SPACED_REFERENCE.sub(r"\1\3\5\2\4", content))


def _without_prefix(text: str) -> str:
    """The XML with the namespace of ReqIF as its default one, which the library expects.

    Unchanged if the file has another default namespace.
    """
    root = _PREFIXED_ROOT.match(text)
    if root is None or re.search(r"\sxmlns=", root[0]):
        return text
    prefix = re.escape(root["prefix"])
    unnamed = re.sub(rf"(</?){prefix}:(?=[A-Z])", r"\1", text)
    return re.sub(rf"\sxmlns:{prefix}=", " xmlns=", unnamed, count=1)


def _unreadable(content: bytes, file: str, error: Exception | None, *, line: int = 1) -> DocumentError:
    """Error for a file that cannot be read, since the messages of the library are about its code."""
    found = structure_problems(content, file)
    if found:
        return refusal_of(found)
    reason = f": {error}" if isinstance(error, UnsoundObjectError) else ": it departs from the schema of ReqIF"
    message = f"is XML, but not ReqIF that can be read{reason}"
    return DocumentError([problem(file, "syntax", message, line=line, hint="validate it with the tool that wrote it")])


def _line(error: Any) -> int:
    return int(getattr(getattr(error, "xml_node", None), "sourceline", None) or 1)


def _of_parents(rows: Sequence[tuple[Row, Parent]]) -> Iterator[tuple[int, str]]:
    """Line and message of each further parent of an element."""
    for row, parent in rows:
        yield from ((row.line, loss) for loss in parent.losses)


def _elsewhere(count: int) -> Iterator[str]:
    if count:
        elements = "1 element" if count == 1 else f"{count} elements"
        yield f"the place of {elements} in the hierarchy is not imported: what is mapped to the parent names another"


def _row(
    each: ForeignObject,
    links: Mapping[tuple[str, str], Sequence[str]],
    parents: Mapping[str, str],
    stated: frozenset[str],
) -> tuple[Row, Parent]:
    """An element with its links, and its parent."""
    cells = dict(each.cells)
    names = {attribute.name: attribute for attribute in ATTRIBUTES.get(each.part, ())} if each.part else {}
    # What another file of the archive or a relation states is taken over, and no other link removed for it.
    linked = {name for name in names if (each.id, name) in links}
    cells.update(_linked(each, links, ((stated & names.keys()) | linked) - {"parent"}))
    mapped = [*ids_in(cells.get("parent", "")), *links.get((each.id, "parent"), ())]
    parent = parent_of(mapped, parents.get(each.id, "") if "parent" in names else "", each.id)
    if "parent" in names and (each.is_ours or parent.id or "parent" in stated):
        cells["parent"] = parent.id
    return Row(part=each.part, cells=cells, line=each.line), parent


def _linked(
    each: ForeignObject, links: Mapping[tuple[str, str], Sequence[str]], names: Collection[str]
) -> Iterator[tuple[str, str]]:
    for name in sorted(names):
        # An attribute of ids may be mapped, too.
        yield name, joined(list(dict.fromkeys((*ids_in(each.cells.get(name, "")), *links.get((each.id, name), ())))))
