"""Workers that answer wrongly: garbage on every descriptor, the answer to another task."""

from __future__ import annotations

import contextlib
import fcntl
import math
import os
import pickle
import struct
import threading
from collections.abc import Callable, Iterator
from pathlib import Path

import task_doubles

from rgss.sweep.worker_process import Answer
from rgss.sweep.worker_wire import frame

_MARK = frame(b"")[:8]


def descriptors() -> Iterator[int]:
    """Every descriptor of this process that can be written."""
    for entry in Path("/proc/self/fd").iterdir():
        with contextlib.suppress(OSError):
            if fcntl.fcntl(int(entry.name), fcntl.F_GETFL) & (os.O_WRONLY | os.O_RDWR):
                yield int(entry.name)


def write_to_all(content: bytes, *, for_ever: bool = False) -> None:
    """Write to every descriptor as far as it takes it, once or without end."""
    places = [*descriptors()]
    for place in places:
        os.set_blocking(place, False)
    while True:
        for place in places:
            with contextlib.suppress(OSError):
                os.write(place, content)
        if not for_ever:
            return


def answer(task: int, result: object, **changes: object) -> bytes:
    """A message as an answer of a worker has it."""
    values = {"error": "", "ours": False, "out_of_memory": False, "took_s": 0.1, **changes}
    return frame(pickle.dumps(Answer(task=task, result=result, **values)))


class Unreadable:
    """What breaks where it is read."""

    def __reduce__(self) -> tuple[Callable[..., object], tuple[object, ...]]:
        return math.sqrt, (-1.0,)


GARBAGE: dict[str, bytes] = {
    "zeros": b"\0" * 4096,
    "text": b"warning: \x1b[2J something went wrong\n" * 100,
    "an old length": struct.pack("!i", 2**31 - 1),
    "a huge old length": struct.pack("!iQ", -1, 2**62),
    "half a head": _MARK + b"\0\0",
    "a huge length": _MARK + struct.pack(">Q", 2**60) + b"\0" * 32,
    "less than it says": _MARK + struct.pack(">Q", 60 * 1024 * 1024) + b"\0" * 1000,
    "a wrong checksum": _MARK + struct.pack(">Q", 5) + b"\0" * 32 + b"hello",
    "no pickle": frame(b"hello"),
    "what cannot be put together": frame(pickle.dumps(Unreadable())),
    "no answer": frame(pickle.dumps("hello")),
    "an answer to another task": answer(10**6, "other"),
    "an answer with no time": answer(0, "x", took_s=math.nan),
    "an answer with a wrong flag": answer(0, "x", ours="yes"),
    "an answer with no text": answer(0, "x", error=None),
}
"""What a worker may write in place of its answer."""


def babble(name: str) -> None:
    """Write garbage to every descriptor, and then hang."""
    write_to_all(GARBAGE[name])
    threading.Event().wait()


def flood() -> None:
    """Write garbage to every descriptor without end."""
    write_to_all(b"\xff" * 65536, for_ever=True)


def prints() -> int:
    """Print as much as is taken of 100 MB; returns the bytes."""
    printed = 0
    with contextlib.suppress(OSError):
        while printed < 100_000_000:
            printed += os.write(1, b"x" * 1_000_000)
    return printed


def act(name: str) -> object:
    """Do what a name says."""
    if name in GARBAGE:
        return babble(name)
    if name == "flood":
        return flood()
    if name == "unpicklable":
        return lambda: None
    if name == "prints":
        return prints()
    if name == "long":
        return "x" * (65 * 1024 * 1024)
    if name == "closes its descriptors":
        for place in [*descriptors()]:
            os.close(place)
        threading.Event().wait()
    if name == "leaves a child":
        # The child keeps the pipe open when the worker ends.
        if os.fork() == 0:
            threading.Event().wait(20.0)
            os._exit(0)
        os._exit(7)
    return task_doubles.act(name)
