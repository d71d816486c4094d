"""Temporary folder of child processes, which may be killed while they have files in it."""

from __future__ import annotations

import shutil
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager


class ScratchFolder:
    """Folder for the temporary files of child processes.

    The physics engine reads a robot from a file. A process that is killed at that moment, as at Ctrl-C, does not remove
    it; whoever ends the process removes the folder.

    Attributes:
        path: The folder; empty if none can be made, as many trials need none.
    """

    def __init__(self) -> None:
        """Make the folder."""
        try:
            self.path = tempfile.mkdtemp(prefix="rgss-")
        except OSError:
            self.path = ""

    def remove(self) -> None:
        """Remove the folder with its content; again is allowed."""
        remove_scratch(self.path)

    @contextmanager
    def removed_on_error(self) -> Iterator[None]:
        """Context that starts a process; the folder is removed if that fails."""
        try:
            yield
        except BaseException:
            self.remove()
            raise


def use_scratch(path: str) -> None:
    """Make a folder that of this process's temporary files.

    Args:
        path: The folder; if empty, the usual one stays.
    """
    if path:
        tempfile.tempdir = path


def remove_scratch(path: str) -> None:
    """Remove a folder of temporary files, if it is there.

    Args:
        path: The folder; empty for none.
    """
    if path:
        shutil.rmtree(path, ignore_errors=True)
