"""Every kind of YAML document that a project has: its model, its schema, and which file is of which kind."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from importlib import resources
from pathlib import PurePosixPath
from typing import Any

from rgss.designs import CatalogueModel, DesignSpaceModel
from rgss.documents import DocumentModel, json_schema, read_document
from rgss.errors import DefinitionError
from rgss.identification import ExcitationDocument
from rgss.measures import MeasuresDocument
from rgss.requirements import (
    ArchitectureFile,
    ReviewsFile,
    RulesFile,
    StakeholderFile,
    SystemFile,
    VerificationsFile,
)
from rgss.scenes import GRIPPER_KINDS, CalibrationDocument, RobotDocument, SceneDocument
from rgss.studies.document import StudyDocument
from rgss.studies.project_folders import REQUIREMENT_PARTS, SINGLE_FILES
from rgss.tasks import TaskDocument
from rgss.tradeoff import ShapeKeys


@dataclass(frozen=True, slots=True, kw_only=True)
class DocumentKind:
    """A kind of document.

    Attributes:
        id: Its name, such as ``design-space``.
        title: Title, in a few words.
        model: Type that reads it.
        place: Location of such a document in a project.
    """

    id: str
    title: str
    model: type[DocumentModel]
    place: str

    @property
    def schema_file(self) -> str:
        """The name of its schema's file."""
        return f"{self.id}.schema.json"

    def schema(self) -> dict[str, Any]:
        """Its JSON Schema, as plain data."""
        return json_schema(self.model, title=self.title, texts=key_texts())

    def schema_text(self) -> str:
        """Its JSON Schema, as the text of a file."""
        return _schema_text(self)


@cache
def _schema_text(kind: DocumentKind) -> str:
    return json.dumps(kind.schema(), indent=2, ensure_ascii=False, allow_nan=False) + "\n"


DOCUMENT_KINDS = (
    DocumentKind(
        id="stakeholder",
        title="Stakeholder requirements",
        model=StakeholderFile,
        place="requirements/stakeholder.yaml, or a folder of that name",
    ),
    DocumentKind(
        id="system",
        title="System requirements",
        model=SystemFile,
        place="requirements/system.yaml, or a folder of that name",
    ),
    DocumentKind(
        id="architecture",
        title="Structure and behaviour",
        model=ArchitectureFile,
        place="requirements/architecture.yaml, or a folder of that name",
    ),
    DocumentKind(id="measures", title="Measures", model=MeasuresDocument, place="requirements/measures.yaml"),
    DocumentKind(id="rules", title="Settings of rules", model=RulesFile, place="requirements/rules.yaml"),
    DocumentKind(id="reviews", title="Reviews", model=ReviewsFile, place="requirements/reviews.yaml"),
    DocumentKind(
        id="verifications",
        title="Verification records",
        model=VerificationsFile,
        place="requirements/verifications.yaml",
    ),
    DocumentKind(id="design-space", title="Design space", model=DesignSpaceModel, place="designs/"),
    DocumentKind(id="catalogue", title="Catalogue of components", model=CatalogueModel, place="designs/"),
    DocumentKind(id="scene", title="Scene", model=SceneDocument, place="scenes/"),
    DocumentKind(id="robot", title="Robot", model=RobotDocument, place="scenes/robots/"),
    DocumentKind(
        id="calibration", title="Calibration of a robot's servos", model=CalibrationDocument, place="scenes/robots/"
    ),
    DocumentKind(
        id="excitation", title="Excitation of a robot's joints", model=ExcitationDocument, place="scenes/robots/"
    ),
    *(
        DocumentKind(id=kind.document, title=kind.title, model=kind.model, place="scenes/grippers/")
        for kind in GRIPPER_KINDS.values()
    ),
    DocumentKind(id="task", title="Task", model=TaskDocument, place="scenes/tasks/"),
    DocumentKind(id="study", title="Study", model=StudyDocument, place="studies/"),
)

_OF_REQUIREMENTS = (*REQUIREMENT_PARTS, *SINGLE_FILES)
_BY_KEY: Mapping[str, tuple[tuple[str, str], ...]] = {
    "designs": (("components", "catalogue"), ("parameters", "design-space")),
    "scenes": (
        ("bodies", "scene"),
        ("joints", "robot"),
        *((kind.own_key, kind.document) for kind in GRIPPER_KINDS.values()),
        ("servos", "calibration"),
        ("excitation", "excitation"),
        ("steps", "task"),
    ),
    "studies": (("study", "study"),),
}


def document_kind(name: str) -> DocumentKind:
    """The kind of a name.

    Raises:
        DefinitionError: There is none.
    """
    for kind in DOCUMENT_KINDS:
        if kind.id == name:
            return kind
    known = ", ".join(kind.id for kind in DOCUMENT_KINDS)
    raise DefinitionError(f"unknown document {name!r}", hint=f"documents: {known}")


def kind_of(name: str, data: Any) -> DocumentKind | None:
    """The kind of a project's file; None if it is of none that rgss reads.

    Args:
        name: The file relative to the project, such as ``scenes/kitchen.yaml``.
        data: Its content as plain data, which distinguishes the kinds of one folder.
    """
    folder, *rest = PurePosixPath(name).parts
    if folder == "requirements" and rest:
        # A file of a named set, such as requirements/NAME/system.yaml, is what it would be in the default set.
        inner = rest[1:] if len(rest) > 1 and rest[0] not in REQUIREMENT_PARTS else rest
        part = inner[0].removesuffix(".yaml")
        return document_kind(part) if part in _OF_REQUIREMENTS else None
    keys = data if isinstance(data, dict) else {}
    found = next((kind for key, kind in _BY_KEY.get(folder, ()) if key in keys), None)
    return None if found is None else document_kind(found)


def key_texts() -> Mapping[str, Mapping[str, str]]:
    """Description of each key of the documents, by the model that reads it."""
    with resources.as_file(resources.files("rgss.studies.schemas") / "field_descriptions.yaml") as path:
        texts: Mapping[str, Mapping[str, str]] = read_document(path, label="field_descriptions.yaml").data
    # Each shape of a value function describes its keys beside them, so that one file adds a shape.
    of_shapes = {key: field.description for key, field in ShapeKeys.model_fields.items() if field.description}
    extended = {**texts, ShapeKeys.__name__: of_shapes}
    # A model that extends another has its keys, which are described once.
    return {
        model: {
            **extended.get(of_model.get("extends", ""), {}),
            **{key: of_model[key] for key in of_model if key != "extends"},
        }
        for model, of_model in texts.items()
    }
