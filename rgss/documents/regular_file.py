"""Opening of regular files: not of folders, devices or pipes, which could block a program or fill its memory."""

from __future__ import annotations

import errno
import os
import stat
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import BinaryIO

_AT_ONCE = 1024 * 1024


@contextmanager
def open_regular(path: Path) -> Iterator[BinaryIO]:
    """Open a regular file for reading.

    Args:
        path: The file.

    Raises:
        OSError: It cannot be opened, or is something else than a regular file.
        ValueError: The path has a null character.
    """
    # Non-blocking: opening a pipe without a writer would block this process for ever.
    descriptor = os.open(path, os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0))
    with os.fdopen(descriptor, "rb") as file:
        # Checked on the open file, which cannot be exchanged any more.
        kind = os.fstat(descriptor).st_mode
        if stat.S_ISDIR(kind):
            raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR), str(path))
        if not stat.S_ISREG(kind):
            raise OSError(errno.EINVAL, "not a regular file", str(path))
        yield file


def chunks_of(path: Path, *, largest: int) -> Iterator[bytes]:
    """The content of a regular file, piece by piece, so that it need not fit the memory.

    Args:
        path: The file.
        largest: Bytes of the largest file that is read.

    Raises:
        OSError: It cannot be read, is something else than a regular file, or is larger.
    """
    left = largest
    with open_regular(path) as file:
        while chunk := file.read(_AT_ONCE):
            left -= len(chunk)
            if left < 0:
                raise OSError(errno.EFBIG, f"larger than the {largest // 1024**2} MiB that are read", str(path))
            yield chunk
