"""Findings that files of scenes, robots and grippers have in common."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path, PurePosixPath, PureWindowsPath

from rgss.documents import Document, FilePlace, place_of
from rgss.findings import Finding, shown

Location = tuple["str | int", ...]
_SLOWEST_M_S = 1.0e-3


def not_positive(document: Document, values: Iterable[tuple[Location, float]]) -> Iterable[Finding]:
    """A finding for each value that should be greater than zero and is not.

    Args:
        document: Where the values stand.
        values: Location and value of each.
    """
    for location, value in values:
        if value <= 0:
            yield document.finding("scene.not-positive", f"{_name(location)} must be greater than zero", location)


def too_slow(document: Document, speeds: Iterable[tuple[Location, float]]) -> Iterable[Finding]:
    """A finding for each speed with which the task would need hours.

    Args:
        document: Where the speeds are.
        speeds: Location and value of each, in m/s.
    """
    for location, speed in speeds:
        if 0 < speed < _SLOWEST_M_S:
            message = f"{_name(location)} must be at least 1 mm/s"
            hint = "a slower arm or hand would need hours for the task"
            yield document.finding("scene.too-slow", message, location, hint=hint)


def negative(document: Document, values: Iterable[tuple[Location, float]]) -> Iterable[Finding]:
    """A finding for each value that should not be less than zero and is.

    Args:
        document: Where the values stand.
        values: Location and value of each.
    """
    for location, value in values:
        if value < 0:
            yield document.finding("scene.negative", f"{_name(location)} must not be less than zero", location)


def named_file_findings(
    document: Document, name: str, location: Location, *, folder: Path, project: Path
) -> Iterable[Finding]:
    """Findings for a file, named in another, that cannot be taken: not there, or not of the project.

    Args:
        document: Where it is named.
        name: Its name as it is written.
        location: Where the name stands.
        folder: The folder of the naming file, relative to which names are.
        project: The folder that no name may lead out of, by itself or through a symbolic link.
    """
    hint = "file names are relative to this file"
    if PurePosixPath(name).is_absolute() or PureWindowsPath(name).drive or "\\" in name:
        message = f"{shown(name)} is not a relative path"
        yield document.finding("scene.outside", message, location, hint=f"copy the file into the project; {hint}")
        return
    place = place_of(folder / name, project)
    if place is FilePlace.OUTSIDE:
        message = f"{shown(name)} leads out of the project"
        yield document.finding("scene.outside", message, location, hint="copy the file into the project and name it")
    elif place is FilePlace.MISSING:
        yield document.finding("scene.missing-file", f"there is no file {shown(name)}", location, hint=hint)


def _name(location: Location) -> str:
    return next(part for part in reversed(location) if isinstance(part, str))
