"""Study that a user means: a file, its name alone, or the only one that there is."""

from __future__ import annotations

import difflib
import os
import re
import shlex
from pathlib import Path

from rgss.errors import DefinitionError
from rgss.studies.project_folders.locating import DEFAULT_STUDY

_STUDIES = "studies"
_NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9_-]{0,99}")
_SUFFIX = ".yaml"


def study_file(project: Path, name: str | None) -> tuple[Path, str]:
    """The file of a study, and its label: the path relative to the project.

    Args:
        project: The project's folder.
        name: The file, relative to the project or to the current folder, or its name alone, such as ``pick_place``;
            None for the default study, or else for the only one.

    Raises:
        DefinitionError: No study is named, and there are several but not the default one; or none has the name.
    """
    if name is None:
        return _unnamed(project)
    path = project / name
    try:
        if not path.is_file() and Path(name).is_file():
            path = Path(name)
        elif _NAME.fullmatch(name) and not path.exists():
            return _by_name(project, name)
        # Unlike `Path.resolve`, it raises no error for a circle of links.
        return path, Path(os.path.realpath(path)).relative_to(project.resolve()).as_posix()
    except (OSError, ValueError):  # a name that no file can have, a study outside the project
        return path, name


def words_of_study(label: str) -> str:
    """Argument of a command that names a study, with a space before it; empty for the default study.

    Args:
        label: The study's file, relative to the project.
    """
    if label == DEFAULT_STUDY:
        return ""
    path = Path(label)
    is_name = path.parent == Path(_STUDIES) and path.suffix == _SUFFIX and _NAME.fullmatch(path.stem)
    return f" {shlex.quote(path.stem if is_name else label)}"


def _unnamed(project: Path) -> tuple[Path, str]:
    # That of another project, in which this process may have been started, is never meant.
    path = project / DEFAULT_STUDY
    others = [] if path.exists() else _labels(project)
    if not others:
        return path, DEFAULT_STUDY
    if len(others) > 1:
        hint = f"name the study, such as {others[0]}"
        raise DefinitionError(f"the project has no {DEFAULT_STUDY}, which is the default", hint=hint)
    return project / others[0], others[0]


def _by_name(project: Path, name: str) -> tuple[Path, str]:
    label = f"{_STUDIES}/{name}{_SUFFIX}"
    known = [Path(one).stem for one in _labels(project)]
    # What is no file, such as a circle of links, is reported with its name where it is read.
    if name in known:
        return project / label, label
    near = difflib.get_close_matches(name, known, n=1)
    hint = f"did you mean {near[0]!r}?" if near else f"studies: {', '.join(known) or 'none'}"
    raise DefinitionError(f"there is no study {name!r}", hint=hint)


def _labels(project: Path) -> list[str]:
    return [f"{_STUDIES}/{path.name}" for path in sorted((project / _STUDIES).glob(f"*{_SUFFIX}"))]
