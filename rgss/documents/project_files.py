"""Files referenced by documents of a project: resolved inside the project, and digested by content."""

from __future__ import annotations

import hashlib
import stat
from enum import Enum
from pathlib import Path

_BLOCK_BYTES = 1024 * 1024


class FilePlace(Enum):
    """Location of a referenced file relative to the project."""

    INSIDE = "inside"
    OUTSIDE = "outside"
    MISSING = "missing"


def place_of(path: Path, project: Path) -> FilePlace:
    """Locate a file relative to a project, with all symbolic links of both paths resolved.

    A link with a target in the project is inside; one with a target outside is outside, whether or not the target
    exists, because a file outside is not part of the project and is not copied with it.

    Args:
        path: The file, as referenced.
        project: The project's folder.
    """
    try:
        target = path.resolve()
        if not target.is_relative_to(project.resolve()):
            return FilePlace.OUTSIDE
        return FilePlace.INSIDE if stat.S_ISREG(target.stat().st_mode) else FilePlace.MISSING
    # A name that is too long or has a null character, circular links, or a folder without search permission.
    except (OSError, ValueError, RuntimeError):
        return FilePlace.MISSING


def content_digest(path: Path, *, largest_bytes: int) -> str | None:
    """SHA-256 of a file's content, read in chunks; None if the file is larger than a limit.

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
