"""Atomic writing of output files, common to all commands.

A regular file is replaced atomically, and keeps its owner, permissions and extended attributes; one with several hard
links, or whose owner cannot be kept, is overwritten in place. A symbolic link is followed and kept; a device, a pipe or
a socket is written to; a source file of a project is rejected.
"""

from __future__ import annotations

import errno
import os
import shutil
import stat
import sys
import tempfile
import threading
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from itertools import count
from pathlib import Path

from rgss.documents.project_sources import new_project_source, project_source, source_with_another_name
from rgss.documents.running_processes import is_running
from rgss.errors import DefinitionError, RgssError, StorageError

_MOST_LINKS = 40
_DESCRIPTORS = "/proc/"
_PART = ".rgss-{process}-{number}.part"
"""Name of a temporary file beside the output."""
_DISK_FAILURES = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EIO)


class SourceOverwriteError(DefinitionError):
    """An output would overwrite a source file of a project."""


@dataclass(frozen=True, slots=True, kw_only=True)
class _Target:
    """Destination of an output.

    Attributes:
        path: The file after resolution of symbolic links, or the given path if it is written in place.
        in_place: True for a device, a pipe, a socket or an open descriptor, which cannot be replaced.
        status: Status of the existing file; None for a new file.
    """

    path: Path
    in_place: bool
    status: os.stat_result | None


@contextmanager
def replaced_file(path: Path, *, replace_source: bool = False, new_source: bool = False) -> Iterator[Path]:
    """Context of a temporary file, whose content replaces that of the path unless the block raises.

    Args:
        path: The output file.
        replace_source: True to allow replacing a source file of a project, for commands with that purpose.
        new_source: True to allow a new source file, which replaces none.

    Raises:
        SourceOverwriteError: The file is a source of a project, or would be one.
        OSError: The file cannot be written.
    """
    try:
        target = _target(path)
    except ValueError as error:
        raise OSError(errno.EINVAL, str(error), str(path)) from error
    if not replace_source:
        _refuse_source(path, target, new_source=new_source)
    writer = _streamed if target.in_place else _swapped
    try:
        with writer(target) as part:
            yield part
    except OSError as error:
        if isinstance(error, BrokenPipeError) and not is_standard_output(path):
            # The reader of standard output may close it; a closed named pipe, in contrast, is an error.
            raise unwritable(path, error) from error
        # The error names the output file instead of the temporary one.
        if error.errno is not None:
            raise type(error)(error.errno, error.strerror, str(path)) from error
        raise


def write_output(path: Path, content: bytes, *, replace_source: bool = False, new_source: bool = False) -> None:
    """Write an output file atomically.

    Args:
        path: The output file.
        content: Its content.
        replace_source: True to allow replacing a source file of a project.
        new_source: True to allow a new source file, which replaces none.

    Raises:
        SourceOverwriteError: The file is a source of a project, or would be one.
        StorageError: The disk is full or fails.
        DefinitionError: The file cannot be written.
    """
    try:
        with replaced_file(path, replace_source=replace_source, new_source=new_source) as part:
            part.write_bytes(content)
    except OSError as error:
        raise unwritable(path, error) from error


def unwritable(path: Path, error: OSError) -> RgssError:
    """Error of rgss for an output file that cannot be written."""
    if is_disk_failure(error):
        return StorageError(f"{path} cannot be written: {error.strerror}", hint="free some space, or check the disk")
    return DefinitionError(f"{path} cannot be written: {error.strerror or error}", hint="check the folder")


def is_disk_failure(error: OSError) -> bool:
    """True if the disk is full or fails, which is no mistake of the command."""
    return error.errno in _DISK_FAILURES


def require_no_source(path: Path) -> None:
    """Require, before any work, that an output does not overwrite a source file, and would not be one.

    Raises:
        SourceOverwriteError: The file is a source of a project, or would be one.
    """
    with suppress(OSError, ValueError):
        _refuse_source(path, _target(path))


def why_not_writable(path: Path) -> str:
    """Reason why a file cannot be written; empty if it can be. The file is not changed.

    Raises:
        SourceOverwriteError: The file is a source of a project.
    """
    try:
        if path.is_dir():
            return "it is a folder"
        target = _target(path)
        folder = target.path.parent if path.is_symlink() else path.parent
        if not folder.is_dir():
            return f"there is no folder {folder}"
        if target.status is not None and not os.access(target.path, os.W_OK):
            return os.strerror(errno.EACCES)
        if not target.in_place:
            with _new_part(target.path):
                pass
    except (OSError, ValueError) as error:
        return getattr(error, "strerror", None) or str(error)
    _refuse_source(path, target)
    return ""


def is_standard_output(path: Path) -> bool:
    """True if a path is the standard output of this process, so that nothing else may be printed."""
    try:
        return os.path.samestat(path.stat(), os.fstat(1))
    except (OSError, ValueError):
        return False


