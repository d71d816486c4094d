"""Opening of regular files only: folders, devices or pipes could block the program or fill its memory."""

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

    Raises:
        OSError: The file cannot be opened, or is not a regular file.
        ValueError: The path has a null character.
    """
    # Non-blocking: opening a pipe without a writer would block this process forever.
    descriptor = os.open(path, os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0))
    with os.fdopen(descriptor, "rb") as file:
        # Checked on the open file, which cannot be replaced any more.
        kind = os.fstat(descriptor).st_mode
        if stat.S_ISDIR(kind):
            raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR), str(path))
        if not stat.S_ISREG(kind):
            raise OSError(errno.EINVAL, "not a regular file", str(path))
        yield file


def chunks_of(path: Path, *, largest: int) -> Iterator[bytes]:
    """Content of a regular file in chunks, so that it need not fit in memory.

    Args:
        path: The file.
        largest: Size limit in bytes.

    Raises:
        OSError: The file cannot be read, is not a regular file, or is larger.
    """
    left = largest
    with open_regular(path) as file:
        while chunk := file.read(_AT_ONCE):
            left -= len(chunk)
            if left < 0:
                raise OSError(errno.EFBIG, f"larger than the {largest // 1024**2} MiB that are read", str(path))
            yield chunk
