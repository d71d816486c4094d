"""Relations and hierarchy of a ReqIF file as links of elements."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping
from typing import Any

from rgss.exchange.attributes import Part
from rgss.exchange.reqif.objects import ForeignObject, UnsoundObjectError
from rgss.exchange.reqif.vocabulary import ACTOR, INCLUDE, MEASURE, relation_name
from rgss.requirements import LinkKind

_TURNED: Mapping[str, str] = {LinkKind.SATISFY.value: "satisfied_by", LinkKind.VERIFY.value: "measure"}
_SYSTEM: Mapping[str, str] = {LinkKind.DERIVE.value: "derived_from", LinkKind.TRACE.value: "traces"}
_BEHAVIOUR: Mapping[str, str] = {
    LinkKind.ALLOCATE.value: "allocated_to",
    LinkKind.REFINE.value: "refines",
    INCLUDE: "includes",
    ACTOR: "actors",
}


class RelationReader:
    """Reader of relations, with a list of what could not be imported."""

    def __init__(self, core: Any, objects: Mapping[str, ForeignObject]) -> None:
        """Create a reader of a file.

        Args:
            core: The content of the file as read by the library.
            objects: Its objects by their identifiers.
        """
        self._core, self._objects = core, objects
        self._types = {
            each.identifier: each.long_name or each.identifier
            for each in core.spec_types or []
            if type(each).__name__ == "ReqIFSpecRelationType"
        }
        self._all = {each.identifier for each in core.spec_objects or []}
        self._left: Counter[str] = Counter()
        self.broken: list[tuple[int, str]] = []
        """Line and message of each relation to a missing object."""
        self.lost: list[tuple[int, str]] = []
        """Line and message of each further position of an element in the hierarchy after its first."""

    @property
    def stated(self) -> frozenset[str]:
        """The attributes that the file states completely, since it has a type for their relation."""
        kinds = {relation_name(name) for name in self._types.values()}
        tables = (_TURNED, _SYSTEM, _BEHAVIOUR)
        return frozenset(name for table in tables for kind, name in table.items() if kind in kinds)

    def links(self) -> dict[tuple[str, str], list[str]]:
        """The ids that an attribute of an element names, in the file's order."""
        found: dict[tuple[str, str], list[str]] = {}
        for each in self._core.spec_relations or []:
            _require_names(each.source, each.target, each.relation_type_ref)
            kind = self._types.get(each.relation_type_ref)
            missing = [end for end in (each.source, each.target) if end not in self._all]
            line = int(getattr(each.xml_node, "sourceline", None) or 1)
            if kind is None or missing:
                what = f"object {missing[0]!r}" if missing else f"type {each.relation_type_ref!r}"
                self.broken.append((line, f"the relation {each.identifier!r} names the {what}, which does not exist"))
                continue
            source, target = self._objects.get(each.source), self._objects.get(each.target)
            place = None if source is None or target is None else _place(relation_name(kind), source, target)
            if place is None or source is None or target is None:
                self._left[kind] += 1
            elif place[1]:
                known = found.setdefault(place, [])
                other = source.id if place[0] == target.id and place[1] in _TURNED.values() else target.id
                if other not in known:
                    known.append(other)
        return found

    def containment(self) -> dict[str, str]:
        """Id of the containing element of each contained element; the first in the file if there are several."""
        found: dict[str, str] = {}
        pending: list[tuple[Any, ForeignObject | None]] = [
            (child, None) for each in self._core.specifications or [] for child in each.children or ()
        ]
        pending.reverse()
        while pending:
            node, around = pending.pop()
            line = int(getattr(node.xml_node, "sourceline", None) or 1)
            _require_names(node.spec_object)
            if node.spec_object not in self._all:
                message = f"the hierarchy names the object {node.spec_object!r}, which does not exist"
                self.broken.append((line, message))
            here = self._objects.get(node.spec_object)
            if here is not None and around is not None and here.part is around.part and here.part is not None:
                first = found.setdefault(here.id, around.id)
                if first != around.id:
                    message = f"{here.id}: it is under {first!r} and under {around.id!r}; {first!r} is kept"
                    self.lost.append((line, message))
            pending += [(child, here or around) for child in reversed(node.children or ())]
        return found

    def notes(self) -> Iterator[str]:
        """Notes on content that was not imported."""
        for kind, count in sorted(self._left.items()):
            yield f"{count} relations of type {kind!r} are not imported: rgss has no such link between such elements"


def _require_names(*references: str | None) -> None:
    """Check that no reference is empty.

    Raises:
        UnsoundObjectError: One of them is empty.
    """
    if not all(references):
        raise UnsoundObjectError("a reference is empty")


def _place(kind: str | None, source: ForeignObject, target: ForeignObject) -> tuple[str, str] | None:
    """The element and the attribute that state a relation; no attribute if another attribute implies it."""
    if kind is None:
        return None
    if kind in _TURNED and target.part is Part.SYSTEM:
        fits = (source.type_name == MEASURE) == (kind == LinkKind.VERIFY.value)
        return (target.id, _TURNED[kind]) if fits else None
    if source.part is Part.SYSTEM and kind in _SYSTEM:
        return source.id, _SYSTEM[kind]
    if source.part is Part.BEHAVIOUR and kind in _BEHAVIOUR:
        return source.id, _BEHAVIOUR[kind]
    if source.part is Part.BEHAVIOUR and kind == LinkKind.TRACE.value:
        return source.id, ""
    return None
