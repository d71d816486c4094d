"""Findings that files of scenes, robots and grippers have in common."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from rgss.documents import Document
from rgss.findings import Finding, shown

Location = tuple["str | int", ...]


def not_positive(document: Document, values: Iterable[tuple[Location, float]]) -> Iterable[Finding]:
    """A finding for each value that should be greater than zero and is not.

    Args:
        document: Where the values stand.
        values: Location and value of each.
    """
    for location, value in values:
        if value <= 0:
            yield document.finding("scene.not-positive", f"{_name(location)} must be greater than zero", location)


def negative(document: Document, values: Iterable[tuple[Location, float]]) -> Iterable[Finding]:
    """A finding for each value that should not be less than zero and is.

    Args:
        document: Where the values stand.
        values: Location and value of each.
    """
    for location, value in values:
        if value < 0:
            yield document.finding("scene.negative", f"{_name(location)} must not be less than zero", location)


def missing_file(document: Document, name: str, location: Location) -> Finding:
    """The finding that a file, named in another, is not there."""
    return document.finding(
        "scene.missing-file", f"there is no file {shown(name)}", location, hint="file names are relative to this file"
    )


def is_file(path: Path) -> bool:
    """Tell whether a file is there; a name that no file can have is not there."""
    try:
        return path.is_file()
    except OSError:  # a name that is too long, a folder that may not be searched
        return False


def _name(location: Location) -> str:
    return next(part for part in reversed(location) if isinstance(part, str))
