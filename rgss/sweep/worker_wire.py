"""Messages between a sweep and its workers: framed, of bounded length, with a checksum, and read without blocking.

A worker is where engines crash, write over memory and print on every descriptor that they find. What
arrives from it is an answer only if it has the mark, a length within the bound and the SHA-256 of what
follows; anything else is found with its first bytes and costs the worker, and neither time nor memory here.

This module imports nothing heavy, for worker processes load it before they set their limits.
"""

from __future__ import annotations

import contextlib
import hashlib
import os
import struct
from multiprocessing import connection

LONGEST_ANSWER = 64 * 1024 * 1024
"""Bytes of the longest answer of a worker: a piece is at most a quarter of it."""

_MARK = b"\x93rgss\r\n\x01"
_HEAD = struct.Struct(">8sQ32s")
_AT_ONCE = 256 * 1024


class WireError(Exception):
    """Error: the received bytes are not a message."""


def frame(content: bytes) -> bytes:
    """A message as it is sent: mark, length, SHA-256, content."""
    return _HEAD.pack(_MARK, len(content), hashlib.sha256(content).digest()) + content


class FrameReader:
    """Takes messages out of the bytes that arrive, however these are cut."""

    def __init__(self, longest: int | None = None) -> None:
        """Begin with nothing.

        Args:
            longest: Bytes of the longest message that is read; None for any.
        """
        self._longest = longest
        self._buffer = bytearray()

    def feed(self, data: bytes) -> list[bytes]:
        """Add received bytes; returns the messages that are complete with them.

        Raises:
            WireError: It is not a message.
        """
        self._buffer += data
        found = []
        while (content := self._next()) is not None:
            found.append(content)
        return found

    def _next(self) -> bytes | None:
        start = bytes(self._buffer[: len(_MARK)])
        if not _MARK.startswith(start):
            raise WireError("it wrote something other than an answer to its pipe")
        if len(self._buffer) < _HEAD.size:
            return None
        _, length, checksum = _HEAD.unpack_from(self._buffer)
        if self._longest is not None and length > self._longest:
            raise WireError(f"it announced an answer of {length} bytes; at most {self._longest} are read")
        if len(self._buffer) < _HEAD.size + length:
            return None
        content = bytes(self._buffer[_HEAD.size : _HEAD.size + length])
        del self._buffer[: _HEAD.size + length]
        if hashlib.sha256(content).digest() != checksum:
            raise WireError("its answer was damaged on the way")
        return content


class Channel:
    """The sweep's end of the connection to a worker; neither reading nor writing ever waits."""

    def __init__(self, end: connection.Connection) -> None:
        """Use one end of a pipe.

        Args:
            end: The end, which is made one that does not wait.
        """
        self._end = end
        self._reader = FrameReader(LONGEST_ANSWER)
        self._unsent = bytearray()
        os.set_blocking(end.fileno(), False)

    def fileno(self) -> int:
        """The descriptor, to wait for."""
        return self._end.fileno()

    @property
    def has_unsent(self) -> bool:
        """True if something is still to be written."""
        return bool(self._unsent)

    def send(self, content: bytes) -> None:
        """Send a message, as far as the other end takes it; the rest goes with `flush`."""
        self._unsent += frame(content)
        self.flush()

    def flush(self) -> None:
        """Write what the other end takes; its end is detected when it is read."""
        with contextlib.suppress(OSError):
            while self._unsent:
                written = os.write(self.fileno(), self._unsent[:_AT_ONCE])
                del self._unsent[:written]

    def receive(self) -> list[bytes]:
        """The messages that have arrived.

        Raises:
            EOFError: The other end was closed, and nothing has arrived.
            WireError: Something else has arrived.
        """
        found: list[bytes] = []
        while not found:
            try:
                data = os.read(self.fileno(), _AT_ONCE)
            except BlockingIOError:
                break
            except OSError as error:
                raise EOFError from error
            if not data:
                raise EOFError
            found += self._reader.feed(data)
        return found

    def close(self) -> None:
        """Close this end."""
        self._end.close()


class BlockingChannel:
    """The worker's end of the connection, which waits for its tasks."""

    def __init__(self, end: connection.Connection) -> None:
        """Use one end of a pipe."""
        self._end = end
        self._reader = FrameReader()
        self._arrived: list[bytes] = []

    def send(self, content: bytes) -> None:
        """Send a message.

        Raises:
            OSError: The other end was closed.
        """
        left = memoryview(frame(content))
        while left:
            left = left[os.write(self._end.fileno(), left[:_AT_ONCE]) :]

    def receive(self) -> bytes:
        """The next message.

        Raises:
            EOFError: The other end was closed.
            OSError: It cannot be read.
            WireError: Something else has arrived.
        """
        while not self._arrived:
            data = os.read(self._end.fileno(), _AT_ONCE)
            if not data:
                raise EOFError
            self._arrived += self._reader.feed(data)
        return self._arrived.pop(0)