def remove_abandoned_parts(folder: Path) -> None:
    """Remove the temporary files of processes that were killed while they wrote into a folder."""
    with suppress(OSError):
        for part in sorted(folder.glob(_PART.format(process="*", number="*"))):
            process = part.name.split("-")[1]
            if process.isdecimal() and not is_running(int(process)):
                with suppress(OSError):
                    part.unlink()


def _refuse_source(path: Path, target: _Target, *, new_source: bool = False) -> None:
    if target.in_place:
        return
    if target.status is None:
        source = "" if new_source else new_project_source(target.path)
        if source:
            message = f"{source} would be read as a source of the project, and is not written"
            raise SourceOverwriteError(message, hint="name a file outside of the folders of its sources")
        return
    source = project_source(target.path) or source_with_another_name(target.status)
    if source:
        is_itself = target.path.absolute() == path.absolute() and target.path.name == Path(source).name
        through = "" if is_itself else f" (through the link {str(path)!r})"
        removable = (
            "" if not new_source and new_project_source(target.path) else "; to replace this one, remove it first"
        )
        raise SourceOverwriteError(
            f"{source} is a source of the project and is not overwritten{through}",
            hint=f"name another file{removable}",
        )


def _target(path: Path) -> _Target:
    """Destination of an output, after resolution of symbolic links.

    Raises:
        OSError: The links are circular, or a name is too long.
    """
    try:
        status = path.stat()
    except (FileNotFoundError, NotADirectoryError):
        status = None
    if status is not None and not stat.S_ISREG(status.st_mode):
        return _Target(path=path, in_place=True, status=status)
    if status is not None and is_standard_output(path):
        return _Target(path=path, in_place=True, status=status)
    here = path
    for _ in range(_MOST_LINKS):
        # A link there is an open descriptor; replacing it would not affect the open file.
        if os.path.realpath(here.parent).startswith(_DESCRIPTORS):
            return _Target(path=path, in_place=True, status=status)
        if not here.is_symlink():
            return _Target(path=Path(os.path.realpath(here.parent)) / here.name, in_place=False, status=status)
        here = here.parent / os.readlink(here)  # noqa: PTH115 - a Path would drop what makes a loop visible
    raise OSError(errno.ELOOP, os.strerror(errno.ELOOP), str(path))


@contextmanager
def _swapped(target: _Target) -> Iterator[Path]:
    if target.status is not None and not os.access(target.path, os.W_OK):
        # A rename needs write access only to the folder, but the file itself is write-protected.
        raise PermissionError(errno.EACCES, os.strerror(errno.EACCES))
    with _new_part(target.path) as part:
        yield part
        with part.open("rb+") as file:
            os.fsync(file.fileno())
        if target.status is None:
            part.replace(target.path)
        elif target.status.st_nlink > 1 or not _made_alike(part, target.path, target.status):
            _overwrite(target.path, part)
        else:
            part.replace(target.path)


def _made_alike(part: Path, old: Path, status: os.stat_result) -> bool:
    """Copy owner, permissions and extended attributes to a file; False if that is not permitted."""
    try:
        os.chown(part, status.st_uid, status.st_gid)
        # Access control lists are among them.
        for name in os.listxattr(old) if hasattr(os, "listxattr") else ():
            os.setxattr(part, name, os.getxattr(old, name))
        part.chmod(stat.S_IMODE(status.st_mode))
    except OSError:
        return False
    return True


def _overwrite(path: Path, part: Path) -> None:
    """Copy the content of a finished file into another in place, which keeps its hard links.

    The space is reserved first, so that a full disk leaves the old content unchanged.
    """
    with part.open("rb") as source, path.open("rb+") as sink:
        old, new = os.fstat(sink.fileno()).st_size, os.fstat(source.fileno()).st_size
        try:
            if new > old and hasattr(os, "posix_fallocate"):
                os.posix_fallocate(sink.fileno(), old, new - old)
        except OSError:
            sink.truncate(old)
            raise
        shutil.copyfileobj(source, sink)
        sink.truncate(new)
        sink.flush()
        os.fsync(sink.fileno())


@contextmanager
def _streamed(target: _Target) -> Iterator[Path]:
    with tempfile.TemporaryDirectory(prefix="rgss-") as folder:
        part = Path(folder) / "part"
        part.touch()
        yield part
        with part.open("rb") as source:
            if is_standard_output(target.path):
                sys.stdout.flush()
                with os.fdopen(os.dup(1), "wb") as sink:
                    shutil.copyfileobj(source, sink)
            else:
                with target.path.open("wb") as sink:
                    shutil.copyfileobj(source, sink)


@contextmanager
def _new_part(path: Path) -> Iterator[Path]:
    """New empty file in the same folder, since a rename is atomic only within a file system; finally removed.

    Its name is that of no other process or thread: it is removed even if an interruption comes before it is used.
    """
    me = f"{os.getpid()}-{threading.get_ident()}"
    names = (path.with_name(_PART.format(process=me, number=number)) for number in count())
    part = next(name for name in names if not os.path.lexists(name))
    try:
        os.close(os.open(part, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o666))
        yield part
    finally:
        part.unlink(missing_ok=True)
