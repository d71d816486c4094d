"""Reading of a project and one of its studies."""

from __future__ import annotations

from os import PathLike
from pathlib import Path

from rgss.api.argument_terms import ErrorsNameArguments, whole_argument
from rgss.api.study import Study
from rgss.api.trial import Drawing
from rgss.errors import DefinitionError
from rgss.studies import MOST_REPLICATES, find_project, load_project, project_of_study

STUDY_SUFFIXES = (".yaml", ".yml")
"""Suffixes of a study file, which distinguish it from a project's folder."""


def path_argument(name: str, path: object) -> str | None:
    """The text of an argument that is a path; None if it is omitted.

    Args:
        name: Its name.
        path: Its value.

    Raises:
        DefinitionError: It is no path, or empty.
    """
    if path is None:
        return None
    text = path if isinstance(path, str) else path.__fspath__() if isinstance(path, PathLike) else None
    if not isinstance(text, str) or not text.strip():
        raise DefinitionError(f"{name} must be a path, got {path!r}", hint="give a text or a pathlib.Path, or omit it")
    return text


@ErrorsNameArguments()
def load(
    folder: str | None, study: str | None, *, fidelity: str | None, replicates: int | None, drawing: Drawing
) -> Study:
    """Read a project and one of its studies; see `rgss.load_study`.

    Args:
        folder: The project's folder, or a study file in one; the nearest folder at or above the
            current one if None.
        study: The study file, relative to the project.
        fidelity: Fidelity of the simulation; the study's if None.
        replicates: Trials of each variant; the study's number if None.
        drawing: Functions that draw a trial.

    Raises:
        DocumentError: Files are wrong; with every problem in all of them.
        DefinitionError: There is no project, or an argument is impossible.
    """
    place = None if folder is None else Path(folder)
    if place is not None and place.suffix in STUDY_SUFFIXES:
        if study is not None:
            raise DefinitionError(
                f"{str(place)!r} and {study!r} are both studies", hint="give a folder and a study, or one study alone"
            )
        place, study = project_of_study(place)
    project = load_project(find_project(place), study)
    if replicates is not None:
        replicates = whole_argument("replicates", replicates, hint="omit it for the study's number")
        if not 1 <= replicates <= MOST_REPLICATES:
            raise DefinitionError(
                f"replicates must be from 1 to {MOST_REPLICATES}, got {replicates}",
                hint="omit it for the study's number",
            )
        project = project.with_replicates(replicates)
    return Study(project=project if fidelity is None else project.with_fidelity(fidelity), _drawing=drawing)
