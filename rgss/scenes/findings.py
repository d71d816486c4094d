"""Common findings of scene, robot and gripper files."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path, PurePosixPath, PureWindowsPath

from rgss.documents import Document, FilePlace, place_of
from rgss.findings import Finding, shown

Location = tuple["str | int", ...]
_SLOWEST_M_S = 1.0e-3


def not_positive(document: Document, values: Iterable[tuple[Location, float]]) -> Iterable[Finding]:
    """A finding for each value that is not greater than zero.

    Args:
        document: The file, for positions.
        values: Location and value of each.
    """
    for location, value in values:
        if value <= 0:
            yield document.finding("scene.not-positive", f"{_name(location)} must be greater than zero", location)


def too_slow(document: Document, speeds: Iterable[tuple[Location, float]]) -> Iterable[Finding]:
    """A finding for each speed at which the task would take hours.

    Args:
        document: The file, for positions.
        speeds: Location and value of each, in m/s.
    """
    for location, speed in speeds:
        if 0 < speed < _SLOWEST_M_S:
            message = f"{_name(location)} must be at least 1 mm/s"
            hint = "a slower arm or hand would take hours for the task"
            yield document.finding("scene.too-slow", message, location, hint=hint)


def negative(document: Document, values: Iterable[tuple[Location, float]]) -> Iterable[Finding]:
    """A finding for each value that is less than zero.

    Args:
        document: The file, for positions.
        values: Location and value of each.
    """
    for location, value in values:
        if value < 0:
            yield document.finding("scene.negative", f"{_name(location)} must not be less than zero", location)


def named_file_findings(
    document: Document, name: str, location: Location, *, folder: Path, project: Path
) -> Iterable[Finding]:
    """Findings for a reference to a file that does not exist or is outside the project.

    Args:
        document: The referring file, for positions.
        name: The file name as written.
        location: Location of the name.
        folder: The folder of the referring file, to which names are relative.
        project: The folder that must contain the file, also after resolution of symbolic links.
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
