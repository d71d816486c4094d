"""Loader of the folder ``requirements/`` into a `RequirementSet`."""

from __future__ import annotations

from pathlib import Path
from types import MappingProxyType

from rgss.documents import LoadedDocument
from rgss.errors import DocumentError
from rgss.findings import Finding
from rgss.requirements.architecture import Architecture
from rgss.requirements.checks import (
    check_behaviours,
    check_blocks,
    declared_elements,
    declared_needs,
    declared_requirements,
)
from rgss.requirements.files import (
    ArchitectureFile,
    ReviewsFile,
    RulesFile,
    StakeholderFile,
    SystemFile,
    VerificationsFile,
)
from rgss.requirements.hints import Hints
from rgss.requirements.reading import FolderReader
from rgss.requirements.references import Declaration, ElementKind, check_references
from rgss.requirements.requirement_set import Place, RequirementSet


def load_requirements(folder: Path, *, label_root: str = "requirements") -> RequirementSet:
    """Read stakeholder requirements, system requirements and architecture of a project.

    ``stakeholder``, ``system`` and ``architecture`` are each a file ``….yaml`` or a folder of such files, read in the
    order of their names. ``rules.yaml``, ``reviews.yaml`` and ``verifications.yaml`` are optional.

    Args:
        folder: The folder.
        label_root: The folder's name in messages.

    Raises:
        DocumentError: A file is invalid, an id is a duplicate or unknown, an element depends on itself, or a
        behaviour's detail is inconsistent; with every problem of all files. References into a part that cannot be read
        are not checked.
    """
    findings: list[Finding] = []
    reader = FolderReader(folder, label_root, findings)
    stakeholder = reader.part("stakeholder", StakeholderFile)
    system = reader.part("system", SystemFile)
    architecture = reader.part("architecture", ArchitectureFile)
    rules = reader.optional("rules.yaml", RulesFile)
    reviews = reader.optional("reviews.yaml", ReviewsFile)
    records = reader.optional("verifications.yaml", VerificationsFile)

    declarations: list[Declaration] = []
    for needs in stakeholder.documents:
        declarations += declared_needs(needs)
    for requirements in system.documents:
        declarations += declared_requirements(requirements)
    for elements in architecture.documents:
        declarations += declared_elements(elements)
    known: list[ElementKind] = []
    known += [ElementKind.NEED] if stakeholder.complete else []
    known += [ElementKind.REQUIREMENT] if system.complete else []
    known += [ElementKind.BLOCK, ElementKind.BEHAVIOUR] if architecture.complete else []
    hints = Hints()
    findings += check_references(declarations, known=known, hints=hints)
    stated = {item.id: item for part in system.documents for item in part.value.requirements}
    findings += check_blocks(architecture.documents, hints)
    findings += check_behaviours(architecture.documents, stated, hints)
    if findings:
        raise DocumentError(sorted(findings))

    return RequirementSet(
        stakeholder=tuple(item for part in stakeholder.documents for item in part.value.requirements),
        system=tuple(item for part in system.documents for item in part.value.requirements),
        architecture=Architecture(
            blocks=tuple(item for part in architecture.documents for item in part.value.blocks),
            behaviours=tuple(item for part in architecture.documents for item in part.value.behaviours),
        ),
        places=MappingProxyType(
            {item.id: Place(document=item.document, location=item.location) for item in declarations}
        ),
        reviews=MappingProxyType({} if reviews is None else reviews.value.reviews),
        review_places=_places(reviews, "reviews"),
        records=MappingProxyType({} if records is None else records.value.verifications),
        record_places=_places(records, "verifications"),
        settings=MappingProxyType({} if rules is None else rules.value.rules),
        setting_places=_places(rules, "rules"),
    )


def _places(
    loaded: LoadedDocument[RulesFile] | LoadedDocument[ReviewsFile] | LoadedDocument[VerificationsFile] | None, key: str
) -> MappingProxyType[str, Place]:
    if loaded is None:
        return MappingProxyType({})
    document = loaded.document
    return MappingProxyType({name: Place(document=document, location=(key, name)) for name in document.data[key]})
