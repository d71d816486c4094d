"""Relations and hierarchy of a ReqIF file as links of elements."""

from __future__ import annotations

import shlex
from collections import Counter
from collections.abc import Collection, Iterator, Mapping, Sequence
from typing import Any, NamedTuple

from rgss.exchange.attributes import Part
from rgss.exchange.foreign_names import OF_TARGET, RELATION_MEANINGS, ForeignNames
from rgss.exchange.reqif.identifiers import relation_type_identifier
from rgss.exchange.reqif.objects import ForeignObject, UnsoundObjectError
from rgss.exchange.reqif.vocabulary import ACTOR, INCLUDE, MEASURE, relation_name
from rgss.requirements import LinkKind

_ANY_REQUIREMENT = (Part.STAKEHOLDER, Part.SYSTEM)
_PARENT = "parent"


class _Ends(NamedTuple):
    """Parts of the elements that have an attribute of ids, and of those that it names; a measure has no part."""

    holders: tuple[Part | None, ...]
    named: tuple[Part | None, ...]


_ENDS: Mapping[str, _Ends] = {
    "satisfied_by": _Ends((Part.SYSTEM,), (Part.BLOCK, Part.BEHAVIOUR)),
    "measure": _Ends((Part.SYSTEM,), (None,)),
    "derived_from": _Ends((Part.SYSTEM,), _ANY_REQUIREMENT),
    "traces": _Ends((Part.SYSTEM,), _ANY_REQUIREMENT),
    "allocated_to": _Ends((Part.BEHAVIOUR,), (Part.BLOCK,)),
    "refines": _Ends((Part.BEHAVIOUR,), (Part.BEHAVIOUR, *_ANY_REQUIREMENT)),
    "includes": _Ends((Part.BEHAVIOUR,), (Part.BEHAVIOUR,)),
    "actors": _Ends((Part.BEHAVIOUR,), (Part.BLOCK,)),
    _PARENT: _Ends((*_ANY_REQUIREMENT, Part.BLOCK), (*_ANY_REQUIREMENT, Part.BLOCK)),
}
_MEANINGS: Mapping[str, str] = {
    LinkKind.SATISFY.value: f"{OF_TARGET}satisfied_by",
    LinkKind.VERIFY.value: f"{OF_TARGET}measure",
    LinkKind.DERIVE.value: "derived_from",
    LinkKind.TRACE.value: "traces",
    LinkKind.ALLOCATE.value: "allocated_to",
    LinkKind.REFINE.value: "refines",
    INCLUDE: "includes",
    ACTOR: "actors",
}
"""What the relations of rgss state."""


class _Link(NamedTuple):
    """A link that a relation states: the element with the attribute, the attribute, and the id that it names."""

    holder: str
    attribute: str
    named: str


class RelationReader:
    """Reader of relations, with a list of what could not be imported."""

    def __init__(
        self, core: Any, objects: Mapping[str, ForeignObject], identifiers: Collection[str], names: ForeignNames
    ) -> None:
        """Create a reader of a file.

        Args:
            core: The content of the file as read by the library.
            objects: The objects that it may name, by their identifiers.
            identifiers: The identifiers of all such objects, including those that are not imported.
            names: The mapped names of the file.
        """
        self._core, self._objects, self._all, self._mapped = core, objects, identifiers, names
        self._types = {
            each.identifier: each.long_name or each.identifier
            for each in core.spec_types or []
            if type(each).__name__ == "ReqIFSpecRelationType"
        }
        self._left: Counter[str] = Counter()
        """Number of relations that are not imported, by the identifier of their type."""
        self._fitting: dict[str, Counter[str]] = {}
        """Number of these relations that each meaning would take, by the identifier of their type."""
        self._dangling: set[str] = set()
        """Identifiers of the types of relations that name a missing object; all if that of a type is missing."""
        self.lost: list[tuple[int, str]] = []
        """Line and message of each further position of an element in the hierarchy after its first, and of what names
        a missing object."""

    @property
    def type_names(self) -> tuple[str, ...]:
        """The names of all types of relations."""
        return tuple(self._types.values())

    @property
    def stated(self) -> frozenset[str]:
        """The attributes that the file states completely, since it has a type for their relation.

        A type of another tool whose relations are not all imported has another meaning there. To be read after `links`.
        """
        found: dict[str, bool] = {}
        for each, name in self._types.items():
            is_own = each == relation_type_identifier(relation_name(name) or "")
            is_whole = each not in self._dangling and (is_own or not self._left[each])
            for meaning in self._meanings(name):
                attribute = meaning.removeprefix(OF_TARGET)
                found[attribute] = found.get(attribute, True) and is_whole
        return frozenset(attribute for attribute, is_whole in found.items() if is_whole)

    def _meanings(self, type_name: str) -> tuple[str, ...]:
        """What a relation of a type may state: by the mapping, else by its name."""
        mapped = self._mapped.links_of(type_name)
        if mapped is not None:
            return mapped
        own = _MEANINGS.get(relation_name(type_name) or "")
        return () if own is None else (own,)

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
                self.lost.append((line, f"the relation {each.identifier!r} is not imported: the {what} does not exist"))
                self._dangling.update(self._types if kind is None else {each.relation_type_ref})
                continue
            source, target = self._objects.get(each.source), self._objects.get(each.target)
            if self._mapped.links_of(kind) == () or _is_implied(relation_name(kind), source):
                continue
            link = _link(self._meanings(kind), source, target)
            if link is None:
                self._left[each.relation_type_ref] += 1
                fitting = [one for one in RELATION_MEANINGS if _link((one,), source, target) is not None]
                self._fitting.setdefault(each.relation_type_ref, Counter()).update(fitting)
                continue
            known = found.setdefault((link.holder, link.attribute), [])
            if link.named not in known:
                known.append(link.named)
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
                self.lost.append((line, f"the hierarchy names the object {node.spec_object!r}, which does not exist"))
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
        fitting: dict[str, Counter[str]] = {}
        for each, count in self._left.items():
            left[self._types[each]] += count
            fitting.setdefault(self._types[each], Counter()).update(self._fitting[each])
        for kind, count in sorted(left.items()):
            relations = "1 relation of type {} is" if count == 1 else f"{count} relations of type {{}} are"
            said = f"{relations.format(repr(kind))} not imported: rgss has no such link between such elements"
            yield said + _option(kind, self._meanings(kind), fitting[kind])


