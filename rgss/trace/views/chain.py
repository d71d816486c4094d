"""The chain of one id: up to the need, and down to the trials and tests that decide."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from rgss.measures import MeasureSet
from rgss.trace.evidence import TraceEvidence
from rgss.trace.model import TraceModel
from rgss.trace.views.descriptions import Descriptions
from rgss.trace.views.naming import Named, named
from rgss.trace.views.neighbours import Neighbour, Neighbours, Relation, ThingKind, neighbours_of


@dataclass(frozen=True, slots=True, kw_only=True)
class ChainStep:
    """One step of a chain.

    Attributes:
        depth: Number of steps from the id of the chain, from 1.
        relation: Relation of the previous step's element to this one.
        id: Its id.
        kind: Its kind.
        text: Its text or name.
        note: Its evidence; may be empty.
        repeated: True if its own steps are listed earlier in the chain.
    """

    depth: int
    relation: Relation
    id: str
    kind: ThingKind
    text: str
    note: str
    repeated: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class Chain:
    """Chain of the elements linked to one id, upwards and downwards.

    Attributes:
        id: The id.
        kind: Its kind.
        text: Its text or name.
        note: Its evidence; may be empty.
        up: Steps towards the need, in order of traversal.
        down: Steps towards the evidence, in order of traversal.
    """

    id: str
    kind: ThingKind
    text: str
    note: str
    up: tuple[ChainStep, ...]
    down: tuple[ChainStep, ...]


def chain_of(model: TraceModel, evidence: TraceEvidence, name: str, *, definitions: MeasureSet | None = None) -> Chain:
    """Follow every link of an id, both ways.

    Args:
        model: The project's requirements, architecture and measures.
        evidence: Evidence of the project.
        name: Id of a need, a requirement, a block, a behaviour, a measure or a test; a trial as
            ``28/1`` or the beginning of its key; with definitions also a symbol or a source of
            the measures, such as ``mu`` or ``design.tool_speed``.
        definitions: The definitions of the measures, for names and dependencies.

    Raises:
        DefinitionError: The id is unknown.
    """
    root = named(model, evidence, name, definitions=definitions)
    neighbours = neighbours_of(model, evidence)
    describe = Descriptions(model, evidence, definitions)
    up = _steps(root, _upward(root, neighbours), neighbours.kinds, describe)
    down = _steps(root, _downward(neighbours, evidence), neighbours.kinds, describe)
    return Chain(
        id=root.id,
        kind=root.kind,
        text=describe.text(root.id, root.kind),
        note=describe.note(root.id, root.kind),
        up=tuple(up),
        down=tuple(down),
    )


_Next = Callable[[str], Sequence[Neighbour]]

_PARTS = frozenset({Relation.HAS_PART, Relation.HAS_KIND})
_WHOLES = frozenset({Relation.PART_OF, Relation.KIND_OF})
_NOTHING: frozenset[Relation] = frozenset()
_ONWARD: Mapping[Relation, frozenset[Relation]] = {
    Relation.PART_OF: _WHOLES,
    Relation.KIND_OF: _WHOLES,
    Relation.HAS_PART: _PARTS,
    Relation.HAS_KIND: _PARTS,
    Relation.INCLUDED_IN: _NOTHING,
    Relation.INCLUDES: _NOTHING,
    Relation.DOES: _NOTHING,
    Relation.DONE_BY: _NOTHING,
    Relation.SATISFIED_BY: _NOTHING,
    Relation.REFINED_BY: _NOTHING,
    Relation.TRACED_BY: _NOTHING,
    Relation.COMPUTED_FROM: _NOTHING,
}
"""Relations that may continue a chain after another one, if not all: a chain must not wander through
the architecture, nor through the inside of a measure, when something else was requested."""


def _upward(root: Named, neighbours: Neighbours) -> _Next:
    def above(name: str) -> Sequence[Neighbour]:
        if name == root.id and root.used_by:
            relation = Relation.GIVES if root.kind is ThingKind.TRIAL else Relation.USED_BY
            return [Neighbour(id=measure, relation=relation) for measure in root.used_by]
        return neighbours.up.get(name, ())

    return above


def _downward(neighbours: Neighbours, evidence: TraceEvidence) -> _Next:
    def below(name: str) -> Sequence[Neighbour]:
        found = neighbours.down.get(name, ())
        if evidence.shown is None or neighbours.kinds.get(name) is not ThingKind.MEASURE:
            return found
        trials = evidence.shown.deciding_trials(name)
        return [*found, *(Neighbour(id=trial.key, relation=Relation.OBSERVED_IN) for trial in trials)]

    return below


def _steps(
    root: Named, following: _Next, kinds: Mapping[str, ThingKind], describe: Descriptions
) -> Iterator[ChainStep]:
    """Walk depth first, without recursion, with the steps of each element once."""
    order = {relation: index for index, relation in enumerate(Relation)}
    shown: set[str] = {root.id}

    def onward(name: str, by: Relation | None) -> list[Neighbour]:
        allowed = None if by is None else _ONWARD.get(by)
        found = [step for step in following(name) if allowed is None or step.relation in allowed]
        # Reversed, for they are taken from the end.
        return sorted(dict.fromkeys(found), key=lambda step: order[step.relation])[::-1]

    pending = [(1, root.id, step) for step in onward(root.id, None)]
    while pending:
        depth, parent, step = pending.pop()
        kind = kinds.get(step.id, ThingKind.TRIAL)
        further = onward(step.id, step.relation)
        repeated = bool(further) and step.id in shown
        yield ChainStep(
            depth=depth,
            relation=step.relation,
            id=step.id,
            kind=kind,
            text=describe.text(step.id, kind),
            note=describe.note(step.id, kind, measure=parent),
            repeated=repeated,
        )
        if further and not repeated:
            shown.add(step.id)
            pending.extend((depth + 1, step.id, after) for after in further)
