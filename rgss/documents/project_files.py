"""Files that documents of a project name: resolved inside the project, and digested by their content."""

from __future__ import annotations

import hashlib
import stat
from enum import Enum
from pathlib import Path

_BLOCK_BYTES = 1024 * 1024


class FilePlace(Enum):
    """Path of a named file."""

    INSIDE = "inside"
    OUTSIDE = "outside"
    MISSING = "missing"


def place_of(path: Path, project: Path) -> FilePlace:
    """Locate a file relative to a project, with every symbolic link of both paths resolved.

    A link whose target lies in the project is inside; one that leads out of it is outside, whether
    or not the target exists, because a file outside is not part of the project and is not copied with it.

    Args:
        path: The file, as it was named.
        project: The project's folder.
    """
    try:
        target = path.resolve()
        if not target.is_relative_to(project.resolve()):
            return FilePlace.OUTSIDE
        return FilePlace.INSIDE if stat.S_ISREG(target.stat().st_mode) else FilePlace.MISSING
    # A name that is too long or has a null character, a circle of links, a folder that may not be searched.
    except (OSError, ValueError, RuntimeError):
        return FilePlace.MISSING


def content_digest(path: Path, *, largest_bytes: int) -> str | None:
    """The SHA-256 of a file's content, read block by block; None if it is larger than a limit.

    Args:
        path: The file.
        largest_bytes: Greatest size that is read.

    Raises:
        OSError: The file cannot be read.
    """
    content, size = hashlib.sha256(), 0
    with path.open("rb") as file:
        while block := file.read(_BLOCK_BYTES):
            size += len(block)
            if size > largest_bytes:
                return None
            content.update(block)
    return content.hexdigest()
