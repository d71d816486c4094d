"""Standard output and error with terminal control characters escaped; all output of a verb passes through here."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any, TextIO, cast

from rgss.documents import escaped_for_json, has_control_characters


class SafeStream:
    """Stream wrapper that escapes terminal control characters; other attributes are those of the stream."""

    def __init__(self, stream: TextIO) -> None:
        self.own = stream

    def write(self, text: str) -> int:
        """Write text with terminal control characters escaped."""
        self.own.write(escaped_for_json(text) if has_control_characters(text) else text)
        return len(text)

    def writelines(self, lines: Iterator[str]) -> None:
        """Write lines, which include their line ends."""
        for line in lines:
            self.write(line)

    def __getattr__(self, name: str) -> Any:
        return getattr(self.own, name)


@contextmanager
def safe_output() -> Iterator[None]:
    """Escape terminal control characters in all output of the block; printed JSON keeps its meaning."""
    before = sys.stdout, sys.stderr
    # Without a console there is no stream.
    sys.stdout, sys.stderr = (stream if stream is None else cast("TextIO", SafeStream(stream)) for stream in before)
    try:
        yield
    finally:
        sys.stdout, sys.stderr = before


def own_stream(stream: TextIO) -> TextIO:
    """The unwrapped stream, for output that controls the terminal and contains no text of a user.

    Args:
        stream: Standard output or error.
    """
    return stream.own if isinstance(stream, SafeStream) else stream


def data_stream() -> TextIO:
    """Stream for the content of a file on standard output: unchanged, except on a terminal."""
    own = own_stream(sys.stdout)
    return cast("TextIO", SafeStream(own)) if sys.stdout.isatty() else own
