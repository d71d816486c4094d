"""Identity check of an open store: the files under its name must be those that SQLite has open.

A deleted or replaced file stays readable and writable for a process that has it open, so that writes succeed but are
lost at the end. SQLite detects a truncated file only when it reads the pages.
"""

from __future__ import annotations

from contextlib import suppress
from pathlib import Path

_OPEN_FILES = Path("/proc/self/fd")
_LOGS = {"-wal": "write-ahead log", "-shm": "index of its log"}


class FileIdentity:
    """Identity (device and inode) and least size of the files of an open store."""

    def __init__(self, path: Path) -> None:
        """Record the present state of the files, without opening them, which would release the locks of SQLite.

        Args:
            path: The file, which is open and has been read.

        Raises:
            OSError: The file was removed.
        """
        # Absolute, so that a change of the working directory does not matter.
        self.path = path.absolute()
        self._identity, self._size = _looked_up(self.path)
        self._logs: dict[str, tuple[int, int]] = {}
        self._note_logs()

    def problem(self) -> str:
        """Change of the files, as a phrase that follows the store's name; empty if there is none."""
        try:
            identity, size = _looked_up(self.path)
        except OSError as error:
            moved_to = self.moved_to
            if moved_to is not None:
                return f"was moved to {moved_to}"
            removed = isinstance(error, (FileNotFoundError, NotADirectoryError))
            return "was removed" if removed else f"cannot be reached: {error.strerror}"
        if identity != self._identity:
            return "was replaced by another file"
        # Only rewriting the whole file makes it smaller, which needs exclusive access.
        if size < self._size:
            return f"was truncated from {self._size} to {size} bytes"
        for ending, before in self._logs.items():
            if _identity_or_none(self._beside(ending)) != before:
                return f"lost its {_LOGS[ending]}"
        self._size = size
        self._note_logs()
        return ""

    @property
    def is_replaced(self) -> bool:
        """True if another file has its name."""
        return _identity_or_none(self.path) not in (None, self._identity)

    @property
    def moved_to(self) -> Path | None:
        """Present path of the file if it has another one; None if it has none, or the system does not tell."""
        # On Linux the names of open files are links in this folder.
        for link in _OPEN_FILES.glob("*"):
            if _identity_or_none(link) == self._identity:
                with suppress(OSError):
                    place = link.readlink()
                    # The name of a removed file has an ending.
                    if place != self.path and _identity_or_none(place) == self._identity:
                        return place
        return None

    def discard_orphaned_logs(self) -> None:
        """Remove the logs of a file that was renamed: SQLite would apply them to the next file of that name."""
        try:
            if _looked_up(self.path)[0] == self._identity:
                return
        except OSError:
            # The file was removed.
            pass
        for ending, before in self._logs.items():
            place = self._beside(ending)
            if _identity_or_none(place) == before:
                with suppress(OSError):
                    place.unlink()

    def _note_logs(self) -> None:
        """Record the logs as soon as they exist: SQLite keeps them until the last connection closes."""
        for ending in _LOGS:
            identity = _identity_or_none(self._beside(ending))
            if identity is not None:
                self._logs.setdefault(ending, identity)

    def _beside(self, ending: str) -> Path:
        return self.path.with_name(self.path.name + ending)


def _looked_up(path: Path) -> tuple[tuple[int, int], int]:
    found = path.stat()
    return (found.st_dev, found.st_ino), found.st_size


def _identity_or_none(path: Path) -> tuple[int, int] | None:
    try:
        return _looked_up(path)[0]
    except OSError:
        return None
