"""Declarations of each file, and the references of the declared elements."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from rgss.documents import Document, LoadedDocument
from rgss.requirements.architecture import Behaviour, Block
from rgss.requirements.behaviour import Flow, Interaction, StateMachine
from rgss.requirements.files import ArchitectureFile, StakeholderFile, SystemFile
from rgss.requirements.needs import StakeholderNeed
from rgss.requirements.references import Declaration, ElementKind, Reference
from rgss.requirements.requirement import Requirement

_NEED = (ElementKind.NEED,)
_REQUIREMENT = (ElementKind.REQUIREMENT,)
_ANY_REQUIREMENT = (ElementKind.NEED, ElementKind.REQUIREMENT)
_BLOCK = (ElementKind.BLOCK,)
_BEHAVIOUR = (ElementKind.BEHAVIOUR,)
_ANY_ELEMENT = (ElementKind.BLOCK, ElementKind.BEHAVIOUR)
_REFINED = (ElementKind.BEHAVIOUR, ElementKind.NEED, ElementKind.REQUIREMENT)


def declared_needs(loaded: LoadedDocument[StakeholderFile]) -> Iterator[Declaration]:
    """The stakeholder requirements of a file."""
    for index, item in enumerate(loaded.value.requirements):
        references = _one("parent", item.parent, _NEED)
        yield _declaration(item, ElementKind.NEED, loaded.document, ("requirements", index), references)


def declared_requirements(loaded: LoadedDocument[SystemFile]) -> Iterator[Declaration]:
    """The system requirements of a file."""
    for index, item in enumerate(loaded.value.requirements):
        references = [
            *_one("parent", item.parent, _REQUIREMENT),
            *_many("derived_from", item.derived_from, _ANY_REQUIREMENT),
            *_many("traces", item.traces, _ANY_REQUIREMENT),
            *_many("satisfied_by", item.satisfied_by, _ANY_ELEMENT, ordering=False),
        ]
        yield _declaration(item, ElementKind.REQUIREMENT, loaded.document, ("requirements", index), references)


def declared_elements(loaded: LoadedDocument[ArchitectureFile]) -> Iterator[Declaration]:
    """The blocks and behaviours of a file."""
    for index, block in enumerate(loaded.value.blocks):
        references = [*_one("parent", block.parent, _BLOCK), *_connector_references(block)]
        yield _declaration(block, ElementKind.BLOCK, loaded.document, ("blocks", index), references)
    for index, behaviour in enumerate(loaded.value.behaviours):
        references = list(_behaviour_references(behaviour))
        yield _declaration(behaviour, ElementKind.BEHAVIOUR, loaded.document, ("behaviours", index), references)


def _connector_references(block: Block) -> Iterator[Reference]:
    for index, connector in enumerate(block.connectors):
        yield from _inner(("connectors", index, "source"), connector.source, _BLOCK)
        yield from _inner(("connectors", index, "target"), connector.target, _BLOCK)


def _behaviour_references(behaviour: Behaviour) -> Iterator[Reference]:
    yield from _many("allocated_to", behaviour.allocated_to, _BLOCK)
    yield from _many("refines", behaviour.refines, _REFINED)
    # Inclusion and calls are not an order: a behaviour included by a retry may include the retry.
    yield from _many("includes", behaviour.includes, _BEHAVIOUR, ordering=False)
    yield from _many("actors", behaviour.actors, _BLOCK, ordering=False)
    if behaviour.flow is not None:
        yield from _flow_references(behaviour.flow)
    if behaviour.interaction is not None:
        yield from _interaction_references(behaviour.interaction)
    if behaviour.machine is not None:
        yield from _machine_references(behaviour.machine)


def _flow_references(flow: Flow) -> Iterator[Reference]:
    for index, node in enumerate(flow.nodes):
        yield from _inner(("flow", "nodes", index, "does"), node.does, _BEHAVIOUR)
        yield from _inner(("flow", "nodes", index, "performer"), node.performer, _BLOCK)


def _interaction_references(interaction: Interaction) -> Iterator[Reference]:
    for index, lifeline in enumerate(interaction.lifelines):
        yield from _inner(("interaction", "lifelines", index), lifeline, _BLOCK)
    for index, message in enumerate(interaction.messages):
        yield from _inner(("interaction", "messages", index, "does"), message.does, _BEHAVIOUR)
    for index, timing in enumerate(interaction.timings):
        yield from _inner(("interaction", "timings", index, "criterion_of"), timing.criterion_of, _REQUIREMENT)


def _machine_references(machine: StateMachine) -> Iterator[Reference]:
    for index, state in enumerate(machine.states):
        yield from _inner(("machine", "states", index, "does"), state.does, _BEHAVIOUR)


def _one(field: str, target: str | None, kinds: tuple[ElementKind, ...]) -> list[Reference]:
    return [] if target is None else [Reference(at=(field,), target=target, kinds=kinds)]


def _many(
    field: str, targets: Sequence[str], kinds: tuple[ElementKind, ...], *, ordering: bool = True
) -> Iterator[Reference]:
    for index, target in enumerate(targets):
        yield Reference(at=(field, index), target=target, kinds=kinds, ordering=ordering)


def _inner(at: tuple[str | int, ...], target: str | None, kinds: tuple[ElementKind, ...]) -> Iterator[Reference]:
    if target is not None:
        yield Reference(at=at, target=target, kinds=kinds, ordering=False)


def _declaration(
    item: StakeholderNeed | Requirement | Block | Behaviour,
    kind: ElementKind,
    document: Document,
    location: tuple[str | int, ...],
    references: Sequence[Reference],
) -> Declaration:
    return Declaration(
        id=item.id,
        kind=kind,
        document=document,
        location=location,
        references=tuple(references),
        exempt=tuple(exemption.rule for exemption in item.exempt),
    )
