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

from rgss.documents import remove_abandoned_parts, unwritable, write_output
from rgss.errors import DefinitionError
from rgss.exchange.files import LARGEST_FILE_BYTES

_JOURNAL = Path(".rgss") / "import.json"


@contextmanager
def importing(folder: Path) -> Iterator[None]:
    """A project that one import, and no other, reads and changes.

    The folder of the requirements is locked, from before they are read until they are written; the lock ends with the
    process.

    Raises:
        DefinitionError: Another import is under way.
    """
    held = _locked(folder)
    try:
        yield
    finally:
        if held is not None:
            os.close(held)


@contextmanager
def journal_of(folder: Path, files: Mapping[str, tuple[bytes, bytes | None]]) -> Iterator[None]:
    """The journal of files while they are replaced within `importing`; after an error they have their old content.

    Args:
        folder: The project.
        files: The old and the new content of each file by its name; the new one is None if it is to be removed.

    Raises:
        DefinitionError: The journal cannot be written, or an import was interrupted that is not undone.
        StorageError: The disk is full.
    """
    path = folder / _JOURNAL
    is_new = not path.parent.exists()
    entries = {name: [_coded(content) for content in contents] for name, contents in files.items()}
    try:
        path.parent.mkdir(exist_ok=True)
        with path.open("xb") as journal:
            journal.write(json.dumps(entries).encode("ascii"))
            journal.flush()
            os.fsync(journal.fileno())
    except FileExistsError:
        raise _in_the_way(folder) from None
    except BaseException as error:
        # Also an interruption: no file is replaced yet.
        with suppress(OSError):
            _removed(path, with_folder=is_new)
        if isinstance(error, OSError):
            raise unwritable(path, error) from error
        raise
    try:
        yield
        _removed(path, with_folder=is_new)
    except BaseException:
        # Not only what is known to be written: an interruption may come before it is noted, or once all is written.
        _restored(folder, files)
        _removed(path, with_folder=is_new)
        raise


def contents_of(folder: Path) -> dict[str, bytes]:
    """The content of each file of requirements by its name, relative to the project."""
    found = {}
    for path in sorted((folder / "requirements").rglob("*.y*ml")):
        # What cannot be read is reported by whoever reads the project.
        with suppress(OSError):
            if path.is_file() and path.stat().st_size <= LARGEST_FILE_BYTES:
                found[path.relative_to(folder).as_posix()] = path.read_bytes()
    return found


def has_journal(folder: Path) -> bool:
    """True if an import into a project has not ended: it was interrupted, or is under way."""
    return (folder / _JOURNAL).is_file()


def was_interrupted(folder: Path) -> bool:
    """True if an import into a project has not ended, and none is under way."""
    if not has_journal(folder):
        return False
    try:
        with importing(folder):
            return has_journal(folder)
    except DefinitionError:
        return False


def undone(folder: Path) -> tuple[str, ...]:
    """Undo an import that was killed while it wrote; to be called within `importing`.

    Returns:
        The names of the files that have their old content again; a file that was changed since keeps its content.

    Raises:
        DefinitionError: A file cannot be written.
    """
    path = folder / _JOURNAL
    if not has_journal(folder):
        return ()
    entries = _entries(path.read_bytes())
    restored = _restored(folder, entries)
    for place in {(folder / name).resolve().parent for name in entries}:
        remove_abandoned_parts(place)
    path.unlink(missing_ok=True)
    return restored


def _restored(folder: Path, files: Mapping[str, tuple[bytes | None, bytes | None]]) -> tuple[str, ...]:
    """Give the files that have their new content, or a part of it, the old one again."""
    restored = []
    for name, (old, new) in files.items():
        content = _content(folder / name)
        if old is not None and content != old and (content == new or _is_half_written(content, old, new)):
            write_output(folder / name, old, replace_source=True)
            restored.append(name)
    return tuple(restored)


def _is_half_written(content: bytes | None, old: bytes, new: bytes | None) -> bool:
    """True for the content of a file whose overwriting in place was killed.

    A file that has another name too, or whose owner cannot be kept, is overwritten from its beginning; the room that it
    needs is reserved before, and what is beyond the new end is cut off afterwards.
    """
    if content is None or new is None or not len(old) <= len(content) <= max(len(old), len(new)):
        return False
    done = next(
        (i for i, (is_now, is_to_be) in enumerate(zip(content, new, strict=False)) if is_now != is_to_be), len(new)
    )
    return content[done:] == old.ljust(len(content), b"\0")[done:]


def _removed(journal: Path, *, with_folder: bool) -> None:
    journal.unlink(missing_ok=True)
    if with_folder:
        with suppress(OSError):
            journal.parent.rmdir()


def _entries(text: bytes) -> dict[str, tuple[bytes | None, bytes | None]]:
    """The files of a journal; none if it is incomplete, since no file is replaced before it is written."""
    try:
        entries = {name: (_decoded(old), _decoded(new)) for name, (old, new) in json.loads(text).items()}
    except (ValueError, TypeError, AttributeError):
        return {}
    return {name: entry for name, entry in entries.items() if _is_of_requirements(PurePosixPath(name))}


def _is_of_requirements(name: PurePosixPath) -> bool:
    return name.parts[:1] == ("requirements",) and ".." not in name.parts


def _locked(folder: Path) -> int | None:
    """Descriptor of the folder of the requirements, locked for this process; None where nothing can be locked.

    Raises:
        DefinitionError: Another process holds it.
    """
    if sys.platform == "win32":
        return None
    import fcntl

    try:
        descriptor = os.open(folder / "requirements", os.O_RDONLY | os.O_CLOEXEC)
    except OSError:
        # There is nothing to change either, which whoever reads the project reports.
        return None
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError as error:
        if error.errno in (errno.EWOULDBLOCK, errno.EACCES):
            os.close(descriptor)
            raise _under_way() from error
    return descriptor


def _under_way() -> DefinitionError:
    return DefinitionError("another import writes into this project", hint="wait until it has ended")


def _in_the_way(folder: Path) -> DefinitionError:
    """Error for what has the name of the journal: that of an import under way, or something that no import makes."""
    if has_journal(folder):
        return _under_way()
    name = _JOURNAL if (folder / _JOURNAL.parent).is_dir() else _JOURNAL.parent
    should = "file" if name == _JOURNAL else "folder"
    return DefinitionError(
        f"{folder / name} is in the way of the import: no {should} of rgss", hint="move it away, and import again"
    )


def _content(path: Path) -> bytes | None:
    try:
        return path.read_bytes()
    except FileNotFoundError:
        return None


def _coded(content: bytes | None) -> str | None:
    return None if content is None else base64.b64encode(content).decode("ascii")


def _decoded(text: str | None) -> bytes | None:
    return None if text is None else base64.b64decode(text)
