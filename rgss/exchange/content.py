"""Content of a project or of a file of another tool, in a common form for comparison."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Any

from pydantic import TypeAdapter

from rgss.documents import validated
from rgss.exchange.attributes import MODELS, Part
from rgss.exchange.cells import Cells, cells_of
from rgss.findings import Finding
from rgss.requirements import CriterionFile, Element, RequirementSet

_PARTS: Mapping[type[Element], Part] = MappingProxyType({model: part for part, model in MODELS.items()})


@dataclass(frozen=True, slots=True, kw_only=True)
class Row:
    """One element of a file.

    Attributes:
        part: Its part; None if the file does not state it.
        cells: Its attributes as texts; attributes that the file does not state are absent.
        line: Its first line, or its row of a sheet.
        columns: The column of each attribute, in a table.
        file: Its file, if the content is of several.
    """

    part: Part | None
    cells: Cells
    line: int = 1
    columns: Mapping[str, int] = field(default_factory=lambda: MappingProxyType({}))
    file: str = ""

    @property
    def id(self) -> str:
        """The element's id; empty if there is none."""
        return self.cells.get("id", "").strip()


@dataclass(frozen=True, slots=True, kw_only=True)
class Content:
    """Elements of a file.

    Attributes:
        rows: The elements, in the file's order.
        measures: Id and definition of each measure.
        records: Attributes of the verification record of each requirement that has one, by its id.
        whole: Parts of which the file has every element, so that a missing one was removed.
        notes: Content of the file that is not imported, since it has no counterpart here.
        losses: Content of elements that is not imported, though it may change their meaning.
        names: The names of all attributes in the file, as it has them.
        relations: The names of all types of relations in the file.
        file: The file's name.
    """

    rows: tuple[Row, ...]
    measures: tuple[tuple[str, str], ...] = ()
    records: Mapping[str, Mapping[str, str]] = field(default_factory=lambda: MappingProxyType({}))
    whole: frozenset[Part] = frozenset(Part)
    notes: tuple[str, ...] = ()
    losses: tuple[Finding, ...] = ()
    names: tuple[str, ...] = ()
    relations: tuple[str, ...] = ()
    file: str = ""


def part_of(element: Element) -> Part:
    """Part of the project that an element belongs to."""
    return _PARTS[type(element)]


def content_of(
    requirements: RequirementSet,
    measures: Mapping[str, str] | None = None,
    records: Mapping[str, Mapping[str, str]] | None = None,
) -> Content:
    """Content of a project.

    Args:
        requirements: Its requirements and architecture, as loaded.
        measures: The definition of each measure by id.
        records: Attributes of the verification record of each requirement that has one, by its id.
    """
    rows = tuple(
        Row(part=part_of(element), cells=cells_of(part_of(element), full_entry(part_of(element), entry)))
        for element, entry in _entries(requirements)
    )
    return Content(rows=rows, measures=tuple((measures or {}).items()), records=records or {})


def full_entry(part: Part, entry: Mapping[str, Any]) -> dict[str, Any]:
    """A valid entry of a YAML file completed with all keys."""
    element, _ = validated(entry, MODELS[part])
    return {} if element is None else as_written(element, entry)


def as_written(element: Element, entry: Mapping[str, Any], *, exclude_defaults: bool = False) -> dict[str, Any]:
    """The entry of a YAML file for an element that was read from another form.

    Args:
        element: The element.
        entry: The entry that it was read from, which determines the notation of a threshold.
        exclude_defaults: True to omit keys that have their default.
    """
    keys: dict[str, Any] = TypeAdapter(type(element)).dump_python(
        element, mode="json", exclude_defaults=exclude_defaults
    )
    if entry.get("criterion") is not None:
        criterion = CriterionFile.model_validate_json(json.dumps(entry["criterion"]))
        keys["criterion"] = criterion.model_dump(mode="json", exclude_defaults=exclude_defaults)
    return keys


def _entries(requirements: RequirementSet) -> Iterator[tuple[Element, Mapping[str, Any]]]:
    for element in requirements.elements:
        place = requirements.places[element.id]
        entry: Any = place.document.data
        for key in place.location:
            entry = entry[key]
        yield element, entry
