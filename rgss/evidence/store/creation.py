"""Atomic creation of a store: completed under another name, then linked, so that a store is never an empty file."""

from __future__ import annotations

import contextlib
import errno
import os
import secrets
from collections.abc import Iterator
from pathlib import Path

from rgss.documents import is_running
from rgss.errors import EvidenceError, StorageError
from rgss.evidence.store.connection import SPACE_HINT, connect, error_of, translated_errors
from rgss.evidence.store.locking import folder_lock
from rgss.evidence.store.schema import make

_NO_LINKS = (errno.EPERM, errno.EOPNOTSUPP, errno.ENOSYS, errno.EMLINK)
_ENDING = "new"
_ATTEMPTS = 5
_LOGS = ("", "-wal", "-shm", "-journal")


def create_store(path: Path, *, label: str) -> None:
    """Create an empty store and its folder, if there is no file; one created concurrently is kept.

    A process that dies meanwhile leaves at most a hidden file, which the next one removes.

    Args:
        path: The file.
        label: Its name in messages.

    Raises:
        StorageError: The disk is full or fails.
        EvidenceError: The folder or the file cannot be created.
    """
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        kind = error_of(error)
        hint = SPACE_HINT if kind is StorageError else "use a writable folder"
        raise kind(f"the folder of {label} cannot be created: {error.strerror}", hint=hint) from error
    for attempt in range(_ATTEMPTS):
        try:
            _make_and_link(path, label)
        except FileNotFoundError:  # noqa: PERF203 - it is tried again
            # On a shared disk a process of another machine may have considered this one dead.
            if attempt == _ATTEMPTS - 1:
                raise
        except OSError as error:
            raise error_of(error)(f"{label} cannot be created: {error.strerror}") from error
        else:
            return


def _make_and_link(path: Path, label: str) -> None:
    for left in _leftovers(path):
        _remove(left)
    part = path.with_name(f".{path.name}.{os.getpid()}-{secrets.token_hex(4)}.{_ENDING}")
    try:
        with translated_errors(label, path=path):
            connection = connect(part)
            try:
                make(connection)
            finally:
                connection.close()
        with folder_lock(path.parent):
            if not path.exists():
                # The log of a moved file does not belong to this one.
                _remove(path)
                _link(part, path)
    finally:
        _remove(part)


def _link(part: Path, path: Path) -> None:
    try:
        os.link(part, path)
    except FileExistsError:
        return
    except OSError as error:
        if error.errno not in _NO_LINKS:
            raise
        # A file system without links: another process could only have created an empty store meanwhile.
        if not path.exists():
            part.rename(path)


def _leftovers(path: Path) -> Iterator[Path]:
    """Leftover files of processes that died while creating this store."""
    for file in path.parent.glob(f".{path.name}.*.{_ENDING}"):
        process = file.name.removeprefix(f".{path.name}.").partition("-")[0]
        with contextlib.suppress(OSError):
            if process.isdecimal() and not is_running(int(process)) and file.stat().st_uid == os.geteuid():
                yield file


def _remove(file: Path) -> None:
    for ending in _LOGS:
        with contextlib.suppress(OSError):
            file.with_name(file.name + ending).unlink(missing_ok=True)


def require_content(path: Path, *, label: str) -> None:
    """Require that an existing file is not empty.

    A store is never empty, not even during creation: an empty file was truncated, or created by another program.

    Args:
        path: The file.
        label: Its name in messages.

    Raises:
        EvidenceError: The file is empty.
    """
    with contextlib.suppress(OSError):
        if path.is_file() and path.stat().st_size == 0:
            raise EvidenceError(f"{label} is empty: an evidence store is never empty, so it was truncated", hint=_EMPTY)


_EMPTY = "restore a copy of it, or remove the file to start again"
