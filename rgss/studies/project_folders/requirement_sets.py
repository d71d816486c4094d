"""Sets of requirements of a project: the folder ``requirements/``, or one below it that a study names."""

from __future__ import annotations

from pathlib import Path, PurePosixPath
from typing import Any

from rgss.documents import read_document
from rgss.errors import DefinitionError, DocumentError
from rgss.findings import shown
from rgss.studies.project_folders.locating import DEFAULT_STUDY
from rgss.studies.project_folders.study_names import study_file

REQUIREMENTS = "requirements"
"""The set of every study that names no other."""

REQUIREMENT_PARTS = ("stakeholder", "system", "architecture")
SINGLE_FILES = ("measures", "rules", "reviews", "verifications")


def measures_of(folder: str) -> str:
    """The file of the measures of a set.

    Args:
        folder: The set, relative to the project.
    """
    return f"{folder}/measures.yaml"


def qualifier_of(folder: str) -> str:
    """Prefix of ids of a set where ids of several sets meet, such as ``bench/``; empty for the default.

    Args:
        folder: The set, relative to the project.
    """
    return "" if folder == REQUIREMENTS else f"{PurePosixPath(folder).name}/"


def normal_folder(name: str) -> str:
    """The name of a set as it is compared, without a stroke at its end."""
    return PurePosixPath(name).as_posix()


def folder_problem(project: Path, name: str) -> tuple[str, str] | None:
    """Problem with the name of a set, and its remedy; None if it can be used.

    Args:
        project: The project's folder.
        name: The set, as a study names it.
    """
    path = PurePosixPath(name)
    if path.as_posix() == REQUIREMENTS:
        return None
    if len(path.parts) != 2 or path.parts[0] != REQUIREMENTS or path.parts[1] == "..":
        return f"{shown(name)} is not a folder of {REQUIREMENTS}/", f"write '{REQUIREMENTS}', or '{REQUIREMENTS}/NAME'"
    if path.name in (*REQUIREMENT_PARTS, *SINGLE_FILES):
        return f"{shown(name)} is a part of the default set", f"a set is called none of {', '.join(REQUIREMENT_PARTS)}"
    try:
        folder = (project / path).resolve()
        if folder.is_dir():
            if folder.is_relative_to(project.resolve()):
                return None
            return f"{shown(name)} leads out of the project", "copy the folder into the project"
    except (OSError, ValueError, RuntimeError):  # a name that no folder can have, a circle of links
        pass
    return f"there is no folder {shown(name)}", "make it, with stakeholder, system, architecture and measures.yaml"


def requirements_named(project: Path, data: Any) -> str | None:
    """The set that a study names, relative to the project; None if what it names cannot be used.

    Args:
        project: The project's folder.
        data: The study's content as plain data.
    """
    name = data.get(REQUIREMENTS, REQUIREMENTS) if isinstance(data, dict) else REQUIREMENTS
    if not isinstance(name, str) or folder_problem(project, name) is not None:
        return None
    return normal_folder(name)


def requirements_of_study(project: Path, study: str | None) -> str:
    """The set that a study verifies, relative to the project.

    Args:
        project: The project's folder.
        study: The study file, relative to the project or to the current folder; the default study, if there is one,
            for None.

    Raises:
        DocumentError: The study cannot be read.
        DefinitionError: It names no set that can be used.
    """
    if study is None and not (project / DEFAULT_STUDY).exists():
        return REQUIREMENTS
    path, label = study_file(project, study)
    named = requirements_named(project, read_document(path, label=label).data)
    if named is None:
        raise DefinitionError(
            f"{label} names no set of requirements that can be used", hint=f"run 'rgss check {label}'"
        )
    return named


def studies_by_set(project: Path) -> dict[str, str]:
    """The first study of each set of requirements that studies verify: the default study, then by name.

    A study that cannot be read verifies none; its findings are reported where it is read.
    """
    found: dict[str, str] = {}
    labels = [path.relative_to(project).as_posix() for path in (project / "studies").rglob("*.yaml")]
    for label in sorted(labels, key=lambda each: (each != DEFAULT_STUDY, each)):
        try:
            data = read_document(project / label, label=label).data
        except DocumentError:
            continue
        if isinstance(data, dict) and "study" in data:
            folder = requirements_named(project, data)
            if folder is not None:
                found.setdefault(folder, label)
    return found


def named_sets(project: Path) -> tuple[str, ...]:
    """Every set of requirements that studies verify, other than the default."""
    return tuple(folder for folder in studies_by_set(project) if folder != REQUIREMENTS)
