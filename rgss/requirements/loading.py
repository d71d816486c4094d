"""The folder ``requirements/`` to one `RequirementSet`."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from types import MappingProxyType
from typing import TypeVar

from rgss.documents import Document, DocumentModel, LoadedDocument, load_document
from rgss.errors import DocumentError
from rgss.findings import Finding
from rgss.requirements.architecture import Architecture, Behaviour, Block
from rgss.requirements.criterion import Criterion
from rgss.requirements.files import (
    ArchitectureFile,
    BehaviourFile,
    BlockFile,
    CriterionFile,
    NeedFile,
    RequirementFile,
    StakeholderFile,
    SystemFile,
    split_quantity,
)
from rgss.requirements.needs import StakeholderNeed
from rgss.requirements.references import Declaration, ElementKind, Reference, check_references
from rgss.requirements.requirement import Requirement
from rgss.requirements.requirement_set import Place, RequirementSet

_Model = TypeVar("_Model", bound=DocumentModel)

_ANY_REQUIREMENT = (ElementKind.NEED, ElementKind.REQUIREMENT)
_ANY_ELEMENT = (ElementKind.BLOCK, ElementKind.BEHAVIOUR)


def load_requirements(folder: Path, *, label_root: str = "requirements") -> RequirementSet:
    """Read stakeholder requirements, system requirements and architecture of a project.

    Args:
        folder: The folder that holds ``stakeholder.yaml``, ``system.yaml`` and
            ``architecture.yaml``.
        label_root: The folder's name in messages.

    Raises:
        DocumentError: A file cannot be used, an id is declared twice or names nothing, or an
            element rests on itself; with every problem of the three files. References into a
            file that cannot be read are left alone.
    """
    findings: list[Finding] = []
    stakeholder = _load(folder, "stakeholder.yaml", StakeholderFile, label_root, findings)
    system = _load(folder, "system.yaml", SystemFile, label_root, findings)
    architecture = _load(folder, "architecture.yaml", ArchitectureFile, label_root, findings)

    declarations: list[Declaration] = []
    known: list[ElementKind] = []
    if stakeholder is not None:
        declarations += _declared_needs(stakeholder)
        known.append(ElementKind.NEED)
    if system is not None:
        declarations += _declared_requirements(system)
        known.append(ElementKind.REQUIREMENT)
    if architecture is not None:
        declarations += _declared_elements(architecture)
        known += _ANY_ELEMENT
    findings += check_references(declarations, known=known)
    if findings or stakeholder is None or system is None or architecture is None:
        raise DocumentError(sorted(findings))

    return RequirementSet(
        stakeholder=tuple(_need(item) for item in stakeholder.value.requirements),
        system=tuple(_requirement(item) for item in system.value.requirements),
        architecture=Architecture(
            blocks=tuple(_block(item) for item in architecture.value.blocks),
            behaviours=tuple(_behaviour(item) for item in architecture.value.behaviours),
        ),
        places=MappingProxyType(
            {item.id: Place(document=item.document, location=item.location) for item in declarations}
        ),
    )


def _load(
    folder: Path, name: str, model: type[_Model], label_root: str, findings: list[Finding]
) -> LoadedDocument[_Model] | None:
    try:
        return load_document(folder / name, model, label=f"{label_root}/{name}")
    except DocumentError as error:
        findings.extend(error.findings)
        return None


def _declared_needs(loaded: LoadedDocument[StakeholderFile]) -> Iterator[Declaration]:
    for index, item in enumerate(loaded.value.requirements):
        yield _declaration(item.id, ElementKind.NEED, loaded.document, ("requirements", index))


def _declared_requirements(loaded: LoadedDocument[SystemFile]) -> Iterator[Declaration]:
    for index, item in enumerate(loaded.value.requirements):
        references = [
            *_references("derived_from", item.derived_from, _ANY_REQUIREMENT),
            *_references("satisfied_by", item.satisfied_by, _ANY_ELEMENT, ordering=False),
        ]
        yield _declaration(item.id, ElementKind.REQUIREMENT, loaded.document, ("requirements", index), references)


def _declared_elements(loaded: LoadedDocument[ArchitectureFile]) -> Iterator[Declaration]:
    for index, block in enumerate(loaded.value.blocks):
        references = []
        if block.parent is not None:
            references.append(Reference(field="parent", index=None, target=block.parent, kinds=(ElementKind.BLOCK,)))
        yield _declaration(block.id, ElementKind.BLOCK, loaded.document, ("blocks", index), references)
    for index, behaviour in enumerate(loaded.value.behaviours):
        references = [
            *_references("allocated_to", behaviour.allocated_to, (ElementKind.BLOCK,)),
            *_references("refines", behaviour.refines, (ElementKind.BEHAVIOUR,)),
            *_references("includes", behaviour.includes, (ElementKind.BEHAVIOUR,), ordering=False),
        ]
        yield _declaration(behaviour.id, ElementKind.BEHAVIOUR, loaded.document, ("behaviours", index), references)


def _references(
    field: str, targets: Sequence[str], kinds: tuple[ElementKind, ...], *, ordering: bool = True
) -> Iterator[Reference]:
    for index, target in enumerate(targets):
        yield Reference(field=field, index=index, target=target, kinds=kinds, ordering=ordering)


def _declaration(
    element_id: str,
    kind: ElementKind,
    document: Document,
    location: tuple[str | int, ...],
    references: Sequence[Reference] = (),
) -> Declaration:
    return Declaration(id=element_id, kind=kind, document=document, location=location, references=tuple(references))


def _need(item: NeedFile) -> StakeholderNeed:
    return StakeholderNeed(
        id=item.id,
        kind=item.kind,
        text=item.text,
        rationale=item.rationale,
        source=item.source,
        priority=item.priority,
        status=item.status,
        owner=item.owner,
    )


def _requirement(item: RequirementFile) -> Requirement:
    return Requirement(
        id=item.id,
        group=item.group,
        text=item.text,
        rationale=item.rationale,
        source=item.source,
        derived_from=item.derived_from,
        satisfied_by=item.satisfied_by,
        verification=item.verification,
        criterion=None if item.criterion is None else _criterion(item.criterion),
        criterion_exemption=item.criterion_exemption or "",
        priority=item.priority,
        status=item.status,
        owner=item.owner,
    )


def _criterion(item: CriterionFile) -> Criterion:
    threshold, unit = split_quantity(item.threshold)
    return Criterion(
        measure=item.measure, statistic=item.statistic, comparison=item.comparison, threshold=threshold, unit=unit
    )


def _block(item: BlockFile) -> Block:
    return Block(
        id=item.id, name=item.name, level=item.level, parent=item.parent, relation=item.relation, text=item.text
    )


def _behaviour(item: BehaviourFile) -> Behaviour:
    return Behaviour(
        id=item.id,
        name=item.name,
        kind=item.kind,
        allocated_to=item.allocated_to,
        refines=item.refines,
        includes=item.includes,
        text=item.text,
    )
