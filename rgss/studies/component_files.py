"""Reader of the files that components of a catalogue name under 'geometry'."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

from rgss.designs import Catalogue
from rgss.documents import FilePlace, place_of
from rgss.errors import DocumentError
from rgss.findings import Finding, shown

Loaded = TypeVar("Loaded")


def component_files(
    catalogue: Catalogue, role: str, load: Callable[[str], Loaded], findings: list[Finding], *, project: Path
) -> dict[str, Loaded]:
    """The content of the file of every component of a role, by its name.

    Args:
        catalogue: The catalogue.
        role: The role; its components without a file are left out.
        load: Reader of a file by its name, relative to the project.
        findings: Findings are added here.
        project: The project's folder.
    """
    read: dict[str, Loaded] = {}
    seen: set[str] = set()
    for component in catalogue.of_role(role):
        name = component.geometry
        # Components that share a file miss it together: its first place is enough.
        if not name or name in seen:
            continue
        seen.add(name)
        found = place_of(project / name, project)
        place = ("components", list(catalogue.components).index(component), "geometry")
        if found is FilePlace.OUTSIDE:
            message = f"geometry {shown(name)} leads out of the project"
            hint = "copy the file into the project and name it"
            findings.append(catalogue.document.finding("design.geometry", message, place, hint=hint))
        elif found is FilePlace.MISSING:
            message, hint = f"there is no file {shown(name)}", "file names are relative to the project"
            findings.append(catalogue.document.finding("design.missing-file", message, place, hint=hint))
        else:
            try:
                read[name] = load(name)
            except DocumentError as error:
                findings.extend(error.findings)
    return read
