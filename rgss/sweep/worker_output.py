"""Output of a worker, in a file without a name, so that nothing is left of it however the processes end."""

from __future__ import annotations

import os
import tempfile
from multiprocessing import connection

_LONGEST_TAIL = 300


class WorkerOutput:
    """An unnamed file that a worker process inherits as its standard output and error."""

    def __init__(self) -> None:
        """Make the file.

        Raises:
            OSError: It cannot be made.
        """
        descriptor = _unnamed_file()
        # A connection is what the spawning of processes can hand over by its descriptor.
        self.end = connection.Connection(descriptor, readable=False)

    def tail(self) -> str:
        """The last printed line, where libraries report why they end the process; empty if there is none."""
        try:
            size = os.fstat(self.end.fileno()).st_size
            content = os.pread(self.end.fileno(), _LONGEST_TAIL, max(0, size - _LONGEST_TAIL))
        except OSError:
            return ""
        lines = content.decode("utf-8", "replace").split("\n")
        return next((" ".join(line.split()) for line in reversed(lines) if line.strip()), "")

    def close(self) -> None:
        """Close the file, which is deleted with the last process that has it open."""
        self.end.close()


def _unnamed_file() -> int:
    """A file in memory where the system has such files, which also need no folder that can be written."""
    import fcntl

    memory_file = getattr(os, "memfd_create", None)
    if memory_file is not None:
        descriptor: int = memory_file("rgss-worker")
    else:
        with tempfile.TemporaryFile() as file:
            descriptor = os.dup(file.fileno())
    # The file is made empty before each task, and then begins at its beginning again.
    fcntl.fcntl(descriptor, fcntl.F_SETFL, fcntl.fcntl(descriptor, fcntl.F_GETFL) | os.O_APPEND)
    return descriptor
