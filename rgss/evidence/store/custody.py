"""Custody of an open store: whether the files under its name are still those that SQLite has open.

A file that is deleted or replaced stays readable and writable for a process that has it open, so that writes succeed
and are lost at the end. A file that is cut is noticed by SQLite only when it reads the pages.
"""

from __future__ import annotations

from contextlib import suppress
from pathlib import Path

_LOGS = {"-wal": "write-ahead log", "-shm": "index of its log"}


class Custody:
    """Identity (device and inode) and least size of the files of an open store."""

    def __init__(self, path: Path) -> None:
        """Record the present state of the files; nothing is opened, which would end the locks of SQLite.

        Args:
            path: The file, which is open and has been read.

        Raises:
            OSError: It was removed already.
        """
        # A later change of the working folder must not lead to another file.
        self.path = path.absolute()
        self._identity, self._size = _looked_up(self.path)
        self._logs: dict[str, tuple[int, int]] = {}
        self._note_logs()

    def problem(self) -> str:
        """Change of the files, as a phrase that follows the store's name; empty if there is none."""
        try:
            identity, size = _looked_up(self.path)
        except OSError as error:
            removed = isinstance(error, (FileNotFoundError, NotADirectoryError))
            return "was removed" if removed else f"cannot be reached: {error.strerror}"
        if identity != self._identity:
            return "was replaced by another file"
        # Only a rewriting of the whole file makes it smaller, which needs it to be open nowhere else.
        if size < self._size:
            return f"was cut from {self._size} to {size} bytes"
        for ending, before in self._logs.items():
            if _identity_or_none(self._beside(ending)) != before:
                return f"lost its {_LOGS[ending]}"
        self._size = size
        self._note_logs()
        return ""

    def discard_orphaned_logs(self) -> None:
        """Remove the logs of a file that has no longer this name: SQLite would apply them to the next that gets it."""
        try:
            if _looked_up(self.path)[0] == self._identity:
                return
        except OSError:
            # It was removed.
            pass
        for ending, before in self._logs.items():
            place = self._beside(ending)
            if _identity_or_none(place) == before:
                with suppress(OSError):
                    place.unlink()

    def _note_logs(self) -> None:
        """Record the logs as soon as they exist: SQLite keeps them until the last connection ends."""
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
