"""Standard output and error, through which all output of a verb passes.

Terminal control characters are escaped, and so is what the encoding of the stream cannot express.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any, TextIO, cast

from rgss.documents import escaped_for_json, has_control_characters

_ASCII = str.maketrans(
    {
        "─": "-",
        "–": "-",
        "—": "-",
        "−": "-",
        "…": "...",
        "“": '"',
        "”": '"',
        "‘": "'",
        "’": "'",
        "×": "x",
        "·": ".",
        "→": "->",
        "≤": "<=",
        "≥": ">=",
        "±": "+/-",
        "µ": "u",
    }
)


class SafeStream:
    """Stream wrapper that escapes terminal control characters; other attributes are those of the stream."""

    def __init__(self, stream: TextIO) -> None:
        self.own = stream

    def write(self, text: str) -> int:
        """Write text with terminal control characters escaped, and characters that the encoding lacks."""
        safe = escaped_for_json(text) if has_control_characters(text) else text
        try:
            self.own.write(safe)
        except UnicodeEncodeError as error:
            # Nothing was written: the stream encodes a text as a whole.
            self.own.write("".join(_expressed(character, error.encoding) for character in safe))
        return len(text)

    def writelines(self, lines: Iterator[str]) -> None:
        """Write lines, which include their line ends."""
        for line in lines:
            self.write(line)

    def __getattr__(self, name: str) -> Any:
        return getattr(self.own, name)


def _expressed(character: str, encoding: str) -> str:
    try:
        character.encode(encoding)
    except UnicodeEncodeError:
        return json.dumps(character)[1:-1]  # an escape of JSON, so that printed JSON keeps its meaning
    return character


def typeset(line: str, encoding: str) -> str:
    """A line of a page for people, with signs of ASCII for the rules and marks that an encoding lacks."""
    try:
        line.encode(encoding)
    except UnicodeEncodeError:
        known = line.encode(encoding, "ignore").decode(encoding)
        return line.translate({place: text for place, text in _ASCII.items() if chr(place) not in known})
    return line


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


def errors_are_seen() -> bool:
    """True if standard error is a terminal; it may be closed."""
    return sys.stderr is not None and sys.stderr.isatty()


def data_stream() -> TextIO:
    """Stream for the content of a file on standard output: unchanged, except on a terminal.

    Text that the encoding cannot express raises a `UnicodeEncodeError`: an escape would be other content.
    """
    own = own_stream(sys.stdout)
    return cast("TextIO", SafeStream(own)) if sys.stdout.isatty() else own
