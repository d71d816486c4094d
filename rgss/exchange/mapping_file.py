"""File of a project that maps the names of another tool."""

from __future__ import annotations

import difflib
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from pydantic import Field

from rgss.documents import Document, DocumentModel, load_document
from rgss.errors import DocumentError
from rgss.exchange.attributes import Part
from rgss.exchange.foreign_names import ATTRIBUTE_NAMES, ForeignNames
from rgss.findings import Finding, shown


class MappingFile(DocumentModel):
    """A mapping file.

    Attributes:
        attributes: The attribute of rgss for each name of the other tool; null for one that is left out.
        values: The value of rgss for each value of the other tool, by the attribute of rgss.
        types: The part of the elements of each type of objects.
        defaults: Attributes of new elements that a file does not state.
    """

    attributes: dict[str, str | None] = Field(default_factory=dict)
    values: dict[str, dict[str, str]] = Field(default_factory=dict)
    types: dict[str, Part] = Field(default_factory=dict)
    defaults: dict[str, str] = Field(default_factory=dict)


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

    Args:
        path: The file.

    Raises:
        DocumentError: It cannot be read, or names an attribute that rgss does not have.
    """
    loaded = load_document(path, MappingFile)
    found, file = loaded.value, loaded.document
    findings = [
        *_unknown(file, "attributes", ((key, name) for key, name in found.attributes.items() if name is not None)),
        *_unknown(file, "values", ((name, name) for name in found.values), at_key=True),
        *_unknown(file, "defaults", ((name, name) for name in found.defaults), at_key=True),
    ]
    if findings:
        raise DocumentError(findings)
    return NamesAndDefaults(
        names=ForeignNames(
            attributes={key: name or "" for key, name in found.attributes.items()},
            values=found.values,
            types=found.types,
        ),
        defaults=found.defaults,
    )


def unknown_attribute_hint(name: str) -> str:
    """Hint for an attribute that rgss does not have."""
    near = difflib.get_close_matches(name, ATTRIBUTE_NAMES, n=1)
    return f"did you mean {near[0]!r}?" if near else f"attributes: {', '.join(ATTRIBUTE_NAMES)}"


def _unknown(file: Document, key: str, names: Iterable[tuple[str, str]], *, at_key: bool = False) -> Iterator[Finding]:
    for inner, name in names:
        if name not in ATTRIBUTE_NAMES:
            yield file.finding(
                "document.value",
                f"{shown(name)} is not an attribute of rgss",
                (key, inner),
                hint=unknown_attribute_hint(name),
                at_key=at_key,
            )
