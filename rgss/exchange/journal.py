"""Journal of the files that an import replaces, by which one that is killed between two of them is undone."""

from __future__ import annotations

import base64
import errno
import json
import os
import sys
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from pathlib import Path, PurePosixPath
from typing import BinaryIO

from rgss.documents import unwritable, write_output
from rgss.errors import DefinitionError

_JOURNAL = Path(".rgss") / "import.json"


@contextmanager
def journal_of(folder: Path, files: Mapping[str, tuple[bytes, bytes | None]]) -> Iterator[None]:
    """The journal of files while they are replaced; it is removed at the end, also after an error.

    Args:
        folder: The project.
        files: The old and the new content of each file by its name; the new one is None if it is to be removed.

    Raises:
        DefinitionError: The journal cannot be written, or another import is under way.
    """
    path = folder / _JOURNAL
    is_new = not path.parent.exists()
    entries = {name: [_coded(content) for content in contents] for name, contents in files.items()}
    try:
        path.parent.mkdir(exist_ok=True)
        journal = path.open("xb")
    except FileExistsError:
        raise _under_way() from None
    except OSError as error:
        raise unwritable(path, error) from error
    with journal:
        try:
            # Held as long as the process lives, so that nobody undoes an import that is under way.
            _is_locked(journal)
            journal.write(json.dumps(entries).encode("ascii"))
            journal.flush()
            os.fsync(journal.fileno())
            yield
        finally:
            path.unlink()
            if is_new:
                with suppress(OSError):
                    path.parent.rmdir()


def was_interrupted(folder: Path) -> bool:
    """True if an import into a project has not ended."""
    return (folder / _JOURNAL).is_file()


def undone(folder: Path) -> tuple[str, ...]:
    """Undo an import that was killed while it wrote.

    Args:
        folder: The project.

    Returns:
        The names of the files that have their old content again; a file that was changed since keeps its content.

    Raises:
        DefinitionError: Another import is under way, or a file cannot be written.
    """
    path = folder / _JOURNAL
    if not path.is_file():
        return ()
    with path.open("rb") as journal:
        if not _is_locked(journal):
            raise _under_way()
        restored = []
        for name, (old, new) in _entries(journal.read()).items():
            if old is not None and _content(folder / name) == new != old:
                write_output(folder / name, old, replace_source=True)
                restored.append(name)
        path.unlink(missing_ok=True)
    return tuple(restored)


def _entries(text: bytes) -> dict[str, tuple[bytes | None, bytes | None]]:
    """The files of a journal; none if it is incomplete, since no file is replaced before it is written."""
    try:
        entries = {name: (_decoded(old), _decoded(new)) for name, (old, new) in json.loads(text).items()}
    except (ValueError, TypeError, AttributeError):
        return {}
    return {name: entry for name, entry in entries.items() if _is_of_requirements(PurePosixPath(name))}


def _is_of_requirements(name: PurePosixPath) -> bool:
    return name.parts[:1] == ("requirements",) and ".." not in name.parts


def _is_locked(file: BinaryIO) -> bool:
    """Lock a file for this process; false if another one holds it, true also where nothing can be locked."""
    if sys.platform == "win32":
        return True
    import fcntl

    try:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError as error:
        return error.errno not in (errno.EWOULDBLOCK, errno.EACCES)
    return True


def _under_way() -> DefinitionError:
    return DefinitionError("another import writes into this project", hint="wait until it has ended")


def _content(path: Path) -> bytes | None:
    try:
        return path.read_bytes()
    except FileNotFoundError:
        return None


def _coded(content: bytes | None) -> str | None:
    return None if content is None else base64.b64encode(content).decode("ascii")


def _decoded(text: str | None) -> bytes | None:
    return None if text is None else base64.b64decode(text)
