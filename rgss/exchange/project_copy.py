"""Copy of a project's folders, in which the result of an import is checked."""

from __future__ import annotations

import shutil
from collections.abc import Iterator, Sequence
from pathlib import Path

from rgss.errors import DefinitionError


def copy_of_folders(folder: Path, copy: Path, names: Sequence[str]) -> None:
    """Copy folders of a project, with what their links lead to.

    What loading a project does not read is left out: pipes, devices and sockets, links that lead nowhere or back to a
    folder around them, and files that cannot be read.

    Args:
        folder: The project.
        copy: An empty folder.
        names: The folders to copy; missing ones are left out.

    Raises:
        DefinitionError: The copy cannot be written.
    """
    try:
        for name in names:
            for source in _entries(folder / name, (folder.resolve(),)):
                target = copy / source.relative_to(folder)
                if source.is_dir():
                    target.mkdir(parents=True)
                else:
                    _copy(source, target)
    except OSError as error:
        message = f"the copy of the project, in which an import is checked, cannot be written: {error.strerror}"
        raise DefinitionError(message, hint="set TMPDIR to a folder with room for the project") from error


def _entries(folder: Path, around: tuple[Path, ...]) -> Iterator[Path]:
    """A folder, and the regular files and folders in it."""
    here = folder.resolve()
    if here in around:
        return
    try:
        entries = sorted(folder.iterdir())
    except OSError:
        return
    yield folder
    for entry in entries:
        if entry.is_dir():
            yield from _entries(entry, (*around, here))
        elif entry.is_file():
            yield entry


def _copy(source: Path, target: Path) -> None:
    try:
        opened = source.open("rb")
    except OSError:
        return
    with opened as content, target.open("xb") as written:
        shutil.copyfileobj(content, written)
