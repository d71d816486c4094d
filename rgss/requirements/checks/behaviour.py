"""Checks of the details of behaviours: actors, flows, interactions, state machines."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from rgss.documents import LoadedDocument
from rgss.findings import Finding
from rgss.requirements.architecture import Behaviour, Block
from rgss.requirements.checks.flow import check_flow
from rgss.requirements.checks.interaction import check_interaction
from rgss.requirements.checks.performers import check_performers
from rgss.requirements.checks.state_machine import check_machine
from rgss.requirements.files import ArchitectureFile
from rgss.requirements.hints import Hints
from rgss.requirements.references import Declaration, ElementKind
from rgss.requirements.requirement import Requirement


def check_behaviours(
    documents: Sequence[LoadedDocument[ArchitectureFile]], requirements: Mapping[str, Requirement], hints: Hints
) -> Iterator[Finding]:
    """Findings about the details of behaviours.

    Args:
        documents: The files of the architecture.
        requirements: The readable system requirements, by id.
        hints: Finder of the nearest known id.
    """
    blocks = {block.id: block for loaded in documents for block in loaded.value.blocks}
    for loaded in documents:
        for index, behaviour in enumerate(loaded.value.behaviours):
            declaration = Declaration(
                id=behaviour.id,
                kind=ElementKind.BEHAVIOUR,
                document=loaded.document,
                location=("behaviours", index),
            )
            yield from _check_actors(declaration, behaviour, blocks)
            if behaviour.flow is not None:
                yield from check_flow(declaration, behaviour.flow, hints)
                yield from check_performers(declaration, behaviour, blocks)
            if behaviour.interaction is not None:
                yield from check_interaction(declaration, behaviour.interaction, requirements, hints)
            if behaviour.machine is not None:
                yield from check_machine(declaration, behaviour.machine, hints)


def _check_actors(declaration: Declaration, behaviour: Behaviour, blocks: Mapping[str, Block]) -> Iterator[Finding]:
    for index, actor in enumerate(behaviour.actors):
        if actor in blocks and not blocks[actor].actor:
            message = f"actors: block {actor!r} is not an actor"
            yield declaration.finding("actor", message, ("actors", index), hint="give it 'actor: true'")
