"""Writing picture files whole or not at all."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path


@contextmanager
def replaced_file(path: Path) -> Iterator[Path]:
    """Give a file to write to, which takes the place of a path when all went well and is gone otherwise.

    Args:
        path: The file that is to be.

    Raises:
        OSError: The folder cannot be written to.
    """
    part = _part_of(path)
    try:
        part.touch()
        yield part
        part.replace(path)
    finally:
        part.unlink(missing_ok=True)


def why_not_writable(path: Path) -> str:
    """Why a file cannot be written, in a few words; empty if it can be. The file itself is left alone."""
    try:
        if path.is_dir():
            return "it is a folder"
        if not path.parent.is_dir():
            return f"there is no folder {path.parent}"
        part = _part_of(path)
        part.touch()
        part.unlink()
    except OSError as error:
        return error.strerror or str(error)
    return ""


def _part_of(path: Path) -> Path:
    """Where a file is made: in the same folder, since a rename is atomic only within a file system."""
    return path.with_name(f".{path.name}.{os.getpid()}.part")
