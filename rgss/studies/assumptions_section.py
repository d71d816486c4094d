"""Assumptions of a study, and what each could be taken as instead: the section ``assumptions`` of its file."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Annotated, Any

from pydantic import BeforeValidator, Field, WithJsonSchema

from rgss.documents import Document, DocumentModel, Text
from rgss.findings import Finding

ASSUMPTIONS = "assumptions"


def _as_text(value: Any) -> Any:
    """A flag and a number may be unquoted."""
    if isinstance(value, bool):
        return str(value).lower()
    return repr(value) if isinstance(value, (int, float)) else value


AlternativeText = Annotated[
    Text,
    BeforeValidator(_as_text),
    WithJsonSchema(
        {
            "type": ["string", "number", "boolean"],
            "description": "Another value of the assumption, as '--what-if' takes it, such as 0.5 ms.",
        }
    ),
]
"""A value that ``--what-if`` takes."""


class StudyAssumptionEntry(DocumentModel):
    """Assumption with its reason and its alternatives."""

    about: Text
    rationale: Text
    alternatives: Annotated[tuple[AlternativeText, ...], Field(max_length=20)] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class StudyAssumption:
    """An assumption of a study that is questioned.

    Attributes:
        about: Its name, as ``--what-if`` takes it.
        alternatives: Its other possible values.
        places: A finding at the place of each alternative, of which messages on it take the place.
    """

    about: str
    alternatives: tuple[str, ...]
    places: tuple[Finding, ...]


def read_assumptions(entries: Sequence[StudyAssumptionEntry], document: Document) -> tuple[StudyAssumption, ...]:
    """The assumptions that have alternatives, in the order of the file."""
    return tuple(
        StudyAssumption(
            about=entry.about,
            alternatives=entry.alternatives,
            places=tuple(
                document.finding("study.assumption", "", (ASSUMPTIONS, index, "alternatives", place))
                for place in range(len(entry.alternatives))
            ),
        )
        for index, entry in enumerate(entries)
        if entry.alternatives
    )
