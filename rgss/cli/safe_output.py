"""Standard output and error that nothing can steer: the one place through which all that a verb prints goes."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any, TextIO, cast

from rgss.documents import escaped_for_json, steers


class SafeStream:
    """A stream that escapes what would steer a terminal; everything else of it is the stream's own."""

    def __init__(self, stream: TextIO) -> None:
        self.own = stream

    def write(self, text: str) -> int:
        """Write text; what would steer a terminal is escaped."""
        self.own.write(escaped_for_json(text) if steers(text) else text)
        return len(text)

    def writelines(self, lines: Iterator[str]) -> None:
        """Write lines, which have their ends."""
        for line in lines:
            self.write(line)

    def __getattr__(self, name: str) -> Any:
        return getattr(self.own, name)


@contextmanager
def safe_output() -> Iterator[None]:
    """Let what is printed in the block steer no terminal; JSON that is printed keeps its meaning."""
    before = sys.stdout, sys.stderr
    # Without a console there is no stream.
    sys.stdout, sys.stderr = (stream if stream is None else cast("TextIO", SafeStream(stream)) for stream in before)
    try:
        yield
    finally:
        sys.stdout, sys.stderr = before


def own_stream(stream: TextIO) -> TextIO:
    """The stream itself, for what draws on a terminal by our will and has no text of a user's in it.

    Args:
        stream: Standard output or error.
    """
    return stream.own if isinstance(stream, SafeStream) else stream


def data_stream() -> TextIO:
    """Stream for the content of a file on standard output: unchanged, except on a terminal."""
    own = own_stream(sys.stdout)
    return cast("TextIO", SafeStream(own)) if sys.stdout.isatty() else own