class Parent(NamedTuple):
    """Parent of an element.

    Attributes:
        id: Its id; empty if the element is at the top.
        losses: A message for each further parent.
        is_elsewhere: True if the element is in another one in the hierarchy.
    """

    id: str
    losses: tuple[str, ...]
    is_elsewhere: bool


def parent_of(stated: Sequence[str], around: str, element_id: str) -> Parent:
    """The parent of an element: what is mapped to it counts before the hierarchy.

    Args:
        stated: The ids that a mapped attribute or relation names.
        around: The id of the element around it in the hierarchy; empty if there is none.
        element_id: Its id.
    """
    first = stated[0] if stated else around
    others = dict.fromkeys(each for each in stated if each != first)
    losses = tuple(f"{element_id}: it is under {first!r} and under {other!r}; {first!r} is kept" for other in others)
    return Parent(first, losses, is_elsewhere=bool(around) and around != first)


def _option(kind: str, present: Sequence[str], fitting: Counter[str]) -> str:
    """The option that takes most relations of a type that are not imported; empty if none takes any."""
    if not fitting:
        return ""
    most = max(fitting.values())
    meaning = next(one for one in RELATION_MEANINGS if fitting[one] == most)
    if all(mine.removeprefix(OF_TARGET) != meaning.removeprefix(OF_TARGET) for mine in present):
        # What else the type means, by its name or the mapping, is not undone by the new option.
        meanings = [*present, meaning]
    else:
        meanings = [meaning]
    options = " ".join(f"--map-relation {shlex.quote(f'{kind}={one}')}" for one in meanings)
    return f" ({options} takes such)"


def _require_names(*references: str | None) -> None:
    """Check that no reference is empty.

    Raises:
        UnsoundObjectError: One of them is empty.
    """
    if not all(references):
        raise UnsoundObjectError("a reference is empty")


def _is_implied(kind: str | None, source: ForeignObject | None) -> bool:
    """True for a relation that another attribute of its source implies."""
    return kind == LinkKind.TRACE.value and source is not None and source.part is Part.BEHAVIOUR


def _link(meanings: Sequence[str], source: ForeignObject | None, target: ForeignObject | None) -> _Link | None:
    """The link that a relation states by the first meaning that fits its ends; None if none does."""
    if source is None or target is None:
        return None
    for meaning in meanings:
        attribute = meaning.removeprefix(OF_TARGET)
        holder, named = (target, source) if meaning.startswith(OF_TARGET) else (source, target)
        if _fits(attribute, holder, named):
            return _Link(holder.id, attribute, named.id)
    return None


def _fits(attribute: str, holder: ForeignObject, named: ForeignObject) -> bool:
    ends = _ENDS[attribute]
    if holder.part not in ends.holders or named.part not in ends.named:
        return False
    if attribute == _PARENT:
        return holder.part is named.part and holder.id != named.id
    return (named.type_name == MEASURE) == (attribute == "measure")
