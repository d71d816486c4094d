"""Verification records: what a person found on a requirement, by inspection, demonstration, analysis or test."""

from __future__ import annotations

import datetime as dt
from enum import Enum
from pathlib import PurePosixPath
from typing import Annotated

from pydantic import AfterValidator, StringConstraints, WithJsonSchema
from pydantic.dataclasses import dataclass

from rgss.documents import STRICT, Text
from rgss.requirements.review import ContentDigest


class RecordedResult(str, Enum):
    """Result of a verification by a person."""

    MET = "met"
    NOT_MET = "not_met"
    INCONCLUSIVE = "inconclusive"


def _calendar_date(text: str) -> str:
    try:
        found = dt.date.fromisoformat(text)
    except ValueError:
        raise ValueError("a date is expected, such as 2026-05-12") from None
    return found.isoformat()


def _inside(text: str) -> str:
    path = PurePosixPath(text)
    if path.is_absolute() or ".." in path.parts or path.as_posix() != text:
        raise ValueError("a file of the project is expected, relative to its folder, such as protocols/closing.md")
    return text


CalendarDate = Annotated[
    str, AfterValidator(_calendar_date), WithJsonSchema({"type": "string", "pattern": r"^\d{4}-\d{2}-\d{2}$"})
]
"""A date of the calendar, such as ``2026-05-12``."""

RecordFile = Annotated[str, StringConstraints(min_length=1, max_length=1_000), AfterValidator(_inside)]
"""A file by its path relative to the project's folder."""


@dataclass(frozen=True, slots=True, kw_only=True, config=STRICT)
class VerificationRecord:
    """The verification of one system requirement by a person, in ``verifications.yaml``.

    Attributes:
        result: What was found.
        by: Who verified.
        date: When.
        note: What was done or seen; None if the files say it.
        files: Digest of each file that it rests on, such as the protocol, and what was inspected.
        requirement: Digest of the requirement's verified content at that time.
    """

    result: RecordedResult
    by: Text
    date: CalendarDate
    note: Text | None = None
    files: dict[RecordFile, ContentDigest]
    requirement: ContentDigest
