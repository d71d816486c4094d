"""Impact of a change to an id."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass

from rgss.measures import MeasureSet, Verdict
from rgss.requirements import Behaviour, Requirement
from rgss.trace.evidence import TraceEvidence
from rgss.trace.model import TraceModel
from rgss.trace.views.naming import named
from rgss.trace.views.neighbours import Neighbour, Neighbours, Relation, ThingKind, neighbours_of


@dataclass(frozen=True, slots=True, kw_only=True)
class TouchedVerdict:
    """A verdict that must be determined again.

    Attributes:
        requirement: Id of the requirement.
        verdict: The verdict as it is, on the shown variant or by the tests; None where no variant is
            shown and the variants do not agree.
        variants: How many variants are judged by it; 0 if tests decide.
    """

    requirement: str
    verdict: Verdict | None
    variants: int


@dataclass(frozen=True, slots=True, kw_only=True)
class Impact:
    """Impact of a change of one id; only the list of reviews may contain the id itself.

    Attributes:
        id: The id.
        kind: Its kind.
        needs: Ids of the stakeholder requirements to compare with the change.
        requirements: Ids of system requirements with affected text or fulfilment.
        elements: Ids of affected blocks and behaviours.
        measures: Ids of affected measures, or of measures that decide affected requirements.
        verdicts: Affected verdicts.
        trials: Keys of the shown variant's trials of those verdicts.
        tests: Ids of the tests to run again.
        records: Ids of the requirements whose verification record must be renewed.
        reviews: Ids of the elements whose review must be renewed.
    """

    id: str
    kind: ThingKind
    needs: tuple[str, ...]
    requirements: tuple[str, ...]
    elements: tuple[str, ...]
    measures: tuple[str, ...]
    verdicts: tuple[TouchedVerdict, ...]
    trials: tuple[str, ...]
    tests: tuple[str, ...]
    records: tuple[str, ...]
    reviews: tuple[str, ...]


def impact_of(
    model: TraceModel, evidence: TraceEvidence, name: str, *, definitions: MeasureSet | None = None
) -> Impact:
    """Change impact analysis: all transitive dependents of an id.

    A statement depends on those from which it derives, which it refines, in which it is contained or to which it
    traces; a behaviour on its blocks and on the behaviours that it includes or calls; the fulfilment of a requirement
    on the elements that satisfy it; a measure on its dependencies and symbols; a verdict on its requirement and its
    measure; a review on the reviewed content.

    Args:
        model: The project's requirements, architecture and measures.
        evidence: Evidence of the project.
        name: As for `chain_of`.
        definitions: The definitions of the measures, for dependencies; without them a measure affects only those to
            which it contributes.

    Raises:
        DefinitionError: The id is unknown.
    """
    root = named(model, evidence, name, definitions=definitions)
    search = _Search(neighbours_of(model, evidence), model, definitions)
    statements = search.statements(root.id) if root.kind in _STATEMENTS else ()
    elements = search.elements(root.id) if root.kind in _ELEMENTS else search.step(statements, Relation.SATISFIED_BY)
    elements = _unique(elements, search.of_kind(statements, *_ELEMENTS))
    measures = search.measures((root.id, *root.used_by) if root.kind not in _STATEMENTS else ())
    fulfilled = search.step(elements, Relation.SATISFIES) if root.kind in _ELEMENTS else ()
    required = _unique(
        search.of_kind(statements, ThingKind.REQUIREMENT),
        fulfilled,
        search.step(measures, Relation.DECIDES),
        search.step([root.id], Relation.VERIFIES),
    )
    requirements = [model.requirements.requirement(one) for one in required]
    measures = _unique(
        measures,
        search.step(search.of_kind(statements, ThingKind.NEED), Relation.ANSWERED_BY),
        [item.criterion.measure for item in requirements if item.criterion is not None],
    )
    needs = _unique(
        search.of_kind(statements, ThingKind.NEED),
        search.step(measures, Relation.ANSWERS) if root.kind not in _STATEMENTS else (),
        *(sorted(model.origins(one)) for one in required if root.kind is not ThingKind.NEED),
    )
    return Impact(
        id=root.id,
        kind=root.kind,
        needs=_without(root.id, needs),
        requirements=_without(root.id, required),
        elements=_without(root.id, elements),
        measures=_without(root.id, measures),
        verdicts=tuple(_verdict(item, evidence) for item in requirements),
        trials=(root.id,) if root.kind is ThingKind.TRIAL else _trials(requirements, evidence),
        tests=_without(root.id, _unique(*([test.test for test in evidence.tests(one)] for one in required))),
        records=tuple(one for one in required if evidence.record(one) is not None),
        reviews=tuple(
            name for name, review in model.requirements.reviews.items() if root.id in (name, *review.upstream)
        ),
    )


_STATEMENTS = (ThingKind.NEED, ThingKind.REQUIREMENT)
_ELEMENTS = (ThingKind.BLOCK, ThingKind.BEHAVIOUR)
_RESTING_STATEMENTS = frozenset({Relation.SOURCE_OF, Relation.CONTAINS, Relation.TRACED_BY, Relation.REFINED_BY})
_RESTING_ELEMENTS = frozenset({Relation.HAS_PART, Relation.HAS_KIND, Relation.DOES, Relation.REFINED_BY})


class _Search:
    """Breadth-first search over the relations of a project."""

    def __init__(self, neighbours: Neighbours, model: TraceModel, definitions: MeasureSet | None) -> None:
        self._neighbours = neighbours
        self._model = model
        self._definitions = definitions

    def of_kind(self, names: Iterable[str], *kinds: ThingKind) -> tuple[str, ...]:
        return tuple(name for name in names if self._neighbours.kinds.get(name) in kinds)

    def step(self, names: Iterable[str], relation: Relation) -> tuple[str, ...]:
        """The neighbours of these elements by one relation."""
        return _unique(*([after.id for after in self._around(name) if after.relation is relation] for name in names))

    def statements(self, start: str) -> tuple[str, ...]:
        return _closure([start], lambda name: self._by(name, _RESTING_STATEMENTS))

    def elements(self, start: str) -> tuple[str, ...]:
        callers = _callers(self._model.requirements.architecture.behaviours)

        def resting(name: str) -> Sequence[str]:
            return (*self._by(name, _RESTING_ELEMENTS), *callers.get(name, ()))

        return _closure([start], resting)

    def measures(self, start: Iterable[str]) -> tuple[str, ...]:
        """The measures among these, and all that are computed from one of them."""
        known = self.of_kind(start, ThingKind.MEASURE)
        if self._definitions is None:
            return _closure(known, lambda name: self._by(name, frozenset({Relation.CONTRIBUTES_TO})))
        used = self._definitions.used
        return _unique(known, [other.id for other in self._model.measures if used[other.id] & {*known}])

    def _by(self, name: str, relations: frozenset[Relation]) -> tuple[str, ...]:
        return tuple(after.id for after in self._around(name) if after.relation in relations)

    def _around(self, name: str) -> Sequence[Neighbour]:
        return (*self._neighbours.up.get(name, ()), *self._neighbours.down.get(name, ()))


def _callers(behaviours: Iterable[Behaviour]) -> dict[str, list[str]]:
    """For each behaviour, those that include it or call it from an action, a message or a state."""
    callers: dict[str, list[str]] = {}
    for behaviour in behaviours:
        called = list(behaviour.includes)
        if behaviour.flow is not None:
            called += [node.does for node in behaviour.flow.nodes if node.does]
        if behaviour.interaction is not None:
            called += [message.does for message in behaviour.interaction.messages if message.does]
        if behaviour.machine is not None:
            called += [state.does for state in behaviour.machine.states if state.does]
        for name in dict.fromkeys(called):
            callers.setdefault(name, []).append(behaviour.id)
    return callers


def _closure(start: Iterable[str], following: Callable[[str], Sequence[str]]) -> tuple[str, ...]:
    reached = dict.fromkeys(start)
    queue = list(reached)
    for name in queue:  # it grows while it is walked
        fresh = [after for after in following(name) if after not in reached]
        reached.update(dict.fromkeys(fresh))
        queue.extend(dict.fromkeys(fresh))
    return tuple(queue)


def _verdict(requirement: Requirement, evidence: TraceEvidence) -> TouchedVerdict:
    variants = 0 if requirement.criterion is None else evidence.variants
    return TouchedVerdict(requirement=requirement.id, verdict=evidence.verdict(requirement), variants=variants)


def _trials(requirements: Iterable[Requirement], evidence: TraceEvidence) -> tuple[str, ...]:
    shown = evidence.shown
    if shown is None:
        return ()
    measures = [item.criterion.measure for item in requirements if item.criterion is not None]
    return _unique(*([trial.key for trial in shown.deciding_trials(measure)] for measure in measures))


def _unique(*parts: Iterable[str]) -> tuple[str, ...]:
    return tuple(dict.fromkeys(name for part in parts for name in part))


def _without(name: str, names: Iterable[str]) -> tuple[str, ...]:
    return tuple(other for other in names if other != name)
