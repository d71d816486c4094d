"""Compression of texts for the store, with a bound on their size."""

from __future__ import annotations

import zlib

from rgss.errors import EvidenceError

LARGEST_TEXT = 16 * 1024 * 1024
"""Greatest size of a stored text in bytes, which also bounds the unpacked size of a forged file."""

# Records shrink to a quarter at the fastest level; the slowest saves another tenth for ten times the time.
_LEVEL = 1


def pack(text: str, name: str) -> bytes:
    """Compress a text.

    Args:
        text: The text.
        name: Its name in messages.

    Raises:
        EvidenceError: It is too long, or is not Unicode.
    """
    try:
        content = text.encode("utf-8")
    except UnicodeEncodeError as error:
        raise EvidenceError(f"the {name} cannot be written as UTF-8: {error.reason}") from error
    if len(content) > LARGEST_TEXT:
        raise EvidenceError(f"the {name} has {len(content)} bytes; at most {LARGEST_TEXT} are kept")
    return zlib.compress(content, _LEVEL)


def unpack(content: object, name: str) -> str:
    """Text from the output of `pack`.

    Args:
        content: The compressed text.
        name: Its name in messages.

    Raises:
        EvidenceError: The content is invalid, or the text would be too long.
    """
    if not isinstance(content, bytes):
        raise EvidenceError(f"its {name} is not of bytes")
    unpacking = zlib.decompressobj()
    try:
        text = unpacking.decompress(content, LARGEST_TEXT + 1)
    except zlib.error as error:
        raise EvidenceError(f"its {name} cannot be unpacked") from error
    if len(text) > LARGEST_TEXT:
        raise EvidenceError(f"its {name} is longer than the {LARGEST_TEXT} bytes that are read")
    if not unpacking.eof or unpacking.unused_data:
        raise EvidenceError(f"its {name} cannot be unpacked")
    try:
        return text.decode("utf-8")
    except UnicodeDecodeError as error:
        raise EvidenceError(f"its {name} is not UTF-8") from error
