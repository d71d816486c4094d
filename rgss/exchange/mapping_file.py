"""File of a project that maps the names of another tool."""

from __future__ import annotations

import difflib
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from pydantic import Field

from rgss.documents import Document, DocumentModel, Identifier, load_document
from rgss.errors import DocumentError
from rgss.exchange.attributes import Part
from rgss.exchange.foreign_names import ATTRIBUTE_NAMES, OF_TARGET, PART, RELATION_MEANINGS, ForeignNames
from rgss.findings import Finding, shown
from rgss.studies import DocumentKind

DEFAULT_NAMES: tuple[str, ...] = tuple(name for name in ATTRIBUTE_NAMES if name not in (PART, "id"))
"""The attributes that may have a default."""


class MappingFile(DocumentModel):
    """A mapping file.

    Attributes:
        attributes: The attribute of rgss for each name of the other tool; null for one that is left out.
        values: The value of rgss for each value of the other tool, by the attribute of rgss.
        types: The part of the elements of each type of objects.
        relations: The link that a relation of each type is, or several of which the first that fits its ends counts;
            null for one that is left out.
        id_prefix: Text before ids that do not begin with a letter.
        defaults: Attributes of elements that a file does not state.
    """

    attributes: dict[str, str | None] = Field(
        default_factory=dict,
        description="What each attribute or column of the other tool is here; empty if it is left out.",
        json_schema_extra={"additionalProperties": {"enum": [*ATTRIBUTE_NAMES, None]}},
    )
    values: dict[str, dict[str, str]] = Field(
        default_factory=dict,
        description="By the attribute here: what each value of the other tool is.",
        json_schema_extra={"propertyNames": {"enum": list(ATTRIBUTE_NAMES)}},
    )
    types: dict[str, Part] = Field(
        default_factory=dict, description="The kind of the elements of each type of objects of a ReqIF file."
    )
    relations: dict[str, str | tuple[str, ...] | None] = Field(
        default_factory=dict,
        description="What a relation of each type of a ReqIF file states: an attribute of its source that names its "
        "target, with 'target.' before it an attribute of its target that names its source; of several the first that "
        "fits the ends counts; empty if it is left out.",
        json_schema_extra={
            "additionalProperties": {
                "anyOf": [
                    {"enum": [*RELATION_MEANINGS, None]},
                    {"type": "array", "items": {"enum": list(RELATION_MEANINGS)}},
                ]
            }
        },
    )
    id_prefix: Identifier | None = Field(
        default=None, description="Text before each id that does not begin with a letter, such as SYS- before 1234."
    )
    defaults: dict[str, str] = Field(
        default_factory=dict,
        description="Attributes that elements have if the file does not state them.",
        json_schema_extra={"propertyNames": {"enum": list(DEFAULT_NAMES)}},
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class NamesAndDefaults:
    """The content of a mapping file.

    Attributes:
        names: The mapped names.
        defaults: Attributes of new elements, by name.
    """

    names: ForeignNames
    defaults: Mapping[str, str]


def read_mapping(path: Path) -> NamesAndDefaults:
    """Read a mapping file.

    Raises:
        DocumentError: It cannot be read, or names an attribute that rgss does not have.
    """
    loaded = load_document(path, MappingFile)
    found, file = loaded.value, loaded.document
    findings = [
        *_unknown(file, "attributes", ((key, name) for key, name in found.attributes.items() if name is not None)),
        *_unknown(file, "values", ((name, name) for name in found.values), at_key=True),
        *_unknown_meanings(file, found.relations),
        *_unknown(file, "defaults", ((name, name) for name in found.defaults), DEFAULT_NAMES, at_key=True),
    ]
    if findings:
        raise DocumentError(findings)
    return NamesAndDefaults(
        names=ForeignNames(
            attributes={key: name or "" for key, name in found.attributes.items()},
            values=found.values,
            types=found.types,
            relations={key: _listed(meanings) for key, meanings in found.relations.items()},
            id_prefix=found.id_prefix or "",
        ),
        defaults=found.defaults,
    )


def unknown_attribute_hint(name: str, known: Sequence[str] = ATTRIBUTE_NAMES) -> str:
    """Hint for an attribute that rgss does not have.

    Args:
        name: The name.
        known: The attributes that may be given.
    """
    near = difflib.get_close_matches(name, known, n=1)
    return f"did you mean {near[0]!r}?" if near else f"attributes: {', '.join(known)}"


def unknown_meaning_hint(name: str) -> str:
    """Hint for what a relation cannot be mapped to."""
    near = difflib.get_close_matches(name, RELATION_MEANINGS, n=1)
    own = [each for each in RELATION_MEANINGS if not each.startswith(OF_TARGET)]
    return f"did you mean {near[0]!r}?" if near else f"one of {', '.join(own)}; 'target.' before it: of the target"


def _listed(meanings: str | Sequence[str] | None) -> tuple[str, ...]:
    return () if meanings is None else (meanings,) if isinstance(meanings, str) else tuple(meanings)


def _unknown(
    file: Document,
    key: str,
    names: Iterable[tuple[str, str]],
    known: Sequence[str] = ATTRIBUTE_NAMES,
    *,
    at_key: bool = False,
) -> Iterator[Finding]:
    for inner, name in names:
        if name not in known:
            yield file.finding(
                "document.value",
                f"{shown(name)} is not an attribute of rgss"
                if name not in ATTRIBUTE_NAMES
                else f"{name} has no default",
                (key, inner),
                hint=unknown_attribute_hint(name, known),
                at_key=at_key,
            )


def _unknown_meanings(file: Document, relations: Mapping[str, str | tuple[str, ...] | None]) -> Iterator[Finding]:
    for key, meanings in relations.items():
        for place, name in enumerate(_listed(meanings)):
            if name not in RELATION_MEANINGS:
                yield file.finding(
                    "document.value",
                    f"{shown(name)} is not what a relation may state",
                    ("relations", key) if isinstance(meanings, str) else ("relations", key, place),
                    hint=unknown_meaning_hint(name),
                )


MAPPING_KIND = DocumentKind(
    id="mapping",
    title="Names of another tool, for rgss import",
    model=MappingFile,
    place="anywhere, such as imports/doors.yaml; given by --mapping",
)
"""The kind of the file, for its schema."""
