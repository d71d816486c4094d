"""The folder of a project, found by its own folders."""

from __future__ import annotations

from pathlib import Path

from rgss.errors import DefinitionError

FOLDERS = ("requirements", "designs", "scenes", "studies")
DEFAULT_STUDY = "studies/pick_place.yaml"


def find_project(folder: Path | None) -> Path:
    """The project's folder: the one given, or the nearest above this one that looks like a project.

    Raises:
        DefinitionError: There is none.
    """
    if folder is not None:
        missing = [name for name in FOLDERS if not _is_folder(folder / name)]
        if missing:
            raise DefinitionError(
                f"{str(folder)!r} is not a project: it has no folder {missing[0]}/",
                hint=f"a project has {', '.join(f'{name}/' for name in FOLDERS)}",
            )
        return folder
    here = Path.cwd()
    for candidate in (here, *here.parents):
        if all(_is_folder(candidate / name) for name in FOLDERS):
            return candidate
    raise DefinitionError("no project here or above", hint="go into a project or name it with --project DIR")


def project_of_study(study: Path) -> tuple[Path, str]:
    """The project that a study file lies in: the nearest folder above it that looks like one.

    Returns:
        The project's folder, and the file relative to it.

    Raises:
        DefinitionError: There is none.
    """
    try:
        path = study.resolve()
    except (OSError, ValueError, RuntimeError):  # a name that no file can have, a circle of links
        path = study
    for candidate in path.parents:
        if all(_is_folder(candidate / name) for name in FOLDERS):
            return candidate, path.relative_to(candidate).as_posix()
    raise DefinitionError(
        f"the study {str(study)!r} lies in no project",
        hint=f"a project has {', '.join(f'{name}/' for name in FOLDERS)}",
    )


def _is_folder(path: Path) -> bool:
    try:
        return path.is_dir()
    except OSError:  # a name that is too long, a folder that may not be searched
        return False
