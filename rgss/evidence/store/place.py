"""Place of a store: the file itself behind links, which must be a regular one."""

from __future__ import annotations

import os
import stat
from pathlib import Path

from rgss.errors import EvidenceError

_KINDS = (
    (stat.S_ISDIR, "a folder"),
    (stat.S_ISLNK, "a link in a circle of links"),
    (stat.S_ISFIFO, "a pipe"),
    (stat.S_ISSOCK, "a socket"),
    (stat.S_ISCHR, "a device"),
    (stat.S_ISBLK, "a device"),
)


def place_of(path: Path, *, label: str) -> Path:
    """Path of a store's file without links, as SQLite opens it: its logs are beside the file and not beside a link.

    Args:
        path: The file, which may be missing.
        label: Its name in messages.

    Raises:
        EvidenceError: It is not a regular file, or is a link into a folder that does not exist.
    """
    try:
        # Unlike `Path.resolve`, it raises no error for a circle of links.
        place = Path(os.path.realpath(path))
    except OSError:
        # The current folder, to which the path is relative, was removed.
        return path
    try:
        kind = place.lstat().st_mode
    except OSError:
        # A link to a disk that is not mounted must not become an empty store in the place of that disk.
        if (path.is_symlink() or path.parent.is_symlink()) and not place.parent.is_dir():
            raise EvidenceError(
                f"{label} is a link to {place}, whose folder does not exist",
                hint="make that folder, or remove the link",
            ) from None
        return place
    for is_kind, name in _KINDS:
        if is_kind(kind):
            raise EvidenceError(f"{label} must be a regular file, but it is {name}", hint="move it away")
    return place
