"""Sources of a project: the files that it reads, which no output may overwrite."""

from __future__ import annotations

import os
from pathlib import Path

DATA_FOLDERS = ("requirements", "designs", "scenes", "studies")
"""The folders of a project that hold its sources."""

_STATE = frozenset({"evidence.sqlite", "evidence.sqlite-wal", "evidence.sqlite-shm", "verdicts.json", "import.json"})
_STATE_FOLDER, _TESTS = ".rgss", "tests"
_YAML = (".yaml", ".yml")


def project_source(path: Path) -> str:
    """The path of a source within the project that it belongs to; empty for any other file.

    Sources are what a project reads: everything in its data folders, its tests, its evidence, and the journal of an
    import that was interrupted.

    Args:
        path: A file, without symbolic links.
    """
    path = path.absolute()
    for folder in path.parents:
        if not all((folder / name).is_dir() for name in DATA_FOLDERS):
            continue
        within = path.relative_to(folder)
        first = within.parts[0]
        is_test = first == _TESTS and path.suffix == ".py"
        is_state = first == _STATE_FOLDER and len(within.parts) == 2 and within.name in _STATE
        if first in DATA_FOLDERS or is_test or is_state:
            return within.as_posix()
    return ""


def new_project_source(path: Path) -> str:
    """The path, within its project, of a file that would be a source once it is written; empty for any other file.

    In the data folders only YAML is read without being named by another file.

    Args:
        path: A file that does not exist, without symbolic links.
    """
    name = project_source(path)
    is_data = name.partition("/")[0] in DATA_FOLDERS
    return "" if is_data and path.suffix.lower() not in _YAML else name


def source_with_another_name(status: os.stat_result) -> str:
    """The source of the project around the working folder that is this file too, by a hard link; empty if none is."""
    if status.st_nlink < 2:
        return ""
    for folder in (Path.cwd(), *Path.cwd().parents):
        if all((folder / name).is_dir() for name in DATA_FOLDERS):
            files = (file for name in (*DATA_FOLDERS, _TESTS, _STATE_FOLDER) for file in (folder / name).rglob("*"))
            return next((project_source(file) for file in files if _is_file(file, status)), "")
    return ""


def _is_file(path: Path, status: os.stat_result) -> bool:
    """True if a path is a file of this status, under whatever name."""
    try:
        return not path.is_symlink() and os.path.samestat(path.stat(), status)
    except OSError:
        return False
