"""Every relation of a project by its two ends, each way in words."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from enum import Enum

from rgss.requirements import BlockRelation, LinkKind, TraceLink
from rgss.trace.evidence import TraceEvidence
from rgss.trace.model import TraceModel


class ThingKind(str, Enum):
    """Kind of the thing with an id, in the words of reports."""

    NEED = "stakeholder requirement"
    REQUIREMENT = "system requirement"
    BLOCK = "block"
    BEHAVIOUR = "behaviour"
    MEASURE = "measure"
    TEST = "test"
    RECORD = "verification record"
    TRIAL = "trial"
    CONSTANT = "constant of the measures"
    INPUT = "input of the measures"
    SOURCE = "source of the measures"
    EQUATION = "equation"
    ASSUMPTION = "assumption"


class Relation(str, Enum):
    """One end of a relation, read from the element to its neighbour.

    The first group leads up, towards the need; the second leads down, towards the evidence. Chains list the neighbours
    of an element in this order.
    """

    DERIVES_FROM = "derives from"
    CONTAINED_IN = "is contained in"
    TRACES_TO = "traces to"
    SATISFIES = "satisfies"
    REFINES = "refines"
    PART_OF = "is part of"
    KIND_OF = "is a kind of"
    INCLUDED_IN = "is included in"
    DECIDES = "decides"
    ANSWERS = "answers"
    CONTRIBUTES_TO = "contributes to"
    VERIFIES = "verifies"
    USED_BY = "is used by"
    GIVES = "gives a value of"

    DECIDED_BY = "is decided by"
    COMPUTED_FROM = "is computed from"
    OBSERVED_IN = "is observed in"
    VERIFIED_BY = "is verified by"
    SOURCE_OF = "is the origin of"
    CONTAINS = "contains"
    ANSWERED_BY = "is answered by"
    TRACED_BY = "is traced to by"
    SATISFIED_BY = "is satisfied by"
    REFINED_BY = "is refined by"
    HAS_PART = "has the part"
    HAS_KIND = "has the kind"
    INCLUDES = "includes"
    DOES = "does"
    DONE_BY = "is done by"


@dataclass(frozen=True, slots=True, kw_only=True)
class Neighbour:
    """The other end of a relation."""

    id: str
    relation: Relation


@dataclass(frozen=True, slots=True, kw_only=True)
class Neighbours:
    """Relations of all elements.

    Attributes:
        kinds: Kind of each id.
        up: For each id, its neighbours towards the need.
        down: For each id, its neighbours towards the evidence.
    """

    kinds: Mapping[str, ThingKind]
    up: Mapping[str, Sequence[Neighbour]]
    down: Mapping[str, Sequence[Neighbour]]


def neighbours_of(model: TraceModel, evidence: TraceEvidence) -> Neighbours:
    """Collect every relation of a project: the links of its files, its measures and its tests."""
    book = _Book(kinds_of(model, evidence))
    relations = {block.id: block.relation for block in model.requirements.architecture.blocks}
    measures = {measure.id for measure in model.measures}
    for link in model.links:
        book.note(link, *_ends(link, relations, measures, book.kinds))
    for behaviour in model.requirements.architecture.behaviours:
        for other in behaviour.includes:
            book.put(behaviour.id, Relation.INCLUDES, other, Relation.INCLUDED_IN, upward=False)
    for requirement, software in (evidence.state.software or {}).items():
        for test in software.tests:
            book.put(test.test, Relation.VERIFIES, requirement, Relation.VERIFIED_BY, upward=True)
    for requirement in evidence.state.records:
        book.put(record_name(requirement), Relation.VERIFIES, requirement, Relation.VERIFIED_BY, upward=True)
    return Neighbours(kinds=book.kinds, up=book.up, down=book.down)


def record_name(requirement_id: str) -> str:
    """Name of the verification record of a requirement in a chain."""
    return f"record of {requirement_id}"


class _Book:
    def __init__(self, kinds: Mapping[str, ThingKind]) -> None:
        self.kinds = kinds
        self.up: dict[str, list[Neighbour]] = {}
        self.down: dict[str, list[Neighbour]] = {}

    def note(self, link: TraceLink, there: Relation, back: Relation) -> None:
        # A behaviour is allocated to a block: both look down at the other, since neither requires the other.
        self.put(link.source, there, link.target, back, upward=link.kind is not LinkKind.ALLOCATE)

    def put(self, source: str, there: Relation, target: str, back: Relation, *, upward: bool) -> None:
        if source not in self.kinds or target not in self.kinds:
            return
        out = self.up if upward else self.down
        into = self.up if back in _UPWARD else self.down
        out.setdefault(source, []).append(Neighbour(id=target, relation=there))
        into.setdefault(target, []).append(Neighbour(id=source, relation=back))


_UPWARD = frozenset({Relation.INCLUDED_IN})

_WORDS: Mapping[LinkKind, tuple[Relation, Relation]] = {
    LinkKind.DERIVE: (Relation.DERIVES_FROM, Relation.SOURCE_OF),
    LinkKind.REFINE: (Relation.REFINES, Relation.REFINED_BY),
    LinkKind.SATISFY: (Relation.SATISFIES, Relation.SATISFIED_BY),
    LinkKind.VERIFY: (Relation.DECIDES, Relation.DECIDED_BY),
    LinkKind.ALLOCATE: (Relation.DONE_BY, Relation.DOES),
}


def _ends(
    link: TraceLink,
    relations: Mapping[str, BlockRelation],
    measures: set[str],
    kinds: Mapping[str, ThingKind],
) -> tuple[Relation, Relation]:
    if link.kind is LinkKind.CONTAINMENT:
        if link.source not in relations:
            return Relation.CONTAINED_IN, Relation.CONTAINS
        if relations[link.source] is BlockRelation.KIND:
            return Relation.KIND_OF, Relation.HAS_KIND
        return Relation.PART_OF, Relation.HAS_PART
    if link.kind is LinkKind.TRACE:
        if link.source not in measures:
            return Relation.TRACES_TO, Relation.TRACED_BY
        if kinds.get(link.target) is ThingKind.MEASURE:
            return Relation.CONTRIBUTES_TO, Relation.COMPUTED_FROM
        return Relation.ANSWERS, Relation.ANSWERED_BY
    return _WORDS[link.kind]


def kinds_of(model: TraceModel, evidence: TraceEvidence) -> Mapping[str, ThingKind]:
    """Kind of the thing with each id of a project, without trials and symbols of the measures."""
    architecture = model.requirements.architecture
    kinds = dict.fromkeys(evidence.all_tests(), ThingKind.TEST)
    kinds |= dict.fromkeys(map(record_name, evidence.state.records), ThingKind.RECORD)
    kinds |= dict.fromkeys((measure.id for measure in model.measures), ThingKind.MEASURE)
    kinds |= dict.fromkeys((behaviour.id for behaviour in architecture.behaviours), ThingKind.BEHAVIOUR)
    kinds |= dict.fromkeys((block.id for block in architecture.blocks), ThingKind.BLOCK)
    kinds |= dict.fromkeys((requirement.id for requirement in model.requirements.system), ThingKind.REQUIREMENT)
    kinds |= dict.fromkeys((need.id for need in model.requirements.stakeholder), ThingKind.NEED)
    return kinds
