"""Relations and hierarchy of a ReqIF file as links of elements."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterator, Mapping
from typing import Any, NamedTuple

from rgss.exchange.attributes import Part
from rgss.exchange.reqif.identifiers import relation_type_identifier
from rgss.exchange.reqif.objects import ForeignObject, UnsoundObjectError
from rgss.exchange.reqif.vocabulary import ACTOR, INCLUDE, MEASURE, relation_name
from rgss.requirements import LinkKind

_ANY_REQUIREMENT = (Part.STAKEHOLDER, Part.SYSTEM)


class _LinkRule(NamedTuple):
    """The attribute that states a relation, and what the relation may connect."""

    attribute: str
    sources: tuple[Part | None, ...]
    targets: tuple[Part | None, ...]


# A measure has no part.
_RULES: Mapping[str, _LinkRule] = {
    LinkKind.SATISFY.value: _LinkRule("satisfied_by", (Part.BLOCK, Part.BEHAVIOUR), (Part.SYSTEM,)),
    LinkKind.VERIFY.value: _LinkRule("measure", (None,), (Part.SYSTEM,)),
    LinkKind.DERIVE.value: _LinkRule("derived_from", (Part.SYSTEM,), _ANY_REQUIREMENT),
    LinkKind.TRACE.value: _LinkRule("traces", (Part.SYSTEM,), _ANY_REQUIREMENT),
    LinkKind.ALLOCATE.value: _LinkRule("allocated_to", (Part.BEHAVIOUR,), (Part.BLOCK,)),
    LinkKind.REFINE.value: _LinkRule("refines", (Part.BEHAVIOUR,), (Part.BEHAVIOUR, *_ANY_REQUIREMENT)),
    INCLUDE: _LinkRule("includes", (Part.BEHAVIOUR,), (Part.BEHAVIOUR,)),
    ACTOR: _LinkRule("actors", (Part.BEHAVIOUR,), (Part.BLOCK,)),
}
_TURNED = (LinkKind.SATISFY.value, LinkKind.VERIFY.value)
"""Relations that the element at their target states."""


class RelationReader:
    """Reader of relations, with a list of what could not be imported."""

    def __init__(self, core: Any, objects: Mapping[str, ForeignObject], identifiers: Collection[str]) -> None:
        """Create a reader of a file.

        Args:
            core: The content of the file as read by the library.
            objects: The objects that it may name, by their identifiers.
            identifiers: The identifiers of all such objects, including those that are not imported.
        """
        self._core, self._objects, self._all = core, objects, identifiers
        self._types = {
            each.identifier: each.long_name or each.identifier
            for each in core.spec_types or []
            if type(each).__name__ == "ReqIFSpecRelationType"
        }
        self._left: Counter[str] = Counter()
        """Number of relations that are not imported, by the identifier of their type."""
        self.broken: list[tuple[int, str]] = []
        """Line and message of each relation to a missing object."""
        self.lost: list[tuple[int, str]] = []
        """Line and message of each further position of an element in the hierarchy after its first."""

    @property
    def stated(self) -> frozenset[str]:
        """The attributes that the file states completely, since it has a type for their relation.

        A type of another tool whose relations are not all imported has another meaning there. To be read after `links`.
        """
        found: dict[str, bool] = {}
        for each, name in self._types.items():
            kind = relation_name(name)
            if kind is not None and kind in _RULES:
                is_whole = not self._left[each] or each == relation_type_identifier(kind)
                attribute = _RULES[kind].attribute
                found[attribute] = found.get(attribute, True) and is_whole
        return frozenset(attribute for attribute, is_whole in found.items() if is_whole)

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
                self._left[each.relation_type_ref] += 1
            elif place[1]:
                known = found.setdefault(place, [])
                other = source.id if relation_name(kind) in _TURNED else target.id
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
        left: Counter[str] = Counter()
        for each, count in self._left.items():
            left[self._types[each]] += count
        for kind, count in sorted(left.items()):
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
    if kind == LinkKind.TRACE.value and source.part is Part.BEHAVIOUR:
        return source.id, ""
    rule = _RULES.get(kind)
    if rule is None or source.part not in rule.sources or target.part not in rule.targets:
        return None
    if (source.type_name == MEASURE) != (kind == LinkKind.VERIFY.value):
        return None
    return (target if kind in _TURNED else source).id, rule.attribute
