"""Observation of a store that another process may write: read-only, repeated if the file changed meanwhile."""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TypeVar

from rgss.errors import EvidenceError, StorageError
from rgss.evidence.store.place import place_of
from rgss.evidence.store.store import EvidenceStore

Value = TypeVar("Value")

_FILES = ("", "-wal")
_ATTEMPTS = 5


@dataclass(frozen=True, slots=True)
class StoreState:
    """State of a store's files; it differs after every observable change.

    Attributes:
        files: Device, inode, size and time of change in ns of the file and of its log; None for one that is missing.
    """

    files: tuple[tuple[int, int, int, int] | None, ...]

    @property
    def exists(self) -> bool:
        """True if there is a file of that name."""
        return self.files[0] is not None


def state_of(path: Path) -> StoreState:
    """Present state of a store's files, without opening them."""
    place = Path(os.path.realpath(path))
    return StoreState(tuple(_looked_up(place.with_name(f"{place.name}{ending}")) for ending in _FILES))


def observed(path: Path, read: Callable[[EvidenceStore], Value], *, label: str) -> Value:
    """Read a store without creating or changing a file, while another process may write, replace or remove it.

    Without a writer a file is opened as immutable. If a writer appears meanwhile, the result may mix two states, and
    reading is repeated.

    Args:
        path: The file.
        read: Function that reads from the store; called again if the file changed meanwhile.
        label: The file's name in messages.

    Raises:
        EvidenceError: The file is missing, or is damaged, or cannot be read.
        StorageError: The file changes too often to be read.
    """
    path = place_of(path, label=label)
    problem: EvidenceError | None = None
    for _ in range(_ATTEMPTS):
        before, had_index = state_of(path), _index(path).exists()
        try:
            with EvidenceStore.open(path, read_only=True, label=label) as store:
                value = read(store)
        except EvidenceError as error:
            problem = error
            if state_of(path) == before:
                raise
            continue
        # With an index SQLite isolates readers from a writer.
        if (had_index and _index(path).exists()) or state_of(path) == before:
            return value
    if problem is not None:
        raise problem
    raise StorageError(f"{label} changes faster than it can be read", hint="try again later")


def _index(path: Path) -> Path:
    return path.with_name(f"{path.name}-shm")


def _looked_up(path: Path) -> tuple[int, int, int, int] | None:
    try:
        found = path.stat()
    except OSError:
        return None
    return found.st_dev, found.st_ino, found.st_size, found.st_mtime_ns
